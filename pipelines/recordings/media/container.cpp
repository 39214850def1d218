// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/container.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "recordings/media/container_bytes.hpp"
#include "recordings/media/container_matroska.hpp"
#include "recordings/media/container_mp4.hpp"
#include "recordings/media/container_pages.hpp"
#include "recordings/media/container_transport.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

std::string missing_of_avi(Bytes& bytes) {
  for (std::uint64_t start = 0; start + 8 <= bytes.size();) {
    std::string head = bytes.at(start + 4, 4);
    if (bytes.at(start, 4) != "RIFF") break;  // what follows is not of the container
    std::reverse(head.begin(), head.end());
    const std::uint64_t length = big_endian(head);
    if (exceeds(start + 8, length, bytes.size())) {
      return lacks(length - (bytes.size() - start - 8), "its RIFF chunk");
    }
    start += 8 + length + length % 2;
  }
  return "";
}

// ASF (WMV): a sequence of objects with identifier and length.
std::string missing_of_asf(Bytes& bytes) {
  constexpr std::uint64_t kHead = 24;
  for (std::uint64_t start = 0; start < bytes.size();) {
    const std::string head = bytes.at(start, kHead);
    if (head.empty()) return "it ends within the header of an object";
    const std::uint64_t length = little_endian(head.substr(16));
    if (length < kHead) break;  // its length is not known
    if (exceeds(start, length, bytes.size())) {
      return lacks(length - (bytes.size() - start), "an object");
    }
    start += length;
  }
  return "";
}

constexpr std::string_view kMatroska = "\x1a\x45\xdf\xa3", kAvi = "RIFF", kOgg = "OggS",
                           kFlv = "FLV\1", kAsf = "\x30\x26\xb2\x75";

}  // namespace

bool has_second_view(const fs::path& file) {
  Bytes bytes(file);
  return is_mp4(bytes) && second_view_in_mp4(bytes);
}

bool is_avi(const fs::path& file) { return Bytes(file).at(0, 4) == kAvi; }

bool is_matroska(const fs::path& file) { return Bytes(file).at(0, 4) == kMatroska; }

bool may_lack_end(const fs::path& file) {
  Bytes bytes(file);
  const std::optional<Packets> packets = packets_of(bytes);
  return packets && may_lack_end(bytes, *packets);
}

std::string missing_end(const fs::path& file) {
  Bytes bytes(file);
  if (const std::optional<Packets> packets = packets_of(bytes)) {
    return missing_of_transport_stream(bytes, *packets);
  }
  const std::string start = bytes.at(0, 4);
  if (start == kMatroska) return missing_of_matroska(bytes);
  if (start == kAvi) return missing_of_avi(bytes);
  if (start == kOgg) return check_ogg(bytes).missing;
  if (start == kFlv) return check_flv(bytes).missing;
  if (start == kAsf) return missing_of_asf(bytes);
  return is_mp4(bytes) ? missing_of_mp4(bytes) : "";
}

std::string damaged_parts(const fs::path& file) {
  Bytes bytes(file);
  if (const std::optional<Packets> packets = packets_of(bytes)) {
    return damage_of_transport_stream(bytes, *packets).text();
  }
  const std::string start = bytes.at(0, 4);
  if (start == kMatroska) return damage_of_matroska(bytes).text();
  if (start == kOgg) return check_ogg(bytes).damage.text();
  if (start == kFlv) return check_flv(bytes).damage.text();
  return is_mp4(bytes) ? damage_of_mp4(bytes).text() : "";
}

}  // namespace mtstereo::run
