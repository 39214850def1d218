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

/// How many pixels get a disparity (paper, section II-A "Disparity map"; kDense and kFull are
/// extensions).
enum class Mode {
  kSparse,     ///< only the most reliable pixels; with nodes only those at their ends
  kSemiDense,  ///< all pixels with a reliable disparity
  kDense,      ///< also less reliable and inferred disparities, if they are likely to be right
  kFull,       ///< all pixels: those that cannot be matched are inferred, at low confidence
};
/// Number of modes.
inline constexpr int kModes = 4;

/// A set of defaults for all parameters.
enum class Preset {
  kDefault,  ///< the most accurate known settings
  kFast,     ///< three times as fast, less accurate
  kPaper,    ///< the published method
};
/// Number of presets.
inline constexpr int kPresets = 3;

/// Largest value of Parameter::kMaxDisparity, and largest number of disparities [px].
inline constexpr int kLargestMaxDisparity = 1984;

/// Largest width and largest height of an image [px].
inline constexpr int kLargestImageSide = 16384;

/// The parameters, in the order of parameter_table(): the first words of the rows of
/// parameters.def. Each one is described by its row (parameter_info()) and in docs/parameters.md.
enum class Parameter {
#define MTSTEREO_PARAMETER(id, ...) id,
#include "mtstereo/parameters.def"
#undef MTSTEREO_PARAMETER
};

/// Largest number of choices of a ParameterType::kChoice.
inline constexpr int kMostChoices = 4;

#define MTSTEREO_PARAMETER(id, ...) +1
/// Number of parameters.
inline constexpr int kParameters = 0
#include "mtstereo/parameters.def"
    ;
#undef MTSTEREO_PARAMETER

/// The type of a parameter's value.
enum class ParameterType {
  kInteger,  ///< an integer
  kNumber,   ///< a real number
  kBoolean,  ///< 0 or 1; as text also false or true
  kChoice,   ///< one of ParameterInfo::choices
  kLevels,   ///< descending integers that end with 0, separated by commas, as in "1,0"
};

/// One row of the parameter table, the only description of a parameter. The range checks, the
/// properties of the element, the command-line options and docs/parameters.md are made from it. All
/// strings are static.
struct ParameterInfo {
  Parameter id;         ///< the parameter
  const char* name;     ///< lower case, words joined by '-'; also the name of property and option
  const char* symbol;   ///< the paper's symbol in plain letters, "" if the paper has none
  const char* unit;     ///< "px", "%", ... or "" if it has no unit
  ParameterType type;   ///< type of the value
  double minimum;       ///< smallest value (kInteger, kNumber)
  double maximum;       ///< largest value (kInteger, kNumber)
  const char* choices;  ///< the words of a kChoice separated by '|', else ""
  /// Defaults as text, indexed by Preset, then by Mode.
  std::array<std::array<const char*, kModes>, kPresets> defaults;
  const char* help;  ///< description in one line
  /// A kChoice: one line on each choice, in the order of `choices`; nullptr after the last one.
  std::array<const char*, kMostChoices> choice_help{};
};

/// All parameters, in the order of Parameter. The rows are static and constant, so any thread may
/// read them at any time.
MTSTEREO_API std::span<const ParameterInfo> parameter_table() noexcept;

/// The row of one parameter. `id` must be an enumerator of Parameter.
MTSTEREO_API const ParameterInfo& parameter_info(Parameter id) noexcept;

/// The default of one parameter as text. The string is static.
MTSTEREO_API const char* parameter_default(Parameter id, Preset preset, Mode mode) noexcept;

/// All defaults of one parameter for people to read, as in "6 (dense 2); preset paper: 4 (sparse
/// 12)". The first value applies to all modes not named.
MTSTEREO_API std::string parameter_defaults_text(Parameter id);

/// The row of the parameter with this name, or nullptr if there is none.
MTSTEREO_API const ParameterInfo* find_parameter(std::string_view name) noexcept;

/// A set of parameters. A parameter that was not set has the default of the preset and the mode.
/// Sets can be copied. Several threads may read one set at a time, but not while another one
/// changes it. set() refuses an `id` that is not an enumerator of Parameter; all other functions
/// require one.
class MTSTEREO_API Parameters {
 public:
  /// All parameters at their defaults, with Preset::kDefault and Mode::kSemiDense.
  Parameters() = default;

  /// Sets one parameter from a number: 0 or 1 for a kBoolean, the index of the word among its
  /// choices for a kChoice. A kLevels accepts text only. Fails with kInvalidParameter; the message
  /// names the parameter, the value and the range, and the set is unchanged.
  Status set(Parameter id, double value) noexcept;
  /// Sets one parameter from text: a number, a word, or levels. Fails with kInvalidParameter; the
  /// set is unchanged then.
  Status set(Parameter id, std::string_view text) noexcept;
  /// Sets the parameter of this name from text. Fails with kInvalidParameter, also if there is no
  /// parameter of this name; the set is unchanged then.
  Status set(std::string_view name, std::string_view text) noexcept;
  /// Resets one parameter to the default of the preset and the mode.
  void unset(Parameter id) noexcept;
  /// True if a value was set, false if the default is in effect.
  bool is_set(Parameter id) const noexcept;

  /// The value in effect: the one that was set, or the default of the preset and the mode. For a
  /// kBoolean 0 or 1, for a kChoice the index of the word, for a kLevels the number of levels.
  double get(Parameter id) const noexcept;
  /// The value in effect as text that set() accepts.
  std::string text(Parameter id) const;

  /// The preset in effect.
  Preset preset() const noexcept;
  /// The mode in effect.
  Mode mode() const noexcept;
  /// get() as an integer.
  int integer(Parameter id) const noexcept;
  /// Node levels S, coarse to fine (Parameter::kNodeLevels).
  struct Levels {
    std::array<int, 8> level{};  ///< the levels; the first `count` are used
    int count = 0;               ///< number of levels
  };
  /// The node levels in effect.
  Levels node_levels() const noexcept;

  /// What is added to the values of a disparity map [px]: Parameter::kMinDisparity if that is
  /// negative, otherwise 0. With it, a map needs no negative values.
  int disparity_offset() const noexcept;

  /// Checks that the parameters fit each other and images of this size [px]. Fails with
  /// kFrameDoesNotFit or kInvalidCombination; the message names the parameter, its value, the size
  /// and a value that would fit.
  Status check_frame(int width, int height) const noexcept;

  /// Checks that all disparities below max-disparity, minus disparity_offset(), fit into 16 bits at
  /// `scale` steps per px. Fails with kInvalidCombination; the message states what to set.
  Status check_scale16(int scale) const noexcept;

 private:
  struct Value {
    double number = 0;
    Levels levels;
  };
  static std::optional<Value> parse(const ParameterInfo& info, std::string_view text) noexcept;
  std::array<std::optional<Value>, kParameters> values_;
  Value effective(Parameter id) const noexcept;
  Status check_range() const;
};

}  // namespace mtstereo
