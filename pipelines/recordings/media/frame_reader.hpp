// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "recordings/media/decoder_reports.hpp"
#include "recordings/media/frame_index.hpp"
#include "recordings/media/gst_objects.hpp"

namespace mtstereo::run {

/// The outcome of reading a frame.
enum class FrameState {
  kDecoded,
  kMissing,  ///< it cannot be decoded; later ones may be
  kEnd,      ///< neither it nor later ones can be decoded
};

/// A frame as its decoder gives it.
struct DecodedFrame {
  FrameState state = FrameState::kEnd;
  BufferPointer buffer;  ///< none unless it was decoded
  CapsPointer caps;      ///< of raw video in system memory
};

/// Decodes the frames of one source by their numbers in its index. Used by one thread at a time.
class FrameReader {
 public:
  FrameReader() = default;
  virtual ~FrameReader() = default;
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  /// Decodes a frame. Numbers that increase are fast.
  virtual DecodedFrame read(std::int64_t number) = 0;
  /// What the decoder reported about the last frame that was not decoded; may be empty.
  virtual const std::string& problem() const = 0;
  /// The frames up to the last one that was read that are not as they were coded, but those of
  /// earlier calls.
  virtual std::vector<DamagedFrame> take_damaged() = 0;
};

/// The reader of a source. Throws UserError if it cannot be opened. `index` must outlive it.
std::unique_ptr<FrameReader> open_reader(const Source& source, const FrameIndex& index);

/// The reader of a video file.
std::unique_ptr<FrameReader> open_video(const std::filesystem::path& file, const FrameIndex& index);
/// The reader of images; `unused_bits`: of their source.
std::unique_ptr<FrameReader> open_images(const std::vector<std::filesystem::path>& files,
                                         int unused_bits = 0);

}  // namespace mtstereo::run
