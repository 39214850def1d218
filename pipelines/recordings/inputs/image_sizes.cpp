// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/image_sizes.hpp"

#include <fstream>
#include <map>
#include <string_view>

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

std::string read(std::ifstream& stream, std::size_t count) {
  std::string bytes(count, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(count));
  return stream ? bytes : std::string();
}

unsigned number(std::string_view bytes) {
  unsigned value = 0;
  for (const char each : bytes) value = value << 8 | static_cast<unsigned char>(each);
  return value;
}

std::string text_of(unsigned width, unsigned height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// The frame header of a JPEG file follows segments that state their lengths.
std::string size_of_jpeg(std::ifstream& stream) {
  constexpr unsigned kFirstFrame = 0xc0, kLastFrame = 0xcf;
  for (std::string head = read(stream, 4); head.size() == 4 && head[0] == '\xff';
       head = read(stream, 4)) {
    const unsigned kind = number(std::string_view(head).substr(1, 1));
    const unsigned length = number(std::string_view(head).substr(2));
    const bool is_frame =
        kind >= kFirstFrame && kind <= kLastFrame && kind != 0xc4 && kind != 0xc8 && kind != 0xcc;
    if (is_frame) {
      const std::string size = read(stream, 5);
      if (size.empty()) return {};
      return text_of(number(std::string_view(size).substr(3)),
                     number(std::string_view(size).substr(1, 2)));
    }
    stream.seekg(static_cast<std::streamoff>(length) - 2, std::ios::cur);
  }
  return {};
}

}  // namespace

std::string stated_size(const fs::path& image) {
  std::ifstream stream(image, std::ios::binary);
  const std::string start = read(stream, 2);
  if (start == "\xff\xd8") return size_of_jpeg(stream);
  if (start != "\x89P") return {};
  stream.seekg(16);
  const std::string size = read(stream, 8);
  if (size.empty()) return {};
  return text_of(number(std::string_view(size).substr(0, 4)),
                 number(std::string_view(size).substr(4)));
}

std::vector<ImagesOfSize> by_size(const Source& left, const Source& right) {
  std::map<std::string, ImagesOfSize> parts;
  if (left.images.size() > 1 && right.images.size() > 1) {
    for (const fs::path& image : left.images) {
      parts[stated_size(image)].left.images.push_back(image);
    }
    for (const fs::path& image : right.images) {
      parts[stated_size(image)].right.images.push_back(image);
    }
  }
  std::vector<ImagesOfSize> result;
  for (auto& [size, part] : parts) {
    if (part.left.empty() || part.right.empty()) continue;
    part.size = size;
    result.push_back(std::move(part));
  }
  if (result.size() < 2) return {{"", left, right}};
  return result;
}

}  // namespace mtstereo::run
