// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <utility>

#include "lib/outputs/user_error.hpp"
#include "recordings/media/container_bytes.hpp"
#include "recordings/media/matroska.hpp"

namespace mtstereo::run {
namespace {

using ebml::Element;

constexpr std::size_t kLongestHead = 1 << 20;

// The element at a place; std::nullopt if its start is not there.
std::optional<Element> element_at(std::string_view bytes, std::size_t at) {
  const auto start = ebml::start_of(bytes.substr(std::min(at, bytes.size())));
  if (!start) return std::nullopt;
  return Element{start->id, at + start->bytes, start->length};
}

// Reads what decides the frames from the elements of a track.
void read_track(std::string_view content, MatroskaTrack& track) {
  constexpr std::uint32_t kTrackEntry = 0xAE, kVideo = 0xE0, kWidth = 0xB0, kHeight = 0xBA,
                          kPeriod = 0x23E383, kPrivate = 0x63A2;
  for (std::size_t at = 0; const std::optional<Element> found = element_at(content, at);) {
    const std::string_view value = content.substr(found->content, found->length);
    if (found->id == kTrackEntry || found->id == kVideo) read_track(value, track);
    const std::uint64_t number = value.size() <= 8 ? big_endian(value) : 0;
    if (found->id == kWidth) track.width = static_cast<int>(number);
    if (found->id == kHeight) track.height = static_cast<int>(number);
    if (found->id == kPeriod) track.period = static_cast<Nanoseconds>(number);
    if (found->id == kPrivate) track.codec_private = std::string(value);
    at = found->content + found->length;
  }
}

// Reads names and texts from the elements of the tags.
void read_tags(std::string_view content, MatroskaTrack& track) {
  constexpr std::uint32_t kTag = 0x7373;
  for (std::size_t at = 0; const std::optional<Element> found = element_at(content, at);) {
    const std::string_view value = content.substr(found->content, found->length);
    if (found->id == ebml::kSimpleTag) track.tags.emplace_back();
    if (found->id == kTag || found->id == ebml::kSimpleTag) read_tags(value, track);
    if (!track.tags.empty()) {
      if (found->id == ebml::kTagName) track.tags.back().first = value;
      if (found->id == ebml::kTagString) track.tags.back().second = value;
    }
    at = found->content + found->length;
  }
}

// Reads everything before the first cluster and returns its length; 0 if it is not whole.
std::size_t read_head(std::string_view bytes, MatroskaTrack& track) {
  constexpr std::uint32_t kTracks = 0x1654AE6B;
  std::size_t at = 0;
  bool whole = false;
  while (const std::optional<Element> found = element_at(bytes, at)) {
    if (found->id == ebml::kCluster || found->id == ebml::kCues) break;
    if (found->id == ebml::kSegment) {
      at = found->content;
      continue;
    }
    if (found->length > bytes.size() - found->content) return 0;
    at = found->content + found->length;
    const std::string_view content = bytes.substr(found->content, found->length);
    if (found->id == kTracks) {
      read_track(content, track);
      whole = true;
    }
    if (found->id == ebml::kTags) read_tags(content, track);
  }
  return whole ? at : 0;
}

}  // namespace

MatroskaReader::MatroskaReader(std::filesystem::path file)
    : file_(std::move(file)), stream_(file_, std::ios::binary) {
  std::error_code error;
  size_ = std::filesystem::file_size(file_, error);
  std::string bytes(error ? 0 : std::min<std::uint64_t>(size_, kLongestHead), '\0');
  stream_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  position_ = error || !stream_ ? 0 : read_head(bytes, track_);
  if (position_ == 0 || ebml::head_of(track_).bytes.size() != position_) {
    throw UserError(file_.string() + ": is not a Matroska file of this program");
  }
}

// Reads the head of the next cluster, if the cluster is whole, and returns its time.
std::optional<Nanoseconds> MatroskaReader::head_of_next() {
  std::string head(ebml::kClusterHead, '\0');
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(position_));
  stream_.read(head.data(), static_cast<std::streamsize>(head.size()));
  std::uint64_t time = 0;
  if (!stream_ || !ebml::parse_cluster_head(head, length_, time)) return std::nullopt;
  if (length_ > size_ - position_) return std::nullopt;
  return static_cast<Nanoseconds>(time) * ebml::kTimeStep;
}

std::optional<Nanoseconds> MatroskaReader::skip() {
  const std::optional<Nanoseconds> time = head_of_next();
  if (time) position_ += length_;
  return time;
}

std::optional<MatroskaReader::Cluster> MatroskaReader::next() {
  const std::optional<Nanoseconds> time = head_of_next();
  if (!time) return std::nullopt;
  Cluster cluster;
  cluster.time = *time;
  cluster.bytes.resize(length_);
  stream_.seekg(static_cast<std::streamoff>(position_));
  stream_.read(cluster.bytes.data(), static_cast<std::streamsize>(length_));
  if (!stream_) throw UserError(file_.string() + ": cannot be read");
  position_ += length_;
  return cluster;
}

}  // namespace mtstereo::run
