// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/matroska_format.hpp"

#include <bit>

#include "recordings/media/container_bytes.hpp"

namespace mtstereo::run::ebml {
namespace {

enum Id : std::uint32_t {
  kEbml = 0x1A45DFA3,
  kEbmlVersion = 0x4286,
  kEbmlReadVersion = 0x42F7,
  kEbmlMaxIdLength = 0x42F2,
  kEbmlMaxSizeLength = 0x42F3,
  kDocType = 0x4282,
  kDocTypeVersion = 0x4287,
  kDocTypeReadVersion = 0x4285,
  kSeekHead = 0x114D9B74,
  kSeek = 0x4DBB,
  kSeekId = 0x53AB,
  kSeekPosition = 0x53AC,
  kInfo = 0x1549A966,
  kTimestampScale = 0x2AD7B1,
  kDuration = 0x4489,
  kMuxingApp = 0x4D80,
  kWritingApp = 0x5741,
  kTracks = 0x1654AE6B,
  kTrackEntry = 0xAE,
  kTrackNumber = 0xD7,
  kTrackUid = 0x73C5,
  kTrackType = 0x83,
  kFlagLacing = 0x9C,
  kDefaultDuration = 0x23E383,
  kCodecId = 0x86,
  kCodecPrivate = 0x63A2,
  kVideo = 0xE0,
  kFlagInterlaced = 0x9A,
  kPixelWidth = 0xB0,
  kPixelHeight = 0xBA,
  kTimestamp = 0xE7,
  kTag = 0x7373,
  kTargets = 0x63C0,
  kSimpleBlock = 0xA3,
};

constexpr const char* kProgram = "mtstereo-run";

int bytes_of(std::uint64_t value) {
  int bytes = 1;
  while (bytes < 8 && value >> (8 * bytes) != 0) ++bytes;
  return bytes;
}

std::string id_text(std::uint32_t id) { return big_endian(id, bytes_of(id)); }

// A length in so many bytes.
std::string length_text(std::uint64_t length, int bytes) {
  return big_endian(length | std::uint64_t{1} << (7 * bytes), bytes);
}

std::string seek_entry(std::uint32_t id, std::uint64_t position) {
  return element(kSeek, element(kSeekId, id_text(id)) + number(kSeekPosition, position, 8));
}

std::string ebml_header() {
  return element(kEbml, number(kEbmlVersion, 1) + number(kEbmlReadVersion, 1) +
                            number(kEbmlMaxIdLength, 4) + number(kEbmlMaxSizeLength, 8) +
                            element(kDocType, "matroska") + number(kDocTypeVersion, 4) +
                            number(kDocTypeReadVersion, 2));
}

std::string tracks_of(const MatroskaTrack& track) {
  constexpr int kVideoType = 1, kProgressive = 2;
  const std::string video = number(kFlagInterlaced, kProgressive) +
                            number(kPixelWidth, static_cast<std::uint64_t>(track.width)) +
                            number(kPixelHeight, static_cast<std::uint64_t>(track.height));
  return element(kTracks,
                 element(kTrackEntry,
                         number(kTrackNumber, 1) + number(kTrackUid, 1) +
                             number(kTrackType, kVideoType) + number(kFlagLacing, 0) +
                             number(kDefaultDuration, static_cast<std::uint64_t>(track.period)) +
                             element(kCodecId, "V_FFV1") +
                             element(kCodecPrivate, track.codec_private) + element(kVideo, video)));
}

// Tags of the whole file.
std::string tags_of(const MatroskaTrack& track) {
  if (track.tags.empty()) return {};
  std::string tag = element(kTargets, "");
  for (const auto& [name, text] : track.tags) {
    tag += element(kSimpleTag, element(kTagName, name) + element(kTagString, text));
  }
  return element(kTags, element(kTag, tag));
}

}  // namespace

std::string big_endian(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

std::string element(std::uint32_t id, std::string_view content) {
  const int bytes = content.size() < 0x7f ? 1 : 4;
  return id_text(id) + length_text(content.size(), bytes) + std::string(content);
}

std::string number(std::uint32_t id, std::uint64_t value, int bytes) {
  return element(id, big_endian(value, bytes > 0 ? bytes : bytes_of(value)));
}

std::optional<Start> start_of(std::string_view bytes) {
  const auto width = [](std::string_view number) {  // by its first byte
    if (number.empty()) return std::size_t{9};
    return static_cast<std::size_t>(std::countl_zero(static_cast<unsigned char>(number[0]))) + 1;
  };
  const std::size_t id = width(bytes);
  if (id > 4 || id >= bytes.size()) return std::nullopt;
  const std::size_t length = width(bytes.substr(id));
  if (length > 8 || id + length > bytes.size()) return std::nullopt;
  const std::uint64_t most = (std::uint64_t{1} << (7 * length)) - 1;
  const std::uint64_t stated = run::big_endian(bytes.substr(id, length)) & most;
  return Start{static_cast<std::uint32_t>(run::big_endian(bytes.substr(0, id))), id + length,
               stated == most ? kUnknown : stated};
}

std::string cluster_head(std::uint64_t time, std::size_t frame) {
  constexpr std::size_t kBlockHead = 4;  // track, time and flags
  const std::string timestamp = number(kTimestamp, time, 8);
  const std::string block = id_text(kSimpleBlock) + length_text(frame + kBlockHead, 4) +
                            std::string{'\x81', '\0', '\0', '\x80'};
  return id_text(kCluster) + length_text(timestamp.size() + block.size() + frame, 5) + timestamp +
         block;
}

bool parse_cluster_head(std::string_view head, std::uint64_t& length, std::uint64_t& time) {
  if (head.size() < kClusterHead || run::big_endian(head.substr(0, 4)) != kCluster) return false;
  length = 9 + (run::big_endian(head.substr(4, 5)) & 0x7'ffff'ffff);
  time = run::big_endian(head.substr(11, 8));
  return true;
}

Head head_of(const MatroskaTrack& track) {
  constexpr std::size_t kSeekHeadLength = 3 * 21 + 5;
  const std::string tracks = tracks_of(track);
  std::string info = number(kTimestampScale, static_cast<std::uint64_t>(kTimeStep)) +
                     element(kMuxingApp, kProgram) + element(kWritingApp, kProgram) +
                     element(kDuration, std::string(8, '\0'));
  info = element(kInfo, info);
  const std::string seeks = element(
      kSeekHead, seek_entry(kInfo, kSeekHeadLength) +
                     seek_entry(kTracks, kSeekHeadLength + info.size()) + seek_entry(kCues, 0));
  Head head;
  // Until the end the length of the segment is unknown.
  head.bytes = ebml_header() + id_text(kSegment) + big_endian(0x01ff'ffff'ffff'ffff, 8);
  head.segment = head.bytes.size();
  head.segment_size = head.segment - 8;
  head.bytes += seeks;
  head.cues = head.bytes.size() - 8;
  head.bytes += info;
  head.duration = head.bytes.size() - 8;
  head.bytes += tracks + tags_of(track);
  return head;
}

}  // namespace mtstereo::run::ebml
