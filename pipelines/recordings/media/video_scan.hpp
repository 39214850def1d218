// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "recordings/media/decoder_reports.hpp"

struct _GstSample;

namespace mtstereo::run {

/// How far a reader processes the frames of a file.
enum class Reading {
  kCoded,    ///< demultiplexed and parsed, in the order of the file
  kDecoded,  ///< decoded, in the order in which they are shown
  kGray,     ///< decoded and converted to 8-bit gray
};

/// A frame of a video file.
struct VideoFrame {
  /// As a seek takes it; none if the file does not state it [ns].
  std::optional<Nanoseconds> time;
  /// When it is decoded, by a clock of its own; only with Reading::kCoded, none if the file does
  /// not state it [ns].
  std::optional<Nanoseconds> decoding_time;
  bool keyframe = false;
  bool discontinuous = false;        ///< data before it, and in the same segment, is missing
  std::vector<std::uint8_t> pixels;  ///< row by row without padding, only with Reading::kGray
};

/// What the caps of a video state.
struct VideoFormat {
  int width = 0, height = 0;  ///< [px]
  double frame_rate = 0;      ///< [1/s]; 0 if it is variable or unknown
  std::string media;          ///< such as "video/x-h264"
  std::string codec;          ///< such as "H.264 (High Profile)"
};

/// Reads the first video stream of a file by GStreamer, for the index of frames and for their
/// pixels: both have the same times. Decoders in hardware are not used: their results differ from
/// machine to machine.
///
/// The times are those of the stream. In Matroska they are the time stamps: its demultiplexer
/// starts with a segment of the first video frame and continues with one of the first sound, so
/// that the stream time of a frame would depend on where the decoding started.
class VideoScan {
 public:
  /// Opens the file. Throws UserError if GStreamer cannot be used.
  VideoScan(std::filesystem::path file, Reading reading);
  ~VideoScan();
  VideoScan(const VideoScan&) = delete;
  VideoScan& operator=(const VideoScan&) = delete;

  /// The next frame that is shown; std::nullopt at the end, also if that is because of an error.
  std::optional<VideoFrame> next();
  /// The frame that next() has returned last, with its caps; null before. Valid until the next call
  /// of next() or seek().
  _GstSample* sample() const;
  /// Continues at the last keyframe at or before this time, as exactly as the file allows. Frames
  /// that refer to others are decoded from a keyframe on only. Damage of frames before `wanted` is
  /// not reported. False if it cannot.
  bool seek(Nanoseconds time, Nanoseconds wanted);
  bool seek(Nanoseconds time) { return seek(time, time); }
  /// Takes out the frames up to this time that the decoder could not decode as they were coded.
  std::vector<DamagedFrame> take_damaged_until(Nanoseconds time);
  /// The format of the last frame.
  const VideoFormat& format() const;
  /// How players turn the last frame, such as "rotate-180"; empty if they do not.
  std::string turning() const;
  /// Whether the first frame of the file is a keyframe, also if it is not shown.
  bool starts_with_keyframe() const;
  /// Why there are no more frames: a sentence without the name of the file; empty at the regular
  /// end.
  const std::string& error() const;
  /// How many streams of the file have video, as far as it was read.
  int video_streams() const;
  /// The length that the file states [ns]; none if it does not. Known after the first frame.
  std::optional<Nanoseconds> duration() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mtstereo::run
