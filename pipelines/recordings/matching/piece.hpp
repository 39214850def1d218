// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mtstereo/geometry/calibration.hpp"
#include "recordings/clocks/frame_pairs.hpp"

namespace mtstereo::run {

/// Outputs for each pair.
enum class Product {
  kDisparity,
  kDepth,
  kColor,
  kConfidence,
  kCloud,
  kRectifiedLeft,   ///< the left view as it is matched, in color if the input is
  kRectifiedRight,  ///< the right view
};
/// All of them.
inline constexpr std::array kAllProducts{
    Product::kDisparity, Product::kDepth,         Product::kColor,         Product::kConfidence,
    Product::kCloud,     Product::kRectifiedLeft, Product::kRectifiedRight};

/// How maps are stored.
enum class MapFormat {
  kMatroska,  ///< one file with FFV1, lossless
  kPng,       ///< one file per map, 16 bits (confidence: 8)
  kPfm,       ///< one file per map, floating point: px, m; not for confidence and color
};

/// The job for a recording: products and settings.
struct WorkOptions {
  std::vector<Product> products{Product::kDisparity};
  MapFormat format = MapFormat::kMatroska;
  /// Properties of mtstereo, such as {"mode", "dense"}, checked before the run.
  std::vector<std::pair<std::string, std::string>> parameters;
  double near = 0;            ///< nearer depths and points are left out [m]
  std::optional<double> far;  ///< farther ones [m], 0: no limit; none: default_far() for clouds
  int threads = 0;            ///< of mtstereo; 0: all
};

/// The rectified pair that is matched, as the calibration gives it.
struct ViewGeometry {
  Rectification views;  ///< without its rotations
  std::string format;   ///< of the calibration: StereoCalibration::format
  bool operator==(const ViewGeometry&) const = default;
};

/// A recording with all that decides the results: whoever processes a piece of it, and on which
/// machine, gets the same bytes.
struct Work {
  Recording recording;
  FrameIndex left;   ///< of the source of the left view, or of the one with both views
  FrameIndex right;  ///< of the source of the right view; empty if there is none
  std::optional<ClockEstimate> clocks;  ///< none: the frames' times count as they are
  PairList pairs;
  WorkOptions options;
  Nanoseconds period = 0;  ///< of the output; the n-th pair has the time n * period [ns]
  std::optional<ViewGeometry> geometry;  ///< none: without a calibration
  /// The correction of the views, measured once on pairs from the whole recording, as properties
  /// of mtstereo. It does not change within the recording.
  std::vector<std::pair<std::string, std::string>> correction;
  std::vector<std::string> remarks;  ///< about clocks, alignment, damage: sentences for the user
  std::string doubt;  ///< why the results are useless, with the remedy; empty if they can be used
};

/// Some successive pairs of a recording.
struct Range {
  std::int64_t first = 0, count = 0;
};

/// The figures of one pair.
struct FrameFigures {
  std::int64_t pair = 0;  ///< number in the recording
  FramePair frames;
  double density = 0;           ///< pixels with a disparity [0 .. 1]
  double median_disparity = 0;  ///< of these [px]
  double matching_ms = 0;       ///< time of the matcher; not compared when pieces are joined
};

/// The outcome of a piece.
struct PieceReport {
  std::vector<FrameFigures> frames;
  std::vector<std::string> files;          ///< relative to the folder of results, sorted
  std::vector<std::uintmax_t> file_bytes;  ///< their sizes
  std::string damage;                      ///< where the input ended early; empty if it did not
};

/// Called from the processing thread after each pair; returns false to stop the run.
using Progress = std::function<bool(std::int64_t done, std::int64_t total, double milliseconds)>;

/// Reads the recording's indexes, clocks, pairs and correction. `relation`: given by hand; none:
/// estimated if `estimate` is set, otherwise the frames' times count as they are. Throws UserError.
Work prepare(const Recording& recording, const WorkOptions& options,
             const std::optional<ClockRelation>& relation, bool estimate);

/// The report of a piece in its folder, for read_piece(). process() writes it last: a folder that
/// has it is whole.
inline constexpr const char* kPieceFile = "piece.json";

/// How to treat results, or a plan, that the folder already has. Only files that this
/// program wrote are ever replaced; for anything else in the way, UserError is thrown.
enum class Existing {
  kRefuse,    ///< throws UserError
  kContinue,  ///< keeps what was done of an equal work; throws UserError if it is another one
  kReplace,   ///< starts over
};

/// Processes pairs and writes the files of this piece and its report, kPieceFile, into `folder`,
/// which is created. Files are written into a folder in it and renamed when they are whole. Throws
/// UserError, also if `progress` stops the run; what is in `folder` itself then is whole.
PieceReport process(const Work& work, Range range, const std::filesystem::path& folder,
                    const Progress& progress, Existing existing = Existing::kRefuse);

/// Joins pieces, which must cover the recording without a gap, into `folder`: the same bytes as one
/// piece that covers all, and the same report, kPieceFile. Throws UserError.
PieceReport join(const Work& work, const std::vector<Range>& ranges,
                 const std::vector<std::filesystem::path>& pieces,
                 const std::filesystem::path& folder);

}  // namespace mtstereo::run
