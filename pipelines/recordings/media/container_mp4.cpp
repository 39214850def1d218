// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/container_mp4.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "lib/outputs/printable.hpp"

namespace mtstereo::run {
namespace {

// A part of a file, with length and name; boxes contain others.
struct Box {
  std::string name;
  std::uint64_t start = 0, data = 0;  // positions of the box and of what it contains
  std::uint64_t end = 0;              // of the box, as it states
};

// The box at a position; std::nullopt if there is no whole head of one.
std::optional<Box> box_at(Bytes& bytes, std::uint64_t start) {
  const std::string head = bytes.at(start, 8);
  if (head.empty()) return std::nullopt;
  Box box{head.substr(4), start, start + 8, 0};
  std::uint64_t length = big_endian(head.substr(0, 4));
  if (length == 1) {
    const std::string large = bytes.at(start + 8, 8);
    if (large.empty()) return std::nullopt;
    length = big_endian(large);
    box.data += 8;
  }
  if (length == 0) length = bytes.size() - start;  // to the end of the file
  box.end = exceeds(start, length, UINT64_MAX) ? UINT64_MAX : start + length;
  return box;
}

struct Sizes {
  std::uint64_t position = 0;  // of the table
  std::uint64_t sum = 0;       // of the frames of a track [bytes]
};

// Of a table of sizes: version and flags, a size for all or 0, the number of frames, their sizes.
Sizes sizes_of(Bytes& bytes, const Box& table) {
  constexpr std::uint64_t kHead = 12, kSize = 4;
  const std::string head = bytes.at(table.data, kHead);
  if (head.empty()) return {};
  const std::uint64_t common = big_endian(head.substr(4, 4)), count = big_endian(head.substr(8));
  if (common != 0) return {table.data, common * count};
  Sizes sizes{table.data, 0};
  const std::uint64_t space = table.end - std::min(table.end, table.data + kHead);
  const std::string all = bytes.up_to(table.data + kHead, std::min(space, count * kSize));
  for (std::size_t at = 0; at + kSize <= all.size(); at += kSize) {
    sizes.sum += big_endian(std::string_view(all).substr(at, kSize));
  }
  return sizes;
}

// The table of each track is in one of these boxes in the other.
constexpr std::array<std::string_view, 5> kNested{"trak", "mdia", "minf", "stbl", "stsz"};

// Visits the boxes between two positions for those of a level of kNested.
void read_sizes(Bytes& bytes, std::uint64_t from, std::uint64_t to, std::size_t level,
                std::vector<Sizes>& found) {
  while (from < to) {
    const std::optional<Box> box = box_at(bytes, from);
    if (!box || box->end < box->data || box->end > to) return;
    const bool is_table = level + 1 == kNested.size();
    if (box->name == kNested[level]) {
      if (is_table) found.push_back(sizes_of(bytes, *box));
      if (!is_table) read_sizes(bytes, box->data, box->end, level + 1, found);
    }
    from = box->end;
  }
}

}  // namespace

bool is_mp4(Bytes& bytes) {
  constexpr std::array<std::string_view, 6> kFirst{"ftyp", "moov", "mdat", "wide", "free", "skip"};
  return std::find(kFirst.begin(), kFirst.end(), bytes.at(4, 4)) != kFirst.end();
}

bool second_view_in_mp4(Bytes& bytes) {
  constexpr std::uint64_t kMost = 1 << 20;  // the descriptions of the streams are at the beginning
  for (std::uint64_t start = 0; start < bytes.size();) {
    const std::optional<Box> box = box_at(bytes, start);
    if (!box || box->end < box->data) return false;
    if (box->name == "moov") {
      const std::string index = bytes.up_to(box->data, std::min(box->end - box->data, kMost));
      return index.find("lhvC") != std::string::npos;  // the configuration of the second layer
    }
    start = box->end;
  }
  return false;
}

std::string missing_of_mp4(Bytes& bytes) {
  bool has_index = false;
  for (std::uint64_t start = 0; start < bytes.size();) {
    const std::optional<Box> box = box_at(bytes, start);
    if (!box) return "it ends within the header of a box";
    has_index |= box->name == "moov";
    if (box->end < box->data) return "it has a box with an impossible length";
    if (box->end > bytes.size()) {
      return lacks(box->end - bytes.size(), "its box '" + outputs::printable(box->name) + "'");
    }
    start = box->end;
  }
  return has_index ? "" : "its index (box 'moov') is missing: the recorder has not closed it";
}

DamagedParts damage_of_mp4(Bytes& bytes) {
  std::vector<Sizes> tracks;
  std::uint64_t data = 0;
  for (std::uint64_t start = 0; start < bytes.size();) {
    const std::optional<Box> box = box_at(bytes, start);
    if (!box || box->end < box->data || box->end > bytes.size()) return {};
    if (box->name == "mdat") data += box->end - box->data;
    if (box->name == "moov") read_sizes(bytes, box->data, box->end, 0, tracks);
    start = box->end;
  }
  DamagedParts damage;
  for (const Sizes& track : tracks) {
    if (track.sum > data) damage.add(track.position, "frames have more bytes than the file");
  }
  return damage;
}

}  // namespace mtstereo::run
