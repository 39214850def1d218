// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/container_pages.hpp"

#include <map>

extern "C" {
#include <libavutil/bswap.h>
#include <libavutil/crc.h>
}

namespace mtstereo::run {
namespace {

constexpr std::string_view kPage = "OggS";
constexpr std::size_t kPageHead = 27;

// The length of a page from its head and the lengths of its segments.
std::uint64_t length_of(Bytes& bytes, std::uint64_t start, const std::string& head) {
  const std::uint64_t count = big_endian(head.substr(26, 1));
  std::uint64_t length = kPageHead + count;
  for (const char each : bytes.up_to(start + kPageHead, count)) {
    length += static_cast<unsigned char>(each);
  }
  return length;
}

bool has_its_checksum(std::string page) {
  constexpr std::size_t kPlace = 22, kBytes = 4;
  const std::uint64_t stated = little_endian(page.substr(kPlace, kBytes));
  page.replace(kPlace, kBytes, kBytes, '\0');
  const std::uint32_t sum = av_crc(av_crc_get_table(AV_CRC_32_IEEE), 0,
                                   reinterpret_cast<const std::uint8_t*>(page.data()), page.size());
  return av_bswap32(sum) == stated;
}

// The position of the next page; the size of the file if there is none.
std::uint64_t next_page(Bytes& bytes, std::uint64_t from) {
  constexpr std::size_t kAtOnce = 1 << 16;
  for (; from < bytes.size(); from += kAtOnce) {
    const std::size_t found = bytes.up_to(from, kAtOnce + kPage.size()).find(kPage);
    if (found != std::string::npos) return from + found;
  }
  return bytes.size();
}

}  // namespace

PagesCheck check_ogg(Bytes& bytes) {
  constexpr int kFirst = 2, kLast = 4;
  PagesCheck check;
  std::map<std::uint64_t, std::uint64_t> numbers;  // of the next pages of the streams
  for (std::uint64_t start = 0; start < bytes.size();) {
    const std::string head = bytes.at(start, kPageHead);
    if (head.empty()) {
      check.missing = "it ends within the header of a page";
      return check;
    }
    const std::uint64_t length = head.starts_with(kPage) ? length_of(bytes, start, head) : 0;
    if (length > 0 && exceeds(start, length, bytes.size()) &&
        next_page(bytes, start + 1) == bytes.size()) {
      check.missing = lacks(length - (bytes.size() - start), "its last page");
      return check;
    }
    if (length == 0 || exceeds(start, length, bytes.size()) ||
        !has_its_checksum(bytes.at(start, length))) {
      check.damage.add(start, "there is no page of Ogg with its checksum");
      start = next_page(bytes, start + 1);
      continue;
    }
    const std::uint64_t stream = little_endian(head.substr(14, 4));
    const std::uint64_t number = little_endian(head.substr(18, 4));
    const auto expected = numbers.find(stream);
    const bool follows = expected == numbers.end() || expected->second == number;
    if (!follows && (head[5] & kFirst) == 0) {
      check.damage.add(start, "pages before this one are missing");
    }
    numbers[stream] = number + 1;
    if ((head[5] & kLast) != 0) numbers.erase(stream);
    start += length;
  }
  if (!numbers.empty()) check.missing = "its last page is missing";
  return check;
}

PagesCheck check_flv(Bytes& bytes) {
  constexpr std::uint64_t kTagHead = 11, kTail = 4;
  PagesCheck check;
  std::uint64_t start = big_endian(bytes.at(5, 4)) + kTail;
  while (start < bytes.size()) {
    const std::string head = bytes.at(start, kTagHead);
    if (head.empty()) {
      check.missing = "it ends within the header of a tag";
      return check;
    }
    const std::uint64_t length = big_endian(head.substr(1, 3));
    const int kind = head[0] & 0x1f;
    if (kind != 8 && kind != 9 && kind != 18) {
      check.damage.add(start, "there is no tag of FLV");
      return check;
    }
    const std::uint64_t end = start + kTagHead + length;
    if (end > bytes.size()) {
      check.missing = lacks(end - bytes.size(), "a tag");
      return check;
    }
    // Some programs state another length, or none.
    const std::string tail = bytes.at(end, kTail);
    const std::uint64_t stated = tail.empty() ? 0 : big_endian(tail);
    if (stated != 0 && (stated < length || stated > length + kTagHead)) {
      check.damage.add(start, "the two lengths of a tag differ");
      return check;
    }
    start = end + kTail;
  }
  return check;
}

}  // namespace mtstereo::run
