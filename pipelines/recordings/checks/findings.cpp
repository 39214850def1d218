// SPDX-License-Identifier: LGPL-2.1-or-later

// All limits of the findings are here.

#include "recordings/checks/findings.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "alignment/pair_inspection.hpp"
#include "lib/outputs/texts.hpp"

namespace mtstereo::run {
namespace {

using outputs::format;

constexpr double kUselessDensity = 0.05;  // as mtstereo-run: less is of no use
constexpr double kLowDensity = 0.3;
constexpr double kRowsNote = 1, kRowsUncorrected = 0.5;   // RMS of the displacement [px]
constexpr double kRowsSpread = 0.01;                      // of the width: from least to most
constexpr double kApartNote = 0.1, kApart = 0.4;          // of a frame
constexpr double kHalfFrame = 0.55;                       // pairing by the times leaves less
constexpr double kMostDeviation = 0.1;                    // of a frame: of a time that counts
constexpr double kDroppedNote = 0.1;                      // of the frames of a view
constexpr double kExposureNote = 1.4;                     // ratio of the mean gray values
constexpr double kSharpnessHarm = 2;                      // ratio
constexpr double kSaturatedNote = 0.2, kSaturated = 0.4;  // of the pixels
constexpr double kDarkNote = 60, kDark = 30;              // of the bright pixels [gray values]
constexpr double kUnscaled = 16;                          // as of 12 of 16 bits [gray values]
constexpr double kNoiseNote = 5;                          // [gray values]
constexpr double kSoft = 0.08;                            // of the fine detail; choosing.md
constexpr double kHalfFactor = 1.3;  // of the density: half the resolution is better
constexpr double kRangeTwice = 2;    // how much larger than needed a range may be

const char* side_of(bool right) { return right ? "right" : "left"; }

class Judge {
 public:
  explicit Judge(const CheckFigures& figures) : figures_(figures) {}

  std::vector<Finding> run() {
    judge_streams();
    judge_diagnosis();
    judge_partners();
    if (!figures_.diagnosis.worthless()) {
      judge_times();
      judge_rows();
      judge_range();
    }
    judge_light();
    judge_exposure();
    judge_sharpness();
    judge_detail();
    judge_density();
    std::stable_partition(found_.begin(), found_.end(),
                          [](const Finding& each) { return each.harms; });
    return std::move(found_);
  }

 private:
  void add(bool harms, std::string problem, std::string remedy) {
    found_.push_back({harms, {std::move(problem), std::move(remedy)}});
  }

  bool blank() const {
    return figures_.inspection.has(PairProblem::kLeftBlank) ||
           figures_.inspection.has(PairProblem::kRightBlank);
  }

  bool frozen() const {
    return figures_.inspection.has(PairProblem::kLeftFrozen) ||
           figures_.inspection.has(PairProblem::kRightFrozen);
  }

  // The sentences of the library have the form "What is found: what to do."
  void add(PairProblem problem) {
    const std::string_view text = problem_text(problem);
    const std::size_t colon = text.find(": ");
    std::string remedy(text.substr(colon + 2));
    remedy[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(remedy[0])));
    add(true, std::string(text.substr(0, colon)) + ".", std::move(remedy));
  }

  void judge_streams() {
    for (const PairProblem problem : {PairProblem::kLeftBlank, PairProblem::kRightBlank,
                                      PairProblem::kLeftFrozen, PairProblem::kRightFrozen}) {
      if (figures_.inspection.has(problem)) add(problem);
    }
  }

  void judge_diagnosis() {
    const ViewDiagnosis& found = figures_.diagnosis;
    if (found.problem == ViewProblem::kNone || blank() || frozen()) return;
    const ViewSize size = view_size(figures_.work);
    if (size.width < kFewestColumns || size.height < kFewestRows) {
      add(false, format("The views are too small to check whether they belong together."),
          format("Record at least %dx%d px.", kFewestColumns, kFewestRows));
      return;
    }
    Advice advice =
        diagnosis_advice(found, figures_.work.recording.calibration, suggests_sync(figures_.work));
    if (found.problem == ViewProblem::kTooLittleTexture) {
      advice.remedy = "Check a recording of a scene with texture, in good light.";
    }
    if (found.problem == ViewProblem::kUnknown && (is_dark() || exposures_differ())) {
      advice.remedy =
          "The light of the views (below) may be the reason: correct it, and check again.";
    }
    if (found.problem == ViewProblem::kRangeTooSmall && figures_.range) {
      advice.remedy = range_remedy();
    }
    if (found.problem == ViewProblem::kOutOfStep) {
      const TimeFigures& times = figures_.times;
      if (figures_.work.clocks) advice.remedy = "Check the offset of --sync.";
      advice.problem += times.measured ? " By the motion it is " + apart(times.apart) + "."
                                       : format(" That is about %.0f ms.",
                                                1e3 * std::abs(found.frames) * period());
    }
    const bool harms = found.worthless() || found.problem == ViewProblem::kRangeTooSmall ||
                       (found.problem == ViewProblem::kUnknown && density() < kLowDensity);
    found_.push_back({harms, std::move(advice)});
  }

  std::string range_remedy() const {
    return format("Set max-disparity=%d.", figures_.range->max_disparity);
  }

  double density() const {
    const ModeFigures* const usual = figures_.mode(kSemiDense);
    return usual != nullptr ? usual->density : figures_.inspection.density;
  }

  void judge_partners() {
    const PairList& pairs = figures_.work.pairs;
    const auto paired = static_cast<double>(pairs.pairs.size());
    const auto dropped = static_cast<double>(std::max(pairs.dropped_left, pairs.dropped_right));
    if (dropped <= kDroppedNote * (paired + dropped)) return;
    add(false,
        format("%lld left and %lld right frames have no partner at their time.",
               static_cast<long long>(pairs.dropped_left),
               static_cast<long long>(pairs.dropped_right)),
        "Record both views from start to end at the same rate; recorders that lose frames need a "
        "lower one.");
  }

  double period() const { return static_cast<double>(figures_.work.period) * 1e-9; }

  // "20 ms (0.60 frames) later than the left one"
  std::string apart(double seconds) const {
    return format("%.0f ms (%.2f frames) %s than the left one", 1e3 * std::abs(seconds),
                  std::abs(seconds) / period(), seconds > 0 ? "later" : "earlier");
  }

  void judge_times() {
    const TimeFigures& times = figures_.times;
    const double frames = std::abs(times.apart) / period();
    const std::string moment = "The right view is taken " + apart(times.apart);
    if (times.measured && times.confirmed && frames >= kApart) {
      add(true, moment + ", as the motion in both shows.",
          frames > kHalfFrame
              ? "Two recorders: --sync auto finds the offset. Otherwise trigger the "
                "cameras together (docs/cameras.md)."
              : "Trigger the cameras together (docs/cameras.md).");
    } else if (figures_.inspection.has(PairProblem::kOutOfStep)) {
      add(true, "Points of the two views disagree about the rows, as in views of different times.",
          "Trigger the cameras together (docs/cameras.md), or check the calibration.");
    } else if (frames >= kApartNote &&
               (!times.measured || times.deviation < kMostDeviation * period())) {
      add(false, moment + (times.measured ? "." : ", by the times of their frames."),
          "Things that move get wrong disparities: trigger the cameras together "
          "(docs/cameras.md).");
    }
  }

  void judge_rows() {
    const ViewSize size = view_size(figures_.work);
    const Result<RowField> field = RowField::parse(figures_.inspection.field);
    const double rms = field ? field->rms(size.width, size.height) : 0;
    const RowExtremes rows = rows_of(figures_.inspection, size);
    const Recording& recording = figures_.work.recording;
    const bool calibrated = !recording.rectified;
    const std::string found = "rows of the right view are " + rows_text(rows);
    if (!figures_.corrected && rms >= kRowsUncorrected) {
      add(true, "The " + found + ", and are not corrected.", "Set --alignment correct.");
    } else if (rows.most - rows.least >= kRowsSpread * size.width) {
      add(true,
          (calibrated
               ? "The calibration " + recording.calibration + " does not fit these views: the "
               : "The views are not rectified: the ") +
              found + ". Matching corrects rows, but depths are wrong.",
          calibrated
              ? "Give that of these cameras, lenses and video size, or calibrate again "
                "(docs/cameras.md)."
              : "Calibrate the cameras (docs/cameras.md), and give the file by --calibration.");
    } else if (rms >= kRowsNote) {
      add(false,
          (calibrated ? "After the rectification, the " : "The ") + found +
              ": alignment=correct, the default, corrects the rows.",
          calibrated ? "Calibrate again: depths may be wrong too (docs/cameras.md)."
                     : "Rectify the views by a calibration (--calibration FILE) for exact depths.");
    }
  }

  void judge_range() {
    if (!figures_.range) return;
    const int needed = figures_.range->max_disparity;
    const Parameters parameters = matcher_parameters(figures_.work.options);
    const int used = parameters.integer(Parameter::kMaxDisparity);
    const int usual = Parameters().integer(Parameter::kMaxDisparity);
    const std::string disparities =
        format("The disparities reach %.0f px", figures_.range->reliable);
    if (!figures_.range_given && figures_.range->reliable > usual) {
      add(false, disparities + format("; the default range ends at %d px.", usual), range_remedy());
    } else if (figures_.range_given && used >= kRangeTwice * needed) {
      add(false, disparities + format("; max-disparity=%d takes more time than needed.", used),
          range_remedy());
    }
  }

  // That of the view with the larger one.
  double worse(double ViewFigures::*value) const {
    return std::max(figures_.views[0].*value, figures_.views[1].*value);
  }

  double brightness_of_darker() const {
    return std::min(figures_.views[0].bright, figures_.views[1].bright);
  }

  bool is_dark() const { return brightness_of_darker() < kDarkNote; }

  void judge_light() {
    if (blank()) return;
    const auto& [left, right] = figures_.views;
    const double saturated = worse(&ViewFigures::saturated), noise = worse(&ViewFigures::noise);
    if (saturated >= kSaturatedNote) {
      add(saturated >= kSaturated,
          format("White, without texture: %.0f %% of the left and %.0f %% of the right view.",
                 100 * left.saturated, 100 * right.saturated),
          "Expose less: prefer a dark image to white areas (docs/cameras.md).");
    }
    if (is_dark()) {
      add(brightness_of_darker() < kDark,
          format("Dark: 95 %% of the pixels are below %.0f (left) and %.0f (right) of 255.",
                 left.bright, right.bright),
          brightness_of_darker() < kUnscaled
              ? "If the values have 10 or 12 of 16 bits, scale them (ffmpeg -i FILE -vf lut=val*64 "
                "-c:v ffv1 view.mkv; 12 bits: 16). Otherwise, more light or a longer exposure."
              : "More light, a longer exposure or a lens that lets more light in; gain adds "
                "noise.");
    }
    if (noise >= kNoiseNote) {
      add(false,
          format("Noisy: %.1f (left) and %.1f (right) gray values.", left.noise, right.noise),
          "More light and less gain; temporal=filter of the element for a camera at rest.");
    }
  }

  bool exposures_differ() const {
    const auto [least, most] =
        std::minmax({std::max(figures_.views[0].mean, 1.0), std::max(figures_.views[1].mean, 1.0)});
    return most >= kExposureNote * least;
  }

  void judge_exposure() {
    if (blank() || !exposures_differ()) return;
    add(false,
        format("The exposure differs: the mean gray values are %.0f (left) and %.0f (right).",
               figures_.views[0].mean, figures_.views[1].mean),
        "Set the same fixed exposure and gain on both cameras (docs/cameras.md).");
  }

  void judge_sharpness() {
    const ViewInspection& found = figures_.inspection;
    if (!found.has(PairProblem::kSharpnessDiffers) || found.sharpness <= 0) return;
    const bool right = found.sharpness > 1;
    const double ratio = std::max(found.sharpness, 1 / found.sharpness);
    add(ratio >= kSharpnessHarm,
        format("The %s view is less sharp: the other one has %.1f times its sharpness.",
               side_of(right), ratio),
        "Clean and focus its lens. Until then the sharper view is blurred like it "
        "(sharpness=match, "
        "the default).");
  }

  void judge_detail() {
    const ModeFigures* const usual = figures_.mode(kSemiDense);
    const ModeFigures* const half = figures_.mode(kHalfRefined);
    if (usual == nullptr) return;
    const bool soft = usual->fine_detail > 0 && usual->fine_detail <= kSoft;
    const bool more = half != nullptr && half->density >= kLowDensity / 2 &&
                      half->density >= kHalfFactor * usual->density;
    if (!soft && !more) return;
    std::string problem =
        soft ? format(
                   "The views are soft: their finest detail is %.2f, sharp views have 0.1 to "
                   "0.4.",
                   usual->fine_detail)
             : "Noise, compression or darkness hides the finest texture of the views.";
    std::string remedy = "Focus the lenses";
    if (!soft) remedy = "Less compression, more light";
    remedy += "; resolution=half-refined is faster";
    if (more) {
      remedy += format(" and finds disparities for %.0f %% of the pixels instead of %.0f %%",
                       100 * half->density, 100 * usual->density);
    }
    add(false, std::move(problem),
        remedy + (soft ? "; resolution=auto of the element chooses it." : "."));
  }

  // Findings that harm explain it.
  void judge_density() {
    const bool explained =
        std::any_of(found_.begin(), found_.end(), [](const Finding& each) { return each.harms; });
    if (explained || density() >= kLowDensity) return;
    const bool useless = density() < kUselessDensity;
    add(useless,
        format("Only %.0f %% of the pixels have a disparity in mode semi-dense.", 100 * density()),
        "docs/quickstart.md lists the causes of nearly black maps; mode=dense infers more.");
  }

  const CheckFigures& figures_;
  std::vector<Finding> found_;
};

}  // namespace

std::vector<Finding> find_problems(const CheckFigures& figures) { return Judge(figures).run(); }

}  // namespace mtstereo::run
