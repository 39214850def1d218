// SPDX-License-Identifier: LGPL-2.1-or-later
// The parameter table: every parameter is described here and nowhere else.
#include <algorithm>

#include "base/limits.hpp"
#include "mtstereo/parameters.hpp"
#include "parameters/choices.hpp"

namespace mtstereo {
namespace {

using P = Parameter;
using T = ParameterType;

// clang-format off
// The defaults of a row: those of the presets default, fast and paper, each in the modes sparse,
// semi-dense, dense and full.
#define MODES(sparse, semi_dense, dense, full) {{sparse, semi_dense, dense, full}}
#define BY_MODE(standard, fast, paper) {{standard, fast, paper}}
// One default for each preset.
#define EACH(standard, fast, paper) \
  BY_MODE(MODES(standard, standard, standard, standard), MODES(fast, fast, fast, fast), \
          MODES(paper, paper, paper, paper))
// The same, with other defaults where the guide is the pyramid.
#define BY_GUIDE(standard, fast, paper, standard_pyramid, fast_pyramid) \
  BY_MODE(MODES(standard, standard_pyramid, standard_pyramid, standard_pyramid), MODES(fast, fast, fast_pyramid, fast_pyramid), \
          MODES(paper, paper, paper, paper))
// One default for every preset and mode.
#define ALL(value) EACH(value, value, value)

constexpr ParameterInfo kTable[] = {
    {P::kPreset, "preset", "", "", T::kChoice, 0, 2, "default|fast|paper", EACH("default", "fast", "paper"),
     "source of the defaults of all other parameters: the most accurate settings, the most accurate settings "
     "that take a third of the time, or the published method",
     {"the most accurate settings", "the most accurate settings that take a third of the time", "the published method"}},
    {P::kMode, "mode", "", "", T::kChoice, 0, 3, "sparse|semi-dense|dense|full", BY_MODE(MODES("sparse", "semi-dense", "dense", "full"), MODES("sparse", "semi-dense", "dense", "full"), MODES("sparse", "semi-dense", "semi-dense", "semi-dense")),
     "which pixels get a disparity: few and reliable ones at the ends of the finest nodes, all reliable ones, "
     "most pixels, also inferred ones, or every pixel",
     {"few pixels with few errors, at the ends of the finest nodes", "all reliable disparities", "most pixels: less certain and inferred disparities too", "every pixel: what cannot be matched is inferred"}},
    {P::kMaxDisparity, "max-disparity", "D", "px", T::kInteger, 1, kLargestMaxDisparity, "", ALL("64"),
     "the disparities min-disparity .. max-disparity - 1 are searched; the nearest measurable point is at "
     "focal length * baseline / max-disparity"},
    {P::kMinDisparity, "min-disparity", "", "px", T::kInteger, -kLargestMinDisparity, kLargestMinDisparity, "", ALL("0"),
     "the smallest disparity that is searched, less than max-disparity; a negative one is needed if the cameras "
     "converge or the views are cropped differently"},
    {P::kResolution, "resolution", "", "", T::kChoice, 0, 3, "full|half-refined|half|auto", EACH("full", "half-refined", "full"),
     "resolution at which the views are matched: half is several times as fast, and half-refined refines its "
     "disparities at full resolution; auto changes to half-refined while the views have no detail at full resolution, "
     "as those of a soft camera, and back; the disparity map always has the size of the views and counts their px; "
     "lengths of all other parameters count px of the matched resolution",
     {"matched at full resolution", "matched at half resolution, refined at full resolution", "matched at half resolution only", "full, or half-refined while the views have no detail at full resolution"}},
    {P::kThreads, "threads", "", "", T::kInteger, 0, 256, "", ALL("0"),
     "threads that work on a frame, 0 = one for each processor; the result does not depend on it"},
    {P::kNoiseFilter, "noise-filter", "", "", T::kBoolean, 0, 1, "", EACH("true", "false", "false"),
     "filter noise and compression artifacts from both views before they are matched, as much as the views have"},
    {P::kGuide, "guide", "", "", T::kChoice, 0, 1, "nodes|pyramid", BY_MODE(MODES("nodes", "pyramid", "pyramid", "pyramid"), MODES("nodes", "nodes", "pyramid", "pyramid"), MODES("nodes", "nodes", "nodes", "nodes")),
     "what says which disparities are expected of a pixel; mode sparse and the gradient cost always have nodes",
     {"the matched nodes of the Max-trees", "the maps at 1/2, 1/4 and 1/8 of the resolution; no Max-trees are built"}},
    {P::kGrayLevels, "gray-levels", "q", "", T::kInteger, 2, kLargestGrayLevels, "", BY_MODE(MODES("16", "16", "16", "16"), MODES("16", "16", "16", "16"), MODES("16", "8", "8", "8")),
     "levels that the pre-processed image is quantized to: more levels result in deeper trees with smaller leaves"},
    {P::kMinNodeWidth, "min-node-width", "omega_alpha", "px", T::kInteger, 0, kLargestImageSide, "", BY_MODE(MODES("3", "5", "5", "5"), MODES("3", "3", "3", "3"), MODES("0", "0", "0", "0")),
     "finest nodes must be wider than this"},
    {P::kMaxNodeWidth, "max-node-width", "omega_beta", "image widths", T::kNumber, 0.001, 1, "", EACH("1", "1", "0.5"),
     "finest nodes must be narrower than this share of the image's width"},
    {P::kNodeLevels, "node-levels", "S", "", T::kLevels, 0, kLargestNodeLevel, "", EACH("0", "0", "1,0"),
     "matched node levels, coarse to fine: level n holds the n-th ancestors of the finest nodes; "
     "strictly descending, the last one is 0"},
    {P::kMaxNeighbors, "max-neighbors", "omega_gamma", "rows", T::kInteger, 0, kLargestNeighbors, "", ALL("10"),
     "neighbors above and below that a node is matched together with"},
    {P::kCost, "cost", "", "", T::kChoice, 0, 1, "census|gradient", EACH("census", "census", "gradient"),
     "matching cost of nodes and pixels: the census transform, which is invariant to exposure, optimized "
     "along the scan-lines, or the paper's smoothed cost volume of gray values and gradients",
     {"census transform, optimized along the scan-lines", "smoothed cost volume of gray values and gradients, as in the paper"}},
    {P::kCostKernelSize, "cost-kernel-size", "omega_cv", "px", T::kInteger, 1, kLargestCostKernel, "", ALL("21"),
     "side of the Gaussian that smooths the cost volume (gradient), an odd number; 1 = no smoothing"},
    {P::kCostVolume, "cost-volume", "", "", T::kChoice, 0, 1, "half|full", ALL("half"),
     "resolution of the smoothed cost volume (gradient): half takes a quarter of the memory, full is exact",
     {"half resolution, a quarter of the memory", "full resolution, exact costs"}},
    {P::kIntensityWeight, "intensity-weight", "alpha", "", T::kNumber, 0, 1, "", EACH("1", "1", "0.8"),
     "share of the intensity cost in the cost of a node pair; the rest is the context cost, which compares the "
     "widths of the nodes' ancestors"},
    {P::kNodeConfidence, "node-confidence", "omega_Pi, coarse to fine", "%", T::kNumber, 0, 1000, "", EACH("3", "3", "12"),
     "a node pair is accepted if the cost of the second-best pair exceeds that of the best by more than this"},
    {P::kOutlierRadius, "outlier-radius", "", "px", T::kInteger, 0, kLargestOutlierRadius, "", EACH("0", "0", "21"),
     "half the side of the window in which a disparity must agree with most others; 0 = no outlier removal"},
    {P::kOutlierRemoval, "outlier-removal", "", "", T::kChoice, 0, 1, "nodes|nodes-and-pixels", EACH("nodes", "nodes", "nodes-and-pixels"),
     "where outliers are removed: from the disparities of nodes only, or from those of pixels too",
     {"from the disparities of nodes only", "from the disparities of nodes and of pixels"}},
    {P::kCensusScales, "census-scales", "", "", T::kInteger, 1, 2, "", BY_MODE(MODES("2", "2", "1", "1"), MODES("1", "1", "1", "1"), MODES("1", "1", "1", "1")),
     "scales of the census transform: 1 compares the pixels of a 5x5 window, 2 also those of a larger window in the "
     "smoothed view, which blur, noise and compression change less"},
    {P::kCensusKernelSize, "census-kernel-size", "", "px", T::kInteger, 1, kLargestCensusKernel, "", BY_MODE(MODES("5", "5", "3", "3"), MODES("3", "3", "3", "3"), MODES("5", "5", "5", "5")),
     "side of the window that census costs are summed over: 1, 3 or 5"},
    {P::kPixelSearchRange, "pixel-search-range", "omega_omega", "%", T::kNumber, 0, 100, "", ALL("15"),
     "guided pixel matching expects disparities up to this much below and above the node's"},
    {P::kBetweenNodes, "between-nodes", "", "", T::kChoice, 0, 2, "none|span|all", EACH("all", "all", "none"),
     "what is expected of a pixel between two nodes: no disparity, the disparities that both nodes span, or any",
     {"no disparity is expected", "the disparities that the two nodes span are expected", "every disparity is expected"}},
    {P::kRangePenalty, "range-penalty", "", "bits", T::kInteger, 0, kLargestRangePenalty, "", BY_MODE(MODES("1", "1", "2", "2"), MODES("1", "1", "2", "2"), MODES("2", "2", "2", "2")),
     "additional cost of a disparity that the guide does not expect (census); with the gradient cost such a "
     "disparity is never selected"},
    {P::kSmallStepPenalty, "small-step-penalty", "", "bits", T::kInteger, 0, kLargestStepPenalty, "", BY_GUIDE("4", "4", "4", "5", "5"),
     "cost of a step of one disparity from pixel to pixel of a scan-line (census)"},
    {P::kLargeStepPenalty, "large-step-penalty", "", "bits", T::kInteger, 0, kLargestStepPenalty, "", BY_MODE(MODES("30", "16", "30", "30"), MODES("30", "30", "30", "30"), MODES("30", "30", "30", "30")),
     "cost of a larger step where the gray value is constant, less where it changes (census); "
     "0 = no optimization along the scan-line"},
    {P::kPixelConfidence, "pixel-confidence", "omega_Pi, pixels", "%", T::kNumber, 0, 1000, "", BY_MODE(MODES("6", "0", "0", "0"), MODES("6", "6", "0", "0"), MODES("12", "4", "4", "4")),
     "a pixel keeps its disparity if the cost of the second-best one exceeds that of the best by more than this"},
    {P::kRunnerUp, "runner-up", "", "", T::kChoice, 0, 1, "any|expected", EACH("any", "any", "expected"),
     "disparities from which the second-best one is selected: all, or only those that the guide expects",
     {"among all disparities", "among the disparities that the guide expects"}},
    {P::kLeftRightTolerance, "left-right-tolerance", "", "px", T::kInteger, -1, kLargestMaxDisparity, "", EACH("1", "1", "-1"),
     "largest difference between the disparity of a left pixel and that of its right one; -1 = no check"},
    {P::kSubpixel, "subpixel", "", "", T::kBoolean, 0, 1, "", ALL("true"),
     "refine the disparity between whole pixels: by a V through the costs (census) or a parabola (gradient)"},
    {P::kSpeckleSize, "speckle-size", "", "px", T::kInteger, 0, 65535, "", BY_GUIDE("300", "75", "0", "100", "75"),
     "connected areas with fewer pixels than this are removed; 0 = none"},
    {P::kMinConfidence, "min-confidence", "", "", T::kInteger, 0, 255, "", BY_MODE(MODES("182", "136", "104", "0"), MODES("183", "160", "92", "0"), MODES("0", "0", "0", "0")),
     "disparities of lower confidence (1 .. 255) are removed; 0 = none; a filled gap has less "
     "confidence than its sides; in the modes semi-dense and dense with the pyramid the threshold applies to the complete map"},
    {P::kThinObjects, "thin-objects", "", "", T::kBoolean, 0, 1, "", BY_MODE(MODES("false", "true", "true", "false"), MODES("false", "true", "true", "false"), MODES("false", "false", "false", "false")),
     "keep posts, rails and wires that are too thin for speckle-size and min-confidence, and fill no gap over "
     "something nearer"},
    {P::kNodeEndWidth, "node-end-width", "", "px", T::kInteger, 1, kLargestNodeEnd, "", EACH("9", "9", "1"),
     "mode sparse: pixels that keep their disparity at each end of a finest node, an odd number"},
    {P::kMaxGap, "max-gap", "", "px", T::kInteger, 0, kLargestImageSide, "", BY_MODE(MODES("0", "3", "0", "0"), MODES("0", "4", "0", "0"), MODES("0", "0", "0", "0")),
     "gaps up to this width are filled if both sides differ by at most 1 px; 0 = none; with the pyramid after "
     "min-confidence and with a confidence of at most 15"},
    {P::kSmoothingRadius, "smoothing-radius", "", "px", T::kInteger, 0, kLargestSmoothingRadius, "", EACH("2", "3", "0"),
     "disparities are smoothed along each surface over this many pixels on both sides, in rows and in columns; "
     "0 = no smoothing"},
};
#undef ALL
#undef BY_GUIDE
#undef EACH
#undef BY_MODE
#undef MODES
// clang-format on

static_assert(std::size(kTable) == kParameters);

constexpr bool table_is_in_order() {
  for (int i = 0; i < kParameters; ++i) {
    if (static_cast<int>(kTable[i].id) != i) return false;
  }
  return true;
}
static_assert(table_is_in_order(), "the table must have the order of Parameter");

/// Whether the table lists exactly the words that the enum is bound to.
template <typename Enum>
constexpr bool is_bound() {
  const ParameterInfo& info = kTable[static_cast<int>(ChoiceOf<Enum>::kParameter)];
  std::string_view rest = info.choices;
  for (const std::string_view word : ChoiceOf<Enum>::kWords) {
    if (rest.substr(0, word.size()) != word) return false;
    rest.remove_prefix(word.size());
    if (rest.empty()) return word == ChoiceOf<Enum>::kWords.back();
    if (rest.front() != '|') return false;
    rest.remove_prefix(1);
  }
  return false;
}
static_assert(is_bound<Preset>() && is_bound<Mode>() && is_bound<Resolution>() && is_bound<Cost>());
static_assert(is_bound<CostVolumeResolution>() && is_bound<OutlierRemoval>());
static_assert(is_bound<BetweenNodes>() && is_bound<RunnerUp>());

}  // namespace

std::span<const ParameterInfo> parameter_table() noexcept { return kTable; }

const ParameterInfo& parameter_info(Parameter id) noexcept { return kTable[static_cast<int>(id)]; }

const char* parameter_default(Parameter id, Preset preset, Mode mode) noexcept {
  return parameter_info(id).defaults[static_cast<int>(preset)][static_cast<int>(mode)];
}

const ParameterInfo* find_parameter(std::string_view name) noexcept {
  const auto* found = std::find_if(std::begin(kTable), std::end(kTable),
                                   [&](const ParameterInfo& info) { return info.name == name; });
  return found == std::end(kTable) ? nullptr : found;
}

}  // namespace mtstereo
