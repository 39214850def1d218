// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "recordings/media/matroska_format.hpp"

// Matroska files with one video in FFV1. By hand on purpose: muxers write random ids and dates into
// them; these files depend on their frames and tags only, so that pieces that are joined are equal
// to one file that was written at once. Each frame is a key frame in a cluster of its own.

namespace mtstereo::run {

/// Writes a file.
class MatroskaWriter {
 public:
  /// Creates the file. Throws UserError.
  MatroskaWriter(std::filesystem::path file, const MatroskaTrack& track);
  /// Continues a file that was not finished, after its first `frames` frames, which it must have.
  /// Throws UserError.
  MatroskaWriter(std::filesystem::path file, std::int64_t frames);

  /// Appends a frame with a time [ns], which is greater than those before.
  void append(Nanoseconds time, std::string_view frame);
  /// Appends a cluster of another file of the same track.
  void append_cluster(Nanoseconds time, std::string_view cluster);
  /// Makes what was appended visible to readers of an unfinished file.
  void flush();
  /// Writes the index and the duration, and closes the file.
  void finish();

 private:
  struct Cue {
    std::uint64_t time, position;
  };
  void note_cluster(std::uint64_t time);
  void write(std::string_view bytes);
  void check() const;

  std::filesystem::path file_;
  std::fstream stream_;
  MatroskaTrack track_;
  std::vector<Cue> cues_;
  std::uint64_t position_ = 0;  // end of the file [bytes]
  std::uint64_t clusters_ = 0;
  std::uint64_t last_time_ = 0;
};

/// Reads the clusters of a file that MatroskaWriter wrote, also of one that is not finished.
class MatroskaReader {
 public:
  /// Throws UserError if the file is not one of these.
  explicit MatroskaReader(std::filesystem::path file);

  const MatroskaTrack& track() const { return track_; }

  struct Cluster {
    Nanoseconds time = 0;
    std::string bytes;  ///< the whole cluster
  };
  /// The next whole cluster; std::nullopt after the last one.
  std::optional<Cluster> next();
  /// Skips the next whole cluster and returns its time; std::nullopt after the last one.
  std::optional<Nanoseconds> skip();
  /// Where the next cluster begins [bytes].
  std::uint64_t position() const { return position_; }

 private:
  std::optional<Nanoseconds> head_of_next();

  std::filesystem::path file_;
  std::ifstream stream_;
  MatroskaTrack track_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;
  std::uint64_t length_ = 0;  // of the next cluster
};

}  // namespace mtstereo::run
