// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/parameters.hpp"

#include <algorithm>
#include <cmath>

#include "base/guard.hpp"
#include "parameters/choices.hpp"
#include "parameters/parameter_text.hpp"
#include "stages/prepare/halving.hpp"

namespace mtstereo {
namespace {

using P = Parameter;
using T = ParameterType;

Error refuse(const ParameterInfo& info, std::string_view value) {
  return {ErrorCode::kInvalidParameter, std::string(info.name) + " = " + std::string(value) +
                                            " is invalid: allowed are " + range_text(info)};
}

bool in_table(Parameter id) {
  return static_cast<int>(id) >= 0 && static_cast<int>(id) < kParameters;
}

Error refuse_id(Parameter id) {
  return {ErrorCode::kInvalidParameter, "parameter number " + std::to_string(static_cast<int>(id)) +
                                            " does not exist: the numbers are 0 to " +
                                            std::to_string(kParameters - 1)};
}

}  // namespace

Status Parameters::set(Parameter id, double value) noexcept {
  return guarded([&]() -> Status {
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
  });
}

Status Parameters::set(Parameter id, std::string_view text) noexcept {
  return guarded([&]() -> Status {
    if (!in_table(id)) return refuse_id(id);
    const ParameterInfo& info = parameter_info(id);
    const std::optional<Value> value = parse(info, text);
    if (!value) return refuse(info, "\"" + std::string(text) + "\"");
    if (info.type != T::kLevels) return set(id, value->number);
    values_[static_cast<int>(id)] = value;
    return {};
  });
}

Status Parameters::set(std::string_view name, std::string_view text) noexcept {
  return guarded([&]() -> Status {
    const ParameterInfo* info = find_parameter(name);
    if (info != nullptr) return set(info->id, text);
    std::string known;
    for (const ParameterInfo& row : parameter_table()) {
      known += std::string(known.empty() ? "" : ", ") + row.name;
    }
    return Error{
        ErrorCode::kInvalidParameter,
        "parameter \"" + std::string(name) + "\" does not exist: the parameters are " + known};
  });
}

/// Parses a value of the parameter's type without checking its range. Returns std::nullopt if the
/// text does not have the form of that type.
std::optional<Parameters::Value> Parameters::parse(const ParameterInfo& info,
                                                   std::string_view text) noexcept {
  Value value;
  switch (info.type) {
    case T::kLevels:
      if (!parse_levels(text, value.levels)) return std::nullopt;
      value.number = value.levels.count;
      return value;
    case T::kChoice:
      value.number = choice_index(info.choices, text);
      if (value.number < 0) return std::nullopt;
      return value;
    case T::kBoolean:
      if (text == "true" || text == "false") {
        value.number = text == "true" ? 1 : 0;
        return value;
      }
      break;
    case T::kInteger:
    case T::kNumber:
      break;
  }
  if (!parse_number(text, value.number)) return std::nullopt;
  return value;
}

void Parameters::unset(Parameter id) noexcept { values_[static_cast<int>(id)].reset(); }

bool Parameters::is_set(Parameter id) const noexcept {
  return values_[static_cast<int>(id)].has_value();
}

Parameters::Value Parameters::effective(Parameter id) const noexcept {
  if (is_set(id)) return *values_[static_cast<int>(id)];
  // The defaults of preset and mode must not depend on the preset and mode in force.
  const Preset of_preset = id == P::kPreset ? Preset::kDefault : preset();
  const Mode of_mode = id == P::kPreset || id == P::kMode ? Mode::kSemiDense : mode();
  // The defaults in the table are valid: a test sets every one of them.
  return parse(parameter_info(id), parameter_default(id, of_preset, of_mode)).value_or(Value{});
}

double Parameters::get(Parameter id) const noexcept { return effective(id).number; }

int Parameters::integer(Parameter id) const noexcept { return static_cast<int>(get(id)); }

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

Preset Parameters::preset() const noexcept { return choice<Preset>(*this); }

Mode Parameters::mode() const noexcept { return choice<Mode>(*this); }

Parameters::Levels Parameters::node_levels() const noexcept {
  return effective(P::kNodeLevels).levels;
}

int Parameters::disparity_offset() const noexcept { return std::min(integer(P::kMinDisparity), 0); }

/// Checks that the smallest and the largest disparity fit each other.
Status Parameters::check_range() const {
  const int least = integer(P::kMinDisparity);
  const int most = integer(P::kMaxDisparity);
  if (least < most && most - least <= kLargestMaxDisparity) return {};
  const std::string range = "min-disparity = " + std::to_string(least) +
                            " px and max-disparity = " + std::to_string(most) + " px ";
  if (least >= most) {
    return Error{ErrorCode::kInvalidCombination,
                 range + "leave no disparity to search: set min-disparity to at most " +
                     std::to_string(most - 1) + " px"};
  }
  return Error{ErrorCode::kInvalidCombination,
               range + "are more than " + std::to_string(kLargestMaxDisparity) +
                   " disparities: set min-disparity to at least " +
                   std::to_string(most - kLargestMaxDisparity) + " px"};
}

Status Parameters::check_frame(int width, int height) const noexcept {
  return guarded([&]() -> Status {
    const std::string size = size_text(width, height);
    if (width < 1 || height < 1 || width > kLargestImageSide || height > kLargestImageSide) {
      return Error{ErrorCode::kFrameDoesNotFit,
                   "images of " + size + " px cannot be matched: each side must be 1 to " +
                       std::to_string(kLargestImageSide) + " px"};
    }
    if (Status status = check_range(); !status) return status;
    const int disparities = integer(P::kMaxDisparity);
    if (disparities > width) {
      return Error{ErrorCode::kFrameDoesNotFit, "max-disparity = " + std::to_string(disparities) +
                                                    " px exceeds the width of images of " + size +
                                                    " px: set it to 1 to " + std::to_string(width) +
                                                    " px"};
    }
    // With kAuto the views may be matched at half resolution, where nodes are narrower.
    const bool half = choice<Resolution>(*this) != Resolution::kFull;
    const int matched = half ? half_of(width) : width;
    const double widest = get(P::kMaxNodeWidth) * matched;
    const int narrowest = integer(P::kMinNodeWidth);
    // Defaults may leave a small image without nodes; values that were set must allow some nodes.
    const bool chosen = is_set(P::kMinNodeWidth) || is_set(P::kMaxNodeWidth);
    if (chosen && narrowest + 1 >= widest && narrowest > 0) {
      return Error{ErrorCode::kInvalidCombination,
                   "min-node-width = " + std::to_string(narrowest) +
                       " px excludes every node narrower than max-node-width = " +
                       text(P::kMaxNodeWidth) + " image widths, which is " + number_text(widest) +
                       " px in images of " + size + " px" + (half ? " at half resolution" : "") +
                       ": lower min-node-width or raise max-node-width"};
    }
    return {};
  });
}

Status Parameters::check_scale16(int scale) const noexcept {
  return guarded([&]() -> Status {
    if (Status status = check_range(); !status) return status;
    const int offset = disparity_offset();
    const int disparities = integer(P::kMaxDisparity) - offset;
    if (scale >= 1 && static_cast<long long>(disparities) * scale <= 65535) return {};
    const int fitting = 65535 / disparities;
    if (scale < 1) {
      return Error{ErrorCode::kInvalidCombination, "disparity-scale = " + std::to_string(scale) +
                                                       " is invalid: set it to 1 to " +
                                                       std::to_string(fitting)};
    }
    const int most = scale <= 65535 ? 65535 / scale + offset : 0;
    return Error{
        ErrorCode::kInvalidCombination,
        "max-disparity = " + text(P::kMaxDisparity) + " px" +
            (offset < 0 ? " minus min-disparity = " + std::to_string(offset) + " px" : "") +
            " times disparity-scale = " + std::to_string(scale) +
            " does not fit in 16 bits (65535): set disparity-scale to 1 to " +
            std::to_string(fitting) +
            (most >= 1 ? ", or max-disparity to at most " + std::to_string(most) : "")};
  });
}

}  // namespace mtstereo
