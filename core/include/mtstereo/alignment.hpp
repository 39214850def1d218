// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "mtstereo/export.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/result.hpp"

namespace mtstereo {

/// The row displacement of the right view: a point of the scene in row y of the left view appears
/// in row y + displacement(x, y) of the right view, where x is its column in the right view. A
/// perfectly rectified pair has the field zero.
///
/// The terms count px. u and v are the distances from the center of the image to the right and
/// downwards, divided by half of the width: u = -1 .. 1. A field belongs to one image size.
struct MTSTEREO_API RowField {
  double offset = 0;   ///< everywhere the same [px]
  double roll = 0;     ///< times u [px]: rotation about the optical axis
  double stretch = 0;  ///< times v [px]: different focal lengths
  double product = 0;  ///< times u v [px]: rotation about the vertical axis
  double square = 0;   ///< times v v [px]: rotation about the horizontal axis

  /// The displacement at a point of an image of this size [px].
  double displacement(double x, double y, int width, int height) const noexcept;
  /// Root mean square of the displacement over an image of this size [px].
  double rms(int width, int height) const noexcept;
  /// Largest absolute displacement in an image of this size [px].
  double largest(int width, int height) const noexcept;
  /// The angle that `roll` corresponds to in an image of this width [degrees], positive if the
  /// right view has its right side lower.
  double roll_degrees(int width) const noexcept;

  /// The five terms in the order of the members, separated by commas, as in "0.5,-0.1,0,0,0". The
  /// text gives the same values again when it is parsed.
  std::string to_text() const;
  /// Reads what to_text() wrote. Fails with kInvalidParameter unless the text has five numbers
  /// between -kLargestFieldTerm and kLargestFieldTerm.
  static Result<RowField> parse(std::string_view text) noexcept;

  /// True if all terms are equal.
  friend bool operator==(const RowField&, const RowField&) = default;
};

/// Largest absolute value of a term of a RowField [px].
inline constexpr double kLargestFieldTerm = 100;

/// Largest sigma of a ViewCorrection's blur [px].
inline constexpr float kLargestBlur = 3;

/// What a Matcher does to the views before it matches them. The default does nothing.
struct ViewCorrection {
  /// The rows of the right view are resampled by this field. A roll of more than 0.1 degrees also
  /// moves the rows sideways, and a stretch of more than 0.3 % the columns.
  RowField rows;
  float left_blur = 0;   ///< sigma of the Gaussian that blurs the left view [px], 0 = none
  float right_blur = 0;  ///< sigma of the Gaussian that blurs the right view [px], 0 = none

  /// True if both do the same.
  friend bool operator==(const ViewCorrection&, const ViewCorrection&) = default;
};

/// Why one inspection of a pair gave a row field, or none.
enum class FieldStatus {
  kNotInspected,     ///< there was no inspection yet
  kTrusted,          ///< PairFindings::field is the field of the pair
  kImageTooSmall,    ///< the image has fewer than 96 columns or 64 rows
  kTooFewCorners,    ///< the left view has too little texture
  kTooFewMatches,    ///< too few corners were found again in the right view, at one place only
  kRepeatedPattern,  ///< many corners were found at several places: the texture repeats itself
  kTooFewInliers,    ///< too many matches disagree with every smooth field
  kTooScattered,     ///< the matches scatter too much about the field
  kTooConcentrated,  ///< the matches cover too small a part of the image
  kTooUncertain,     ///< the predicted error of the field is too large
  /// The left view is the right one: most disparities are below the smallest one, and the views are
  /// aligned in the other order.
  kSwapped,
};

/// A short English text for a status, as in "too few matches". The string is static.
MTSTEREO_API const char* field_status_text(FieldStatus status) noexcept;

/// The result of the inspection of one pair.
struct PairFindings {
  FieldStatus status = FieldStatus::kNotInspected;  ///< whether `field` can be trusted, or why not
  int candidates = 0;       ///< corners of the left view that were searched in the right one
  int matches = 0;          ///< corners that were found
  int inliers = 0;          ///< matches that agree with the field within 1 px
  double inlier_share = 0;  ///< inliers / matches, 0 .. 1
  double negative_share =
      0;  ///< fraction of the inliers that are 1 px below the smallest disparity, 0 .. 1
  double residual = 0;  ///< robust standard deviation of the inliers about the field [px]
  /// The smallest field that explains the matches; terms that are not needed are 0. All are 0
  /// without trust.
  RowField field;
  int terms = 0;         ///< number of terms in use: 0, 1 (offset), 3 (with roll, stretch) or 5
  double deviation = 0;  ///< predicted standard deviation of the field where it is largest [px]
  /// Sharpness of the left view divided by the sharpness of the right one; 1 if they are equal, 0
  /// if unknown.
  double sharpness_ratio = 0;
  float left_blur = 0;  ///< sigma of the blur that makes the left view as blurred as the right [px]
  float right_blur = 0;  ///< the same for the right view [px]; at least one of the two is 0
};

/// What can be wrong with the two streams of views.
enum class PairProblem {
  kSwapped,           ///< the left view is the right one
  kNotAPair,          ///< hardly any point matches, as in views of different scenes
  kOutOfStep,         ///< the matches disagree about rows, as in views of different times
  kSharpnessDiffers,  ///< one view is less sharp: focus, or dirt on the lens
  kLeftBlank,         ///< the left view has one gray value only, as with a covered lens
  kRightBlank,        ///< the right view has one gray value only
  kLeftFrozen,        ///< the left view repeats itself while the right one changes
  kRightFrozen,       ///< the right view repeats itself while the left one changes
};
/// Number of problems.
inline constexpr int kPairProblems = static_cast<int>(PairProblem::kRightFrozen) + 1;

/// The name of a problem for programs, as in "out-of-step". The string is static.
MTSTEREO_API const char* problem_name(PairProblem problem) noexcept;
/// One English sentence about a problem: what was found and what to do. The string is static.
MTSTEREO_API const char* problem_text(PairProblem problem) noexcept;

/// Finds the correction that a stereo camera needs from its own images, and what is wrong with
/// them. docs/alignment.md describes how, and the limits: a shift of all disparities, as by a
/// rotation about the vertical axis, cannot be seen.
///
/// Call watch() for every pair and inspect() from time to time, for the first pair and then for
/// example for every 30th. The result depends on the pairs and the order of the calls only. A
/// tracker has no threads and may be used by one thread at a time. watch() allocates nothing;
/// inspect() allocates only if a pair needs more memory than all before.
///
/// How estimates become a correction:
/// - The first trusted one applies at once. Later ones are combined with it and refine it.
/// - Estimates of an unchanged scene share the same errors, so together they count as one.
/// - An estimate that differs from the correction by more than 0.3 px (rms) withdraws it; a
///   correction of three or more views needs two such estimates in succession. The next correction
///   needs three successive estimates that agree.
/// - A field of less than 0.1 px (rms) is not corrected.
class MTSTEREO_API AlignmentTracker {
 public:
  /// Creates a tracker that has seen nothing. Fails with kOutOfMemory.
  static Result<AlignmentTracker> create() noexcept;

  /// Moves a tracker. The source can only be assigned to or destroyed afterwards.
  AlignmentTracker(AlignmentTracker&&) noexcept;
  /// Moves a tracker. The source can only be assigned to or destroyed afterwards.
  AlignmentTracker& operator=(AlignmentTracker&&) noexcept;
  ~AlignmentTracker();

  /// Checks a pair for blank and frozen views; it reads a small part of the pixels. Fails with
  /// kInvalidImage or kSizeMismatch.
  Status watch(GrayView left, GrayView right) noexcept;

  /// Estimates the row field and the sharpness of a pair, and updates the correction. Pass the
  /// views as the cameras deliver them, without the correction. Disparities up to `max_disparity`
  /// [px] are searched, which must be positive. A new image size forgets everything, as reset()
  /// does. Fails with kInvalidImage, kSizeMismatch, kInvalidParameter, kOutOfMemory or kSystem; a
  /// pair that gives no trusted field is a success.
  Status inspect(GrayView left, GrayView right, int max_disparity) noexcept;
  /// The same for a stereo camera with negative disparities: those from `min_disparity`
  /// (Parameter::kMinDisparity) on are searched, and are not taken for swapped views.
  Status inspect(GrayView left, GrayView right, int max_disparity, int min_disparity) noexcept;

  /// The result of the last inspection.
  const PairFindings& findings() const noexcept;

  /// The correction for the next pairs.
  const ViewCorrection& correction() const noexcept;

  /// Whether the row field of correction() is confirmed: by trusted estimates that agree, or
  /// because it was restored and no estimate contradicts it. A confirmed field can be zero.
  bool trusted() const noexcept;

  /// Number of inspections of different scenes that correction() is made of.
  int views() const noexcept;

  /// Whether the streams have this problem now. A problem that follows from another one is left
  /// out: a blank or frozen view explains everything else.
  bool has(PairProblem problem) const noexcept;

  /// Starts with a field that an earlier run stored, as if reset() had been called before. It
  /// applies until three successive estimates agree on another one. Fails with kInvalidParameter if
  /// a term is not a number between -kLargestFieldTerm and kLargestFieldTerm.
  Status restore(const RowField& field) noexcept;

  /// Forgets everything, as for another camera or after a seek.
  void reset() noexcept;

 private:
  struct State;
  explicit AlignmentTracker(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace mtstereo
