// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace mtstereo::calibrate {

/// Two images of one moment.
struct ImagePair {
  cv::Mat left;      ///< CV_8UC1
  cv::Mat right;     ///< CV_8UC1
  double time = 0;   ///< of the left image in its stream [s]; images count up
  std::string name;  ///< for messages: a file's name, or a time
};

/// How both images arrive.
enum class Arrangement {
  kTwoSources,  ///< one source for each side
  kSideBySide,  ///< one source: left half and right half
  kTopBottom,   ///< one source: left view above the right view
};

/// How frames of two sources find each other.
enum class Pairing {
  kTime,   ///< by time stamps, as mtstereo does it by default
  kIndex,  ///< the n-th of both
};

struct SourceOptions {
  /// Of each side; the second one is empty if both come from one source. A device (/dev/video0), a
  /// video file, a folder of images, a pattern of images (left/%04d.png, left/*.png), a URI, or
  /// a part of a gst-launch line whose end gives video.
  std::string left, right;
  Arrangement arrangement = Arrangement::kTwoSources;
  Pairing pairing = Pairing::kTime;
  cv::Size size;        ///< that devices are asked for [px]; empty = their default
  double rate = 0;      ///< that devices are asked for [1/s]; 0 = their default
  double timeout = 10;  ///< without a frame, a source has failed [s]
};

/// What next() returned.
enum class SourceState {
  kPair,     ///< the next pair
  kWaiting,  ///< no pair yet
  kEnd,      ///< there are no more pairs
};

/// A sequence of pairs.
class PairSource {
 public:
  PairSource() = default;
  virtual ~PairSource() = default;
  PairSource(const PairSource&) = delete;
  PairSource& operator=(const PairSource&) = delete;

  /// Waits for the next pair, but only for a part of a second. Throws UserError, which
  /// names the source, if it fails or does not deliver.
  virtual SourceState next(ImagePair& pair) = 0;
  /// Images, not video.
  virtual bool stills() const = 0;
  /// It never ends, and frames that are not taken are lost.
  virtual bool live() const { return false; }
};

/// Opens a source. Throws UserError.
std::unique_ptr<PairSource> open_source(const SourceOptions& options);

/// The files of a source: images, or a video; none for others. Throws UserError if a file
/// or folder does not exist, or never ends.
std::vector<std::filesystem::path> input_files(const SourceOptions& options);

/// Whether a source is a folder, a pattern or a file of images.
bool is_images(const std::string& source);

/// Both halves of an image. Throws UserError if it cannot be halved.
void split(const cv::Mat& image, Arrangement arrangement, ImagePair& pair);

std::unique_ptr<PairSource> open_images(const SourceOptions& options);
std::unique_ptr<PairSource> open_streams(const SourceOptions& options);

}  // namespace mtstereo::calibrate
