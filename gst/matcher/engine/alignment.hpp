// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "matcher/engine/inspection.hpp"
#include "mtstereo/alignment.hpp"
#include "mtstereo/matcher.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo::plugin {

/// The property `alignment`: what is done about rows of the right view that are out of place.
enum class Alignment {
  kOff,      ///< nothing; the views are not inspected
  kMonitor,  ///< the views are inspected and the findings are reported
  kCorrect,  ///< also, the views are corrected before they are matched
  kHold,     ///< the views are not inspected, and the correction is the one that was set
};

/// The property `sharpness`: what is done if one view is sharper than the other.
enum class Sharpness {
  kKeep,   ///< nothing
  kMatch,  ///< the sharper view is blurred, if `alignment` is kCorrect
};

/// The values of the properties on alignment.
struct AlignmentSettings {
  std::optional<Alignment> alignment;  ///< std::nullopt: the preset's default
  std::optional<Sharpness> sharpness;  ///< std::nullopt: the preset's default
  int interval = 0;                    ///< from one inspection to the next [pairs]; 0: automatic
  std::optional<RowField> field;       ///< to start with
  std::uint64_t field_revision = 0;    ///< incremented whenever `field` is set
  float left_blur = 0;                 ///< with kHold: sigma of the blur of the left view [px]
  float right_blur = 0;                ///< with kHold: sigma of the blur of the right view [px]

  /// The value in effect. The published method does not correct its input.
  Alignment effective_alignment(Preset preset) const;
  Sharpness effective_sharpness(Preset preset) const;
  int effective_interval(Preset preset, int width, int height, int disparities) const;
};

/// The number of a problem besides those of PairProblem: both views are one image with content, as
/// with one stream on both pads.
inline constexpr int kOneImage = kPairProblems;

/// What is known about the alignment of the streams.
struct AlignmentReport {
  /// The confirmed field; the one to store. std::nullopt: none yet.
  std::optional<RowField> field;
  bool trusted = false;     ///< the field is confirmed by the last inspections
  ViewCorrection applied;   ///< what was done to the last pair
  double roll_degrees = 0;  ///< of the field
  PairFindings findings;    ///< of the last inspection
  std::uint64_t inspections = 0;
  std::uint32_t problems = 0;        ///< mask: 1 << PairProblem or kOneImage
  std::uint64_t field_revision = 0;  ///< AlignmentSettings::field_revision of the last pair

  /// `field`, unless another one was set since the last pair.
  std::optional<RowField> current_field(const AlignmentSettings& settings) const {
    return settings.field_revision == field_revision ? field : std::nullopt;
  }
};

/// Inspects the pairs of a stream and corrects them. Its results depend only on the settings and on
/// the pairs since the last restart().
class PairAlignment {
 public:
  /// Starts over with the next pair: from the stored field if there is one, otherwise from nothing.
  void restart() { fresh_ = true; }

  /// Inspects the pair that is to be matched next, if that is due, and sets the correction of the
  /// matcher. Fails as AlignmentTracker and Matcher::set_correction() do.
  Status prepare(const AlignmentSettings& settings, GrayView left, GrayView right,
                 Matcher& matcher);

  /// The findings up to the last pair.
  const AlignmentReport& report() const { return report_; }
  /// The problems to warn of now; call it once after every prepare().
  std::uint32_t new_problems() { return warnings_.due(report_.problems, interval_); }

 private:
  struct Size {
    int width = 0, height = 0;
    bool operator==(const Size&) const = default;
  };
  bool field_fits(const AlignmentSettings& settings, Size size);
  Status fit(const AlignmentSettings& settings, Size size);
  Status inspect(const AlignmentSettings& settings, GrayView left, GrayView right,
                 const Parameters& parameters);
  void switch_off();
  ViewCorrection held(const AlignmentSettings& settings, Size size);
  void update_report(int width);

  std::optional<AlignmentTracker> tracker_;
  InspectionSchedule schedule_;
  ProblemWarnings warnings_;
  AlignmentReport report_;
  bool fresh_ = true;       // the next pair is the first one after a restart
  bool one_image_ = false;  // the last pair is kOneImage
  int interval_ = 1;        // in effect
  Size size_;
  Size field_size_;  // the frame size to which the stored field belongs
  std::uint64_t field_revision_ = 0;
};

}  // namespace mtstereo::plugin
