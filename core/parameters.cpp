// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/parameters.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace mtstereo {
namespace {

using P = Parameter;
using T = ParameterType;

// clang-format off
// The defaults of a row: those of preset default, of fast and of paper, each in modes sparse,
// semi-dense and dense.
#define MODES(sparse, semi_dense, dense) {{sparse, semi_dense, dense}}
#define BY_MODE(standard, fast, paper) {{standard, fast, paper}}
/// One default for each preset.
#define EACH(standard, fast, paper) \
  BY_MODE(MODES(standard, standard, standard), MODES(fast, fast, fast), MODES(paper, paper, paper))
/// One default for every preset and mode.
#define ALL(value) EACH(value, value, value)

constexpr ParameterInfo kTable[] = {
    {P::kPreset, "preset", "", "", T::kChoice, 0, 2, "default|fast|paper", EACH("default", "fast", "paper"), true,
     "where the defaults of all other parameters come from: the most accurate ones, the most "
     "accurate ones that take a third of the time, or those of the published method",
     {"the most accurate settings", "the most accurate settings that take a third of the time", "the published method"}},
    {P::kMode, "mode", "", "", T::kChoice, 0, 2, "sparse|semi-dense|dense", BY_MODE(MODES("sparse", "semi-dense", "dense"), MODES("sparse", "semi-dense", "dense"), MODES("sparse", "semi-dense", "semi-dense")), false,
     "how many pixels get a disparity: few and right ones at the ends of the finest nodes, all that "
     "can be trusted, or nearly all, with gaps filled",
     {"few pixels with few errors, at the ends of the finest nodes", "all disparities that can be trusted", "most pixels: less certain disparities too, and gaps filled"}},
    {P::kMaxDisparity, "max-disparity", "D", "px", T::kInteger, 1, kLargestMaxDisparity, "", ALL("64"), true,
     "the disparities 0 .. max-disparity - 1 are searched; the nearest point that can be seen is at "
     "focal length * baseline / max-disparity"},
    {P::kResolution, "resolution", "", "", T::kChoice, 0, 2, "full|half-refined|half", EACH("full", "half-refined", "full"), true,
     "at what resolution the views are matched: half is several times as fast, and half-refined refines its "
     "disparities at full resolution; the disparity map has the views' size and px in any case, all parameters "
     "below count px of the resolution that is matched",
     {"matched at full resolution", "matched at half resolution, refined at full resolution", "matched at half resolution only"}},
    {P::kThreads, "threads", "", "", T::kInteger, 0, 256, "", ALL("0"), true,
     "threads that work on a frame, 0 = one for each processor; the result does not depend on it"},
    {P::kGrayLevels, "gray-levels", "q", "", T::kInteger, 2, 256, "", BY_MODE(MODES("16", "16", "16"), MODES("16", "16", "16"), MODES("16", "8", "8")), false,
     "levels that the pre-processed image is quantized to: more levels, deeper trees, smaller leaves"},
    {P::kMinNodeWidth, "min-node-width", "omega_alpha", "px", T::kInteger, 0, kLargestImageSide, "", EACH("5", "3", "0"), false,
     "finest nodes have to be wider than this"},
    {P::kMaxNodeWidth, "max-node-width", "omega_beta", "image widths", T::kNumber, 0.001, 1, "", EACH("1", "1", "0.5"), false,
     "finest nodes have to be narrower than this share of the image's width"},
    {P::kNodeLevels, "node-levels", "S", "", T::kLevels, 0, 63, "", EACH("0", "0", "1,0"), true,
     "node levels that are matched, coarse to fine: n is the n-th ancestor of the finest nodes; "
     "strictly falling, the last one is 0"},
    {P::kMaxNeighbors, "max-neighbors", "omega_gamma", "rows", T::kInteger, 0, 100, "", ALL("10"), true,
     "nodes above and below that a node is matched together with"},
    {P::kNodeCost, "node-cost", "", "", T::kChoice, 0, 1, "census|gradient", EACH("census", "census", "gradient"), true,
     "what nodes are compared by: the census transform of their pixels and of the few beside them, or the "
     "paper's smoothed cost volume",
     {"census transform of the pixels in and next to the node", "smoothed cost volume of gray values and gradients, as in the paper"}},
    {P::kMedianFilter, "median-filter", "", "", T::kChoice, 0, 1, "trees|trees-and-costs", ALL("trees-and-costs"), false,
     "what the median-filtered images are for: the Max-trees only, or the smoothed cost volume (gradient) too",
     {"median-filtered images for the Max-trees only", "median-filtered images for the Max-trees and the cost volume"}},
    {P::kCostKernelSize, "cost-kernel-size", "omega_cv", "px", T::kInteger, 1, 41, "", EACH("21", "11", "21"), true,
     "side of the Gaussian that smooths the cost volume (gradient), an odd number; 1 = no smoothing"},
    {P::kCostVolume, "cost-volume", "", "", T::kChoice, 0, 1, "half|full", ALL("half"), true,
     "resolution of the smoothed cost volume (gradient), which exists only where node-cost or pixel-cost is "
     "gradient: half takes a quarter of the memory, full is the exact one",
     {"half resolution, a quarter of the memory", "full resolution, exact costs"}},
    {P::kIntensityWeight, "intensity-weight", "alpha", "", T::kNumber, 0, 1, "", EACH("1", "1", "0.8"), false,
     "share of the intensity cost, which node-cost names, in a node pair's cost; the rest is the context cost, "
     "which compares the widths of the nodes' ancestors"},
    {P::kNodeConfidence, "node-confidence", "omega_Pi, coarse to fine", "%", T::kNumber, 0, 1000, "", EACH("3", "3", "12"), false,
     "a node pair is accepted where the second-best costs more than this above the best"},
    {P::kOutlierRadius, "outlier-radius", "", "px", T::kInteger, 0, 31, "", EACH("0", "0", "21"), true,
     "half the side of the window in which a disparity must agree with most others; 0 = no outlier removal"},
    {P::kOutlierRemoval, "outlier-removal", "", "", T::kChoice, 0, 1, "nodes|nodes-and-pixels", EACH("nodes", "nodes", "nodes-and-pixels"), false,
     "where outliers are removed: from the nodes' disparities only, or from the pixels' too",
     {"from the disparities of nodes only", "from the disparities of nodes and of pixels"}},
    {P::kPixelCost, "pixel-cost", "", "", T::kChoice, 0, 1, "census|gradient", EACH("census", "census", "gradient"), true,
     "cost of guided pixel matching: the census transform, which no change of exposure alters, "
     "optimized along the scan-lines, or the paper's smoothed cost volume",
     {"census transform, optimized along the scan-lines", "smoothed cost volume of gray values and gradients, as in the paper"}},
    {P::kCensusKernelSize, "census-kernel-size", "", "px", T::kInteger, 1, 5, "", EACH("5", "3", "5"), true,
     "side of the window that census costs are summed over: 1, 3 or 5"},
    {P::kPixelSearchRange, "pixel-search-range", "omega_omega", "%", T::kNumber, 0, 100, "", ALL("15"), false,
     "guided pixel matching expects disparities this much below and above the node's"},
    {P::kBetweenNodes, "between-nodes", "", "", T::kChoice, 0, 2, "none|span|all", EACH("all", "all", "none"), false,
     "what is expected of a pixel between two nodes: no disparity at all, what both nodes span, or any",
     {"no disparity is expected", "the disparities that the two nodes span are expected", "every disparity is expected"}},
    {P::kRangePenalty, "range-penalty", "", "bits", T::kInteger, 0, 24, "", ALL("2"), true,
     "what a disparity that the nodes do not expect costs more (census); the gradient cost never "
     "takes one"},
    {P::kSmallStepPenalty, "small-step-penalty", "", "bits", T::kInteger, 0, 50, "", ALL("4"), false,
     "cost of a step of one disparity from pixel to pixel of a scan-line (census)"},
    {P::kLargeStepPenalty, "large-step-penalty", "", "bits", T::kInteger, 0, 50, "", ALL("30"), false,
     "cost of a larger step where the gray value stays, less where it changes (census); "
     "0 = no optimization along the scan-line"},
    {P::kPixelConfidence, "pixel-confidence", "omega_Pi, pixels", "%", T::kNumber, 0, 1000, "", BY_MODE(MODES("6", "6", "2"), MODES("6", "6", "2"), MODES("12", "4", "4")), false,
     "a pixel is kept where the second-best disparity costs more than this above the best"},
    {P::kRunnerUp, "runner-up", "", "", T::kChoice, 0, 1, "any|expected", EACH("any", "any", "expected"), false,
     "where the second-best disparity is looked for: among all, or among those that the nodes expect",
     {"among all disparities", "among the disparities that the nodes expect"}},
    {P::kLeftRightTolerance, "left-right-tolerance", "", "px", T::kInteger, -1, kLargestMaxDisparity, "", EACH("1", "1", "-1"), false,
     "largest difference between the disparity of a left pixel and that of its right one; -1 = no check"},
    {P::kSubpixel, "subpixel", "", "", T::kBoolean, 0, 1, "", ALL("true"), false,
     "refine the disparity between whole pixels: by a V through the costs (census) or a parabola (gradient)"},
    {P::kSpeckleSize, "speckle-size", "", "px", T::kInteger, 0, 65535, "", EACH("300", "75", "0"), false,
     "connected areas with fewer pixels than this are removed; 0 = none"},
    {P::kMinConfidence, "min-confidence", "", "", T::kInteger, 0, 255, "", BY_MODE(MODES("218", "190", "126"), MODES("228", "196", "136"), MODES("0", "0", "0")), false,
     "disparities of less confidence (1 .. 255) are removed; 0 = none; what fills a gap has half the "
     "confidence of its sides"},
    {P::kRimTrim, "rim-trim", "", "px", T::kInteger, 0, 31, "", ALL("0"), false,
     "pixels this near to one without a disparity are removed; 0 = none"},
    {P::kNodeEndWidth, "node-end-width", "", "px", T::kInteger, 1, 31, "", EACH("9", "9", "1"), false,
     "mode sparse: pixels that are kept at each end of a finest node, an odd number"},
    {P::kMaxGap, "max-gap", "", "px", T::kInteger, 0, kLargestImageSide, "", BY_MODE(MODES("0", "0", "30"), MODES("0", "0", "15"), MODES("0", "0", "0")), false,
     "gaps up to this wide are filled where both sides agree to 1 px; 0 = none"},
    {P::kSmoothingRadius, "smoothing-radius", "", "px", T::kInteger, 0, 31, "", EACH("0", "3", "0"), false,
     "disparities are smoothed along each surface, with the pixels this near in a row and a column; 0 = no smoothing"},
};
#undef ALL
#undef EACH
#undef BY_MODE
#undef MODES
// clang-format on

constexpr int kCount = kParameters;
static_assert(std::size(kTable) == kParameters);

/// Parameters that take odd numbers only.
constexpr bool is_odd_only(Parameter id) {
  return id == P::kCostKernelSize || id == P::kCensusKernelSize || id == P::kNodeEndWidth;
}

constexpr bool table_is_in_order() {
  for (int i = 0; i < kCount; ++i) {
    if (static_cast<int>(kTable[i].id) != i) return false;
  }
  return true;
}
static_assert(table_is_in_order(), "the table has the order of Parameter");

std::string number_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end.ptr};
}

std::string range_text(const ParameterInfo& info) {
  const std::string unit = *info.unit != '\0' ? std::string(" ") + info.unit : "";
  switch (info.type) {
    case T::kBoolean:
      return "false or true";
    case T::kChoice: {
      std::string words = info.choices;
      for (size_t at = 0; (at = words.find('|', at)) != std::string::npos; at += 4) {
        words.replace(at, 1, " or ");
      }
      return words;
    }
    case T::kLevels:
      return "up to 8 whole numbers, strictly falling from at most " + number_text(info.maximum) +
             ", the last one 0, as in \"1,0\"";
    case T::kInteger:
    case T::kNumber:
      break;
  }
  std::string text = number_text(info.minimum) + " to " + number_text(info.maximum) + unit;
  if (is_odd_only(info.id)) text += ", odd";
  return text;
}

Error refuse(const ParameterInfo& info, std::string_view value) {
  return {ErrorCode::kInvalidParameter, std::string(info.name) + " = " + std::string(value) +
                                            " is not possible: it takes " + range_text(info)};
}

bool in_table(Parameter id) { return static_cast<int>(id) >= 0 && static_cast<int>(id) < kCount; }

Error refuse_id(Parameter id) {
  return {ErrorCode::kInvalidParameter, "there is no parameter number " +
                                            std::to_string(static_cast<int>(id)) +
                                            ": the numbers are 0 to " + std::to_string(kCount - 1)};
}

bool parse_number(std::string_view text, double& value) {
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  return end.ec == std::errc() && end.ptr == text.data() + text.size();
}

/// The index of `word` among the words of `choices` ("a|b|c"), or -1.
int choice_index(std::string_view choices, std::string_view word) {
  for (int index = 0;; ++index) {
    const size_t bar = choices.find('|');
    if (choices.substr(0, bar) == word) return index;
    if (bar == std::string_view::npos) return -1;
    choices.remove_prefix(bar + 1);
  }
}

std::string_view choice_word(std::string_view choices, int index) {
  for (; index > 0; --index) choices.remove_prefix(choices.find('|') + 1);
  return choices.substr(0, choices.find('|'));
}

bool parse_levels(const ParameterInfo& info, std::string_view text, Parameters::Levels& levels) {
  Parameters::Levels parsed;
  while (true) {
    const size_t comma = text.find(',');
    const std::string_view item = text.substr(0, comma);
    int level = 0;
    const auto end = std::from_chars(item.data(), item.data() + item.size(), level);
    if (end.ec != std::errc() || end.ptr != item.data() + item.size()) return false;
    if (level < 0 || level > info.maximum) return false;
    if (parsed.count == static_cast<int>(parsed.level.size())) return false;
    if (parsed.count > 0 && level >= parsed.level[parsed.count - 1]) return false;
    parsed.level[parsed.count++] = level;
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  if (parsed.level[parsed.count - 1] != 0) return false;
  levels = parsed;
  return true;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

std::span<const ParameterInfo> parameter_table() { return kTable; }

const ParameterInfo& parameter_info(Parameter id) { return kTable[static_cast<int>(id)]; }

const char* parameter_default(Parameter id, Preset preset, Mode mode) {
  return parameter_info(id).defaults[static_cast<int>(preset)][static_cast<int>(mode)];
}

namespace {

/// The defaults of one preset: that of mode semi-dense, and what differs in the others.
std::string preset_defaults_text(Parameter id, Preset preset) {
  const std::string main = parameter_default(id, preset, Mode::kSemiDense);
  std::string text = main;
  for (const Mode mode : {Mode::kSparse, Mode::kDense}) {
    const std::string other = parameter_default(id, preset, mode);
    if (other != main) text += ", " + other + (mode == Mode::kSparse ? " sparse" : " dense");
  }
  return text;
}

}  // namespace

std::string parameter_defaults_text(Parameter id) {
  if (id == P::kPreset || id == P::kMode) return Parameters().text(id);
  const std::string standard = preset_defaults_text(id, Preset::kDefault);
  std::string text = standard;
  for (int preset = 1; preset < kPresets; ++preset) {
    const std::string other = preset_defaults_text(id, static_cast<Preset>(preset));
    if (other == standard) continue;
    const std::string_view name = choice_word(parameter_info(P::kPreset).choices, preset);
    text += "; preset " + std::string(name) + ": " + other;
  }
  return text;
}

const ParameterInfo* find_parameter(std::string_view name) {
  const auto* found = std::find_if(std::begin(kTable), std::end(kTable),
                                   [&](const ParameterInfo& info) { return info.name == name; });
  return found == std::end(kTable) ? nullptr : found;
}

Status Parameters::set(Parameter id, double value) {
  if (!in_table(id)) return refuse_id(id);
  const ParameterInfo& info = parameter_info(id);
  const bool whole = info.type != T::kNumber;
  if (info.type == T::kLevels || !(value >= info.minimum && value <= info.maximum) ||
      (whole && value != std::floor(value)) ||
      (is_odd_only(id) && static_cast<int>(value) % 2 == 0)) {
    return refuse(info, number_text(value));
  }
  values_[static_cast<int>(id)] = Value{value, {}};
  return {};
}

Status Parameters::set(Parameter id, std::string_view text) {
  if (!in_table(id)) return refuse_id(id);
  const ParameterInfo& info = parameter_info(id);
  double number = 0;
  switch (info.type) {
    case T::kLevels: {
      Levels levels;
      if (!parse_levels(info, text, levels)) return refuse(info, "\"" + std::string(text) + "\"");
      values_[static_cast<int>(id)] = Value{static_cast<double>(levels.count), levels};
      return {};
    }
    case T::kChoice: {
      const int index = choice_index(info.choices, text);
      if (index < 0) return refuse(info, "\"" + std::string(text) + "\"");
      return set(id, index);
    }
    case T::kBoolean:
      if (text == "true") return set(id, 1.0);
      if (text == "false") return set(id, 0.0);
      break;
    case T::kInteger:
    case T::kNumber:
      break;
  }
  if (!parse_number(text, number)) return refuse(info, "\"" + std::string(text) + "\"");
  return set(id, number);
}

Status Parameters::set(std::string_view name, std::string_view text) {
  const ParameterInfo* info = find_parameter(name);
  if (info == nullptr) {
    std::string known;
    for (const ParameterInfo& row : kTable)
      known += std::string(known.empty() ? "" : ", ") + row.name;
    return Error{ErrorCode::kInvalidParameter,
                 "there is no parameter \"" + std::string(name) + "\": there are " + known};
  }
  return set(info->id, text);
}

void Parameters::unset(Parameter id) { values_[static_cast<int>(id)].reset(); }

bool Parameters::is_set(Parameter id) const { return values_[static_cast<int>(id)].has_value(); }

Parameters::Value Parameters::effective(Parameter id) const {
  if (is_set(id)) return *values_[static_cast<int>(id)];
  // Neither the preset's nor the mode's default may ask for itself.
  const Preset of_preset = id == P::kPreset ? Preset::kDefault : preset();
  const Mode of_mode = id == P::kPreset || id == P::kMode ? Mode::kSemiDense : mode();
  Parameters defaults;
  // The table's own defaults are valid: a test sets every one of them.
  const Status status =
      defaults.set(id, std::string_view(parameter_default(id, of_preset, of_mode)));
  return status.ok() ? *defaults.values_[static_cast<int>(id)] : Value{};
}

double Parameters::get(Parameter id) const { return effective(id).number; }

int Parameters::integer(Parameter id) const { return static_cast<int>(get(id)); }

std::string Parameters::text(Parameter id) const {
  const ParameterInfo& info = parameter_info(id);
  const Value value = effective(id);
  switch (info.type) {
    case T::kBoolean:
      return value.number != 0 ? "true" : "false";
    case T::kChoice:
      return std::string(choice_word(info.choices, static_cast<int>(value.number)));
    case T::kLevels: {
      std::string text;
      for (int i = 0; i < value.levels.count; ++i) {
        text += (i > 0 ? "," : "") + std::to_string(value.levels.level[i]);
      }
      return text;
    }
    case T::kInteger:
    case T::kNumber:
      break;
  }
  return number_text(value.number);
}

Preset Parameters::preset() const { return static_cast<Preset>(integer(P::kPreset)); }

Mode Parameters::mode() const { return static_cast<Mode>(integer(P::kMode)); }

Parameters::Levels Parameters::node_levels() const { return effective(P::kNodeLevels).levels; }

Status Parameters::check_frame(int width, int height) const {
  const std::string size = size_text(width, height);
  if (width < 1 || height < 1 || width > kLargestImageSide || height > kLargestImageSide) {
    return Error{ErrorCode::kFrameDoesNotFit,
                 "images of " + size + " px cannot be matched: each side has to be 1 to " +
                     std::to_string(kLargestImageSide) + " px"};
  }
  const int disparities = integer(P::kMaxDisparity);
  if (disparities > width) {
    return Error{ErrorCode::kFrameDoesNotFit, "max-disparity = " + std::to_string(disparities) +
                                                  " does not fit images of " + size +
                                                  " px: set it to 1 to " + std::to_string(width) +
                                                  " px, the image's width"};
  }
  const bool half = text(P::kResolution) != "full";
  const int matched = half ? (width + 1) / 2 : width;
  const double widest = get(P::kMaxNodeWidth) * matched;
  const int narrowest = integer(P::kMinNodeWidth);
  // The defaults may leave an image without nodes; what was set has to make sense.
  const bool chosen = is_set(P::kMinNodeWidth) || is_set(P::kMaxNodeWidth);
  if (chosen && narrowest + 1 >= widest && narrowest > 0) {
    return Error{ErrorCode::kInvalidCombination,
                 "min-node-width = " + std::to_string(narrowest) +
                     " px leaves no node below max-node-width = " + text(P::kMaxNodeWidth) +
                     " image widths, which is " + number_text(widest) + " px in images of " + size +
                     " px" + (half ? " at half resolution" : "") +
                     ": lower the first or raise the second"};
  }
  return {};
}

Status Parameters::check_scale16(int scale) const {
  const int disparities = integer(P::kMaxDisparity);
  if (scale >= 1 && static_cast<long long>(disparities) * scale <= 65535) return {};
  const int fitting = 65535 / disparities;
  return Error{ErrorCode::kInvalidCombination,
               "max-disparity = " + std::to_string(disparities) +
                   " px times disparity-scale = " + std::to_string(scale) +
                   " does not fit 16 bits (65535): set disparity-scale to 1 to " +
                   std::to_string(fitting) +
                   (scale >= 1 && scale <= 65535
                        ? ", or max-disparity to at most " + std::to_string(65535 / scale)
                        : "")};
}

}  // namespace mtstereo
