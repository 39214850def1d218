// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "mtstereo/export.hpp"
#include "mtstereo/result.hpp"

namespace mtstereo {

/// How many pixels get a disparity (paper, section II-A "Disparity map"; dense goes beyond it).
enum class Mode {
  kSparse,     ///< only at the ends of the finest nodes: few pixels, few errors
  kSemiDense,  ///< wherever a disparity can be trusted
  kDense,      ///< also where it is less sure, and in gaps whose sides agree
};
inline constexpr int kModes = 3;

/// A set of defaults for all parameters.
enum class Preset {
  kDefault,  ///< the most accurate that is known
  kFast,     ///< the most accurate that is known in a third of the time
  kPaper,    ///< the method as it is published
};
inline constexpr int kPresets = 3;

/// Largest value of Parameter::kMaxDisparity [px].
inline constexpr int kLargestMaxDisparity = 1024;

/// Largest width and height of an image [px].
inline constexpr int kLargestImageSide = 16384;

/// One value of the parameter table. The order is that of parameter_table().
enum class Parameter {
  kPreset,
  kMode,
  kMaxDisparity,
  kResolution,
  kThreads,
  kGrayLevels,
  kMinNodeWidth,
  kMaxNodeWidth,
  kNodeLevels,
  kMaxNeighbors,
  kCost,
  kCostKernelSize,
  kCostVolume,
  kIntensityWeight,
  kNodeConfidence,
  kOutlierRadius,
  kOutlierRemoval,
  kCensusKernelSize,
  kPixelSearchRange,
  kBetweenNodes,
  kRangePenalty,
  kSmallStepPenalty,
  kLargeStepPenalty,
  kPixelConfidence,
  kRunnerUp,
  kLeftRightTolerance,
  kSubpixel,
  kSpeckleSize,
  kMinConfidence,
  kNodeEndWidth,
  kMaxGap,
  kSmoothingRadius,
};

/// Largest number of choices of a ParameterType::kChoice.
inline constexpr int kMostChoices = 3;

/// Number of parameters.
inline constexpr int kParameters = static_cast<int>(Parameter::kSmoothingRadius) + 1;

/// What a parameter's value looks like.
enum class ParameterType {
  kInteger,  ///< a whole number
  kNumber,   ///< a number with a fraction
  kBoolean,  ///< 0 or 1 (in text also false, true)
  kChoice,   ///< one of ParameterInfo::choices
  kLevels,   ///< falling whole numbers that end with 0, separated by commas, as in "1,0"
};

/// One row of the parameter table: the only place where a parameter is described. The checks, the
/// element's properties, the command line options and the table in docs/ are made from it.
struct ParameterInfo {
  Parameter id;
  const char* name;    ///< lower case, words joined by '-'; also the property's and option's name
  const char* symbol;  ///< the paper's symbol in plain letters, "" where the paper has none
  const char* unit;    ///< "px", "%", ... or "" for a bare number
  ParameterType type;
  double minimum;       ///< smallest value (kInteger, kNumber)
  double maximum;       ///< largest value (kInteger, kNumber)
  const char* choices;  ///< the words of a kChoice separated by '|', else ""
  /// Defaults as text, by Preset and Mode.
  std::array<std::array<const char*, kModes>, kPresets> defaults;
  const char* help;  ///< one line
  /// A kChoice: one line on each choice, in the order of `choices`; nullptr after the last one.
  std::array<const char*, kMostChoices> choice_help{};
};

/// All parameters, in the order of Parameter. Never fails; the rows live as long as the program.
MTSTEREO_API std::span<const ParameterInfo> parameter_table() noexcept;

/// The row of one parameter; the id has to be one of Parameter.
MTSTEREO_API const ParameterInfo& parameter_info(Parameter id) noexcept;

/// The default of one parameter as text.
MTSTEREO_API const char* parameter_default(Parameter id, Preset preset, Mode mode) noexcept;

/// All defaults of one parameter in words for people, as in "6, 2 dense; preset paper: 4, 12
/// sparse": what stands first holds in every mode that is not named.
MTSTEREO_API std::string parameter_defaults_text(Parameter id);

/// The row of the parameter with this name, or nullptr.
MTSTEREO_API const ParameterInfo* find_parameter(std::string_view name) noexcept;

/// A set of parameters. What was not set takes the default of the preset and the mode. A plain
/// value: copy it freely; not meant to be shared between threads while one of them sets something.
class MTSTEREO_API Parameters {
 public:
  /// All at their defaults, Preset::kDefault and Mode::kSemiDense.
  Parameters() = default;

  /// Sets one parameter from a number. A kBoolean takes 0 and 1, a kChoice the index of the word
  /// among its choices. Fails with kInvalidParameter, the message naming the parameter, the value
  /// and the range; the set is then as it was. A kLevels takes text only.
  Status set(Parameter id, double value) noexcept;
  /// Sets one parameter from text: a number, a word, or levels. Fails as above.
  Status set(Parameter id, std::string_view text) noexcept;
  /// The same by name; an unknown name fails with kInvalidParameter.
  Status set(std::string_view name, std::string_view text) noexcept;
  /// Back to the default of preset and mode.
  void unset(Parameter id) noexcept;
  /// True where a value was set, false where a default holds.
  bool is_set(Parameter id) const noexcept;

  /// The value in force: what was set, or the default of preset and mode. For a kBoolean 0 or 1,
  /// for a kChoice the index of the word, for kLevels the number of levels.
  double get(Parameter id) const noexcept;
  /// The value in force as text, such that set() takes it back.
  std::string text(Parameter id) const;

  /// The preset and the mode in force.
  Preset preset() const noexcept;
  Mode mode() const noexcept;
  /// get() of a whole number.
  int integer(Parameter id) const noexcept;
  /// The levels of S in force, coarse to fine (Parameter::kNodeLevels); `count` of them are used.
  struct Levels {
    std::array<int, 8> level{};
    int count = 0;
  };
  Levels node_levels() const noexcept;

  /// Whether the parameters fit each other and images of this size. Fails with kFrameDoesNotFit or
  /// kInvalidCombination, the message naming the parameter, its value, the size and what would fit.
  Status check_frame(int width, int height) const noexcept;

  /// Whether disparities below max-disparity fit into 16 bits at `scale` steps per px. Fails with
  /// kInvalidCombination and a message that says what to set.
  Status check_scale16(int scale) const noexcept;

 private:
  struct Value {
    double number = 0;
    Levels levels;
  };
  static std::optional<Value> parse(const ParameterInfo& info, std::string_view text) noexcept;
  std::array<std::optional<Value>, kParameters> values_;
  Value effective(Parameter id) const noexcept;
};

}  // namespace mtstereo
