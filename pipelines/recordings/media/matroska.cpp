// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/matroska.hpp"

#include <bit>
#include <utility>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::run {
namespace {

constexpr std::uint64_t kClustersPerCue = 32;

constexpr auto kNew = std::ios::in | std::ios::out | std::ios::binary | std::ios::trunc;
constexpr auto kOld = std::ios::in | std::ios::out | std::ios::binary;

std::uint64_t steps_of(Nanoseconds time) {
  return static_cast<std::uint64_t>((time + ebml::kTimeStep / 2) / ebml::kTimeStep);
}

std::string cue_element(std::uint64_t time, std::uint64_t position) {
  constexpr std::uint32_t kCuePoint = 0xBB, kCueTime = 0xB3, kCueTrackPositions = 0xB7,
                          kCueTrack = 0xF7, kCueClusterPosition = 0xF1;
  return ebml::element(
      kCuePoint,
      ebml::number(kCueTime, time) +
          ebml::element(kCueTrackPositions,
                        ebml::number(kCueTrack, 1) + ebml::number(kCueClusterPosition, position)));
}

}  // namespace

MatroskaWriter::MatroskaWriter(std::filesystem::path file, const MatroskaTrack& track)
    : file_(std::move(file)), stream_(file_, kNew), track_(track) {
  write(ebml::head_of(track).bytes);
  check();
}

MatroskaWriter::MatroskaWriter(std::filesystem::path file, std::int64_t frames)
    : file_(std::move(file)) {
  MatroskaReader reader(file_);
  track_ = reader.track();
  position_ = reader.position();
  for (std::int64_t i = 0; i < frames; ++i) {
    const std::optional<Nanoseconds> time = reader.skip();
    if (!time) throw UserError(file_.string() + ": ends too early");
    note_cluster(steps_of(*time));
    position_ = reader.position();
  }
  std::filesystem::resize_file(file_, position_);
  stream_.open(file_, kOld);
  stream_.seekp(0, std::ios::end);
  check();
}

void MatroskaWriter::check() const {
  if (stream_.good()) return;
  throw write_error(file_);
}

void MatroskaWriter::write(std::string_view bytes) {
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  position_ += bytes.size();
}

// Notes a cluster that begins at position_.
void MatroskaWriter::note_cluster(std::uint64_t time) {
  if (clusters_ % kClustersPerCue == 0) cues_.push_back({time, position_});
  ++clusters_;
  last_time_ = time;
}

void MatroskaWriter::append(Nanoseconds time, std::string_view frame) {
  const std::uint64_t steps = steps_of(time);
  note_cluster(steps);
  write(ebml::cluster_head(steps, frame.size()));
  write(frame);
  check();
}

void MatroskaWriter::append_cluster(Nanoseconds time, std::string_view cluster) {
  note_cluster(steps_of(time));
  write(cluster);
  check();
}

void MatroskaWriter::flush() {
  stream_.flush();
  check();
}

void MatroskaWriter::finish() {
  const ebml::Head head = ebml::head_of(track_);
  const std::uint64_t cues_at = position_ - head.segment;
  std::string points;
  for (const Cue& cue : cues_) points += cue_element(cue.time, cue.position - head.segment);
  write(ebml::element(ebml::kCues, points));
  const auto patch = [this](std::size_t at, std::uint64_t value) {
    const std::string bytes = ebml::big_endian(value, 8);
    stream_.seekp(static_cast<std::streamoff>(at));
    stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  };
  const double duration = static_cast<double>(last_time_ + steps_of(track_.period));
  patch(head.duration, std::bit_cast<std::uint64_t>(duration));
  patch(head.cues, cues_at);
  patch(head.segment_size, (position_ - head.segment) | std::uint64_t{1} << 56);
  stream_.close();
  check();
}

}  // namespace mtstereo::run
