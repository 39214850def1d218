// SPDX-License-Identifier: LGPL-2.1-or-later
// The public interface: checks the input, runs the frame matcher, turns exceptions into errors.
#include "mtstereo/matcher.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <string>

#include "alignment/row_field.hpp"
#include "base/check_views.hpp"
#include "base/guard.hpp"
#include "matcher/frame_matcher.hpp"
#include "parameters/parameter_text.hpp"

namespace mtstereo {
namespace {

/// Ways to reduce the memory, without those that the settings already use.
std::string ways_to_save(const Settings& settings) {
  std::string ways = "use smaller images, lower max-disparity";
  if (settings.threads != 1) ways += " or threads";
  if (!settings.half()) {
    ways += ", or set resolution = half or preset = fast";
  } else if (settings.refined()) {
    ways += ", or set resolution = half";
  }
  if (!settings.by_paths()) ways += ", or set cost = census, which needs no cost volume";
  return ways;
}

/// Converts a row to units of 1 / scale px. A known disparity never becomes 0, which means unknown.
void scale_row16(const std::int32_t* in, int width, int scale, std::uint16_t* row) {
  for (int x = 0; x < width; ++x) {
    const std::int64_t value =
        (static_cast<std::int64_t>(in[x]) * scale + kDisparityOne / 2) / kDisparityOne;
    row[x] = in[x] == kNoDisparity
                 ? std::uint16_t{0}
                 : static_cast<std::uint16_t>(std::clamp<std::int64_t>(value, 1, 65535));
  }
}

/// The same for a scale of kDisparityOne, as a loop that compilers vectorize.
void copy_row16(const std::int32_t* __restrict__ in, int width, std::uint16_t* __restrict__ row) {
  for (int x = 0; x < width; ++x) {
    const std::int32_t value = std::min(std::max(in[x], 1), 65535);
    row[x] = static_cast<std::uint16_t>(in[x] == kNoDisparity ? 0 : value);
  }
}

bool are_equal(const Parameters& a, const Parameters& b) {
  const Parameters::Levels ours = a.node_levels(), theirs = b.node_levels();
  if (!std::equal(ours.level.begin(), ours.level.begin() + ours.count, theirs.level.begin(),
                  theirs.level.begin() + theirs.count)) {
    return false;
  }
  return std::all_of(
      parameter_table().begin(), parameter_table().end(), [&](const ParameterInfo& info) {
        return info.type == ParameterType::kLevels || a.get(info.id) == b.get(info.id);
      });
}

}  // namespace

/// The state of the public class. Hidden, since it would otherwise be exported together with that
/// class.
struct __attribute__((visibility("hidden"))) Matcher::State {
  explicit State(const Parameters& p) : parameters(p), matcher(Settings(p)) {}

  Parameters parameters;
  FrameMatcher matcher;
};

Matcher::Matcher(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
Matcher::Matcher(Matcher&&) noexcept = default;
Matcher& Matcher::operator=(Matcher&&) noexcept = default;
Matcher::~Matcher() = default;

Result<Matcher> Matcher::create(const Parameters& parameters) noexcept {
  return guarded([&]() -> Result<Matcher> {
    try {
      return Matcher(std::make_unique<State>(parameters));
    } catch (const std::bad_alloc&) {
      return Error{ErrorCode::kOutOfMemory, "not enough memory for a matcher"};
    }
  });
}

Status Matcher::set_parameters(const Parameters& parameters) noexcept {
  return guarded([&]() -> Status {
    Settings settings(parameters);
    settings.correction = correction();
    if (!are_equal(parameters, state_->parameters)) state_->matcher.forget();
    state_->matcher.set(settings);
    state_->parameters = parameters;
    return {};
  });
}

const Parameters& Matcher::parameters() const noexcept { return state_->parameters; }

Status Matcher::set_correction(const ViewCorrection& correction) noexcept {
  return guarded([&]() -> Status {
    if (Status status = check_field(correction.rows); !status) return status;
    for (const float blur : {correction.left_blur, correction.right_blur}) {
      if (blur >= 0 && blur <= kLargestBlur) continue;
      return Error{ErrorCode::kInvalidParameter,
                   "a blur of " + std::to_string(blur) + " px is invalid: the range is 0 to " +
                       std::to_string(static_cast<int>(kLargestBlur))};
    }
    if (correction == this->correction()) return {};
    Settings settings = state_->matcher.settings();
    settings.correction = correction;
    state_->matcher.set(settings);
    return {};
  });
}

const ViewCorrection& Matcher::correction() const noexcept {
  return state_->matcher.settings().correction;
}

void Matcher::restart() noexcept { state_->matcher.restart(); }

void Matcher::forget() noexcept { state_->matcher.forget(); }

Result<FrameResult> Matcher::compute(GrayView left, GrayView right) noexcept {
  return guarded([&]() -> Result<FrameResult> {
    State& state = *state_;
    if (Status status = check_pair(left, right); !status) return status.error();
    if (Status status = state.parameters.check_frame(left.width, left.height); !status) {
      return status.error();
    }
    try {
      return state.matcher.compute(left, right);
    } catch (const std::bad_alloc&) {
      return Error{
          ErrorCode::kOutOfMemory,
          "not enough memory for images of " + size_text(left.width, left.height) +
              " px with max-disparity = " + state.parameters.text(Parameter::kMaxDisparity) + ": " +
              ways_to_save(state.matcher.settings())};
    } catch (const std::exception& exception) {
      return Error{ErrorCode::kSystem,
                   std::string("the frame could not be matched: ") + exception.what()};
    }
  });
}

Status write_disparity16(DisparityView disparity, int scale,
                         ImageView<std::uint16_t> out) noexcept {
  return guarded([&]() -> Status {
    if (out.width != disparity.width || out.height != disparity.height) {
      return Error{ErrorCode::kSizeMismatch,
                   "the disparity map is " + size_text(disparity.width, disparity.height) +
                       " px, the output image " + size_text(out.width, out.height) +
                       " px: both must have the same size"};
    }
    if (scale < 1 || scale > 65535) {
      return Error{ErrorCode::kInvalidParameter, "disparity-scale = " + std::to_string(scale) +
                                                     " is invalid: the range is 1 to 65535"};
    }
    if (disparity.data == nullptr || out.data == nullptr ||
        disparity.stride < static_cast<std::ptrdiff_t>(disparity.width * sizeof(std::int32_t)) ||
        out.stride < static_cast<std::ptrdiff_t>(out.width * sizeof(std::uint16_t))) {
      return Error{
          ErrorCode::kInvalidImage,
          "the disparity map or the output image has no data or a stride shorter than a row"};
    }
    for (int y = 0; y < out.height; ++y) {
      if (scale == kDisparityOne) {
        copy_row16(disparity.row(y), out.width, out.row(y));
      } else {
        scale_row16(disparity.row(y), out.width, scale, out.row(y));
      }
    }
    return {};
  });
}

const char* version() noexcept { return MTSTEREO_VERSION; }

}  // namespace mtstereo
