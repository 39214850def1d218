// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/container_bytes.hpp"

#include <algorithm>

#include "lib/outputs/texts.hpp"

namespace mtstereo::run {

Bytes::Bytes(const std::filesystem::path& file) : stream_(file, std::ios::binary) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  size_ = error || !stream_ ? 0 : size;
}

std::string Bytes::at(std::uint64_t position, std::size_t count) {
  if (position > size_ || count > size_ - position) return {};
  std::string bytes(count, '\0');
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(position));
  stream_.read(bytes.data(), static_cast<std::streamsize>(count));
  return stream_ ? bytes : std::string();
}

std::string Bytes::up_to(std::uint64_t position, std::size_t count) {
  return at(position, std::min<std::uint64_t>(count, size_ - std::min(position, size_)));
}

std::uint64_t big_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char each : bytes) value = value << 8 | static_cast<unsigned char>(each);
  return value;
}

std::uint64_t little_endian(std::string_view bytes) {
  std::string reversed(bytes);
  std::reverse(reversed.begin(), reversed.end());
  return big_endian(reversed);
}

bool exceeds(std::uint64_t start, std::uint64_t length, std::uint64_t size) {
  return length > size - std::min(start, size);
}

std::string lacks(std::uint64_t bytes, const std::string& part) {
  return std::to_string(bytes) + " bytes of " + part + " are missing";
}

void DamagedParts::add(std::uint64_t position, const std::string& why) {
  if (count++ > 0) return;
  first = position;
  reason = why;
}

std::string DamagedParts::text() const {
  if (count == 0) return "";
  return "the file is damaged in " + outputs::counted(static_cast<std::size_t>(count), "place") +
         ", the first one at byte " + std::to_string(first) + " (" + reason + ")";
}

}  // namespace mtstereo::run
