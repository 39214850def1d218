// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "recordings/media/source.hpp"

// The elements of the files of MatroskaWriter: an id, a length and the content (RFC 8794, RFC
// 9559).

namespace mtstereo::run {

/// The video of a file.
struct MatroskaTrack {
  int width = 0, height = 0;  ///< [px]
  Nanoseconds period = 0;     ///< of its frames [ns]
  std::string codec_private;  ///< the configuration of the decoder
  /// What describes the file: names in capitals with their texts, in UTF-8.
  std::vector<std::pair<std::string, std::string>> tags;
  bool operator==(const MatroskaTrack&) const = default;
};

}  // namespace mtstereo::run

namespace mtstereo::run::ebml {

inline constexpr std::uint32_t kSegment = 0x18538067;
inline constexpr std::uint32_t kCluster = 0x1F43B675;
inline constexpr std::uint32_t kCues = 0x1C53BB6B;
inline constexpr std::uint32_t kTags = 0x1254C367;
inline constexpr std::uint32_t kSimpleTag = 0x67C8;
inline constexpr std::uint32_t kTagName = 0x45A3;
inline constexpr std::uint32_t kTagString = 0x4487;
inline constexpr Nanoseconds kTimeStep = 1000;  ///< of time stamps in the file [ns]

/// A number of the file's format, which big_endian(bytes) reads.
std::string big_endian(std::uint64_t value, int bytes);

/// An element whose content is text or other elements.
std::string element(std::uint32_t id, std::string_view content);
/// An element with a number, in as few bytes as possible or in exactly so many.
std::string number(std::uint32_t id, std::uint64_t value, int bytes = 0);

/// The start of an element.
struct Start {
  std::uint32_t id = 0;
  std::size_t bytes = 0;     ///< of id and length: the content begins after them
  std::uint64_t length = 0;  ///< of the content [bytes]; kUnknown: up to the next of its level
};
/// More than any length that can be stated.
inline constexpr std::uint64_t kUnknown = (std::uint64_t{1} << 56) - 1;
/// The element at the beginning of these bytes; std::nullopt if its start is not there.
std::optional<Start> start_of(std::string_view bytes);

/// An element at a place.
struct Element {
  std::uint32_t id = 0;
  std::uint64_t content = 0;  ///< where it begins
  std::uint64_t length = 0;   ///< as Start::length

  std::uint64_t end() const { return length == kUnknown ? kUnknown : content + length; }
};

/// The first bytes of a cluster, and those of its frame before the coded data.
std::string cluster_head(std::uint64_t time, std::size_t frame);
/// The length of cluster_head().
inline constexpr std::size_t kClusterHead = 28;
/// The length and the time in a cluster_head(); false if it is not one.
bool parse_cluster_head(std::string_view head, std::uint64_t& length, std::uint64_t& time);

/// Everything before the first cluster. The values that are known at the end have a fixed length
/// and place.
struct Head {
  std::string bytes;
  std::size_t segment = 0;       ///< where the content of the segment begins
  std::size_t segment_size = 0;  ///< where its length is: 8 bytes
  std::size_t cues = 0;          ///< where the place of the cues is: 8 bytes
  std::size_t duration = 0;      ///< where the duration is: 8 bytes
};
Head head_of(const MatroskaTrack& track);

}  // namespace mtstereo::run::ebml
