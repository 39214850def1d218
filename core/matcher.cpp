// SPDX-License-Identifier: LGPL-2.1-or-later
// What a matcher shows to its users; the steps themselves are in matcher_steps.cpp.
#include "mtstereo/matcher.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <string>

#include "matcher_state.hpp"

namespace mtstereo {
namespace {

Status check_view(const char* name, GrayView view) {
  if (view.data != nullptr && view.width > 0 && view.height > 0 &&
      (view.stride >= view.width || view.height == 1)) {
    return {};
  }
  return Error{ErrorCode::kInvalidImage,
               std::string("the ") + name + " image cannot be read: " + std::to_string(view.width) +
                   "x" + std::to_string(view.height) + " px with a stride of " +
                   std::to_string(view.stride) + " bytes" +
                   (view.data == nullptr ? " and no data" : "") +
                   "; it needs data, at least 1x1 px and a stride of at least the width"};
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height) + " px";
}

/// What needs less memory than these parameters do; nothing that they have already.
std::string ways_to_save(const Parameters& parameters, const Settings& settings) {
  std::string ways = "take smaller images, lower max-disparity";
  if (parameters.integer(Parameter::kThreads) != 1) ways += " or threads";
  if (!settings.half) {
    ways += ", or set resolution = half or preset = fast";
  } else if (settings.refined) {
    ways += ", or set resolution = half";
  }
  if (settings.needs_volume()) {
    ways += ", or leave out the cost volume: set ";
    if (!settings.node_census) ways += "node-cost = census";
    if (!settings.node_census && !settings.census) ways += " and ";
    if (!settings.census) ways += "pixel-cost = census";
  }
  return ways;
}

/// Writes a row in steps of 1 / scale px; what has a disparity keeps one.
void scale_row16(const std::int32_t* in, int width, int scale, std::uint16_t* row) {
  for (int x = 0; x < width; ++x) {
    const std::int64_t value =
        (static_cast<std::int64_t>(in[x]) * scale + kDisparityOne / 2) / kDisparityOne;
    row[x] = in[x] == kNoDisparity
                 ? std::uint16_t{0}
                 : static_cast<std::uint16_t>(std::clamp<std::int64_t>(value, 1, 65535));
  }
}

/// The same for the steps that disparities have anyway: a loop that compilers turn into vectors.
void copy_row16(const std::int32_t* __restrict__ in, int width, std::uint16_t* __restrict__ row) {
  for (int x = 0; x < width; ++x) {
    const std::int32_t value = std::min(std::max(in[x], 1), 65535);
    row[x] = static_cast<std::uint16_t>(in[x] == kNoDisparity ? 0 : value);
  }
}

/// An error whose text may need memory that is not there: then it goes without.
template <typename Text>
Error error_of(ErrorCode code, Text&& text) noexcept {
  try {
    return {code, text()};
  } catch (...) {
    return {code, {}};
  }
}

}  // namespace

Matcher::Matcher(std::unique_ptr<State> state) : state_(std::move(state)) {}
Matcher::Matcher(Matcher&&) noexcept = default;
Matcher& Matcher::operator=(Matcher&&) noexcept = default;
Matcher::~Matcher() = default;

Result<Matcher> Matcher::create(const Parameters& parameters) {
  try {
    return Matcher(std::make_unique<State>(parameters));
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "there is no memory left for a matcher"};
  }
}

Status Matcher::set_parameters(const Parameters& parameters) {
  try {
    state_->take(parameters);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "there is no memory left for other parameters"};
  }
  return {};
}

const Parameters& Matcher::parameters() const { return state_->parameters; }

void Matcher::keep_stages(bool keep) { state_->keep_stages = keep; }

Result<DisparityView> Matcher::compute(GrayView left, GrayView right) {
  State& state = *state_;
  if (Status status = check_view("left", left); !status) return status.error();
  if (Status status = check_view("right", right); !status) return status.error();
  if (left.width != right.width || left.height != right.height) {
    return Error{ErrorCode::kSizeMismatch,
                 "the left image has " + size_text(left.width, left.height) + ", the right one " +
                     size_text(right.width, right.height) +
                     ": both views of a rectified pair have the same size"};
  }
  if (Status status = state.parameters.check_frame(left.width, left.height); !status) {
    return status.error();
  }
  try {
    if (!state.sized || state.frame_width != left.width || state.frame_height != left.height) {
      state.frame_width = left.width;
      state.frame_height = left.height;
      state.size_buffers();
    }
    state.compute(left, right);
  } catch (const std::bad_alloc&) {
    state.forget_frame();
    return error_of(ErrorCode::kOutOfMemory, [&] {
      return "there is not enough memory for images of " + size_text(left.width, left.height) +
             " with max-disparity = " + std::to_string(state.settings.max_disparity) + ": " +
             ways_to_save(state.parameters, state.settings);
    });
  } catch (const std::exception& exception) {
    state.forget_frame();
    return error_of(ErrorCode::kSystem, [&] {
      return std::string("the frame could not be matched: ") + exception.what();
    });
  }
  return state.result;
}

DisparityView Matcher::stage(Stage stage) const {
  return state_->kept[static_cast<int>(stage)].view();
}

GrayView Matcher::preprocessed(Side side) const {
  return state_->views[static_cast<int>(side)].level.view();
}

GrayView Matcher::confidence() const { return state_->rated; }

double Matcher::cost(int x, int y, int d) const {
  const State& state = *state_;
  if (!state.sized || !state.settings.needs_volume() || x < 0 || x >= state.width || y < 0 ||
      y >= state.height || d < 0 || d > x || d >= state.volume.disparities) {
    return 0;
  }
  return static_cast<double>(state.volume.at(x, y, d)) / kCostScale;
}

FrameStatistics Matcher::statistics() const { return state_->statistics; }

Status write_disparity16(DisparityView disparity, int scale, ImageView<std::uint16_t> out) {
  if (out.width != disparity.width || out.height != disparity.height) {
    return Error{ErrorCode::kSizeMismatch,
                 "the disparity has " + size_text(disparity.width, disparity.height) +
                     ", the image it is to be written to " + size_text(out.width, out.height)};
  }
  if (scale < 1 || scale > 65535) {
    return Error{ErrorCode::kInvalidParameter, "disparity-scale = " + std::to_string(scale) +
                                                   " is not possible: it takes 1 to 65535"};
  }
  if (disparity.data == nullptr || out.data == nullptr ||
      disparity.stride < static_cast<std::ptrdiff_t>(disparity.width * sizeof(std::int32_t)) ||
      out.stride < static_cast<std::ptrdiff_t>(out.width * sizeof(std::uint16_t))) {
    return Error{ErrorCode::kInvalidImage,
                 "the disparity or the image it is to be written to has no data or a stride that "
                 "is shorter than a row"};
  }
  for (int y = 0; y < out.height; ++y) {
    if (scale == kDisparityOne) {
      copy_row16(disparity.row(y), out.width, out.row(y));
    } else {
      scale_row16(disparity.row(y), out.width, scale, out.row(y));
    }
  }
  return {};
}

const char* version() { return MTSTEREO_VERSION; }

}  // namespace mtstereo
