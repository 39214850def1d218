// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/guard.hpp"
#include "geometry/calibration_problem.hpp"
#include "geometry/check_image.hpp"
#include "geometry/lens.hpp"
#include "geometry/remapping.hpp"
#include "geometry/rotate.hpp"
#include "geometry/valid_pixels.hpp"
#include "mtstereo/geometry/rectification.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo {
namespace {

/// How one rectified view is projected.
struct RectifiedView {
  Matrix3 rotation{};  ///< from the camera to the rectified axes
  double focal_length = 0;
  double center_x = 0;
  double center_y = 0;

  Vector3 ray(double x, double y) const {
    return rotate_back(rotation, {(x - center_x) / focal_length, (y - center_y) / focal_length, 1});
  }
};

RectifiedView view_of(const Rectification& rectification, bool left) {
  return {
      left ? rectification.left_rotation : rectification.right_rotation, rectification.focal_length,
      left ? rectification.left_center_x : rectification.right_center_x, rectification.center_y};
}

std::string rectification_problem(const Rectification& rectification, const RectifiedView& view) {
  for (const int side : {rectification.width, rectification.height}) {
    if (side >= 1 && side <= kLargestImageSide) continue;
    return "The rectified images have " + std::to_string(rectification.width) + "x" +
           std::to_string(rectification.height) + " px; each side must be 1 to " +
           std::to_string(kLargestImageSide) + " px.";
  }
  const bool finite = std::isfinite(view.focal_length) && std::isfinite(view.center_x) &&
                      std::isfinite(view.center_y) &&
                      std::all_of(view.rotation.begin(), view.rotation.end(),
                                  [](double value) { return std::isfinite(value); });
  if (finite && view.focal_length > 0) return {};
  return "The rectification states a focal length that is not positive, or a value that is not "
         "finite.";
}

template <typename T>
bool has_rows(const ImageView<T>& view, int channels) {
  return view.data != nullptr && view.stride >= static_cast<std::ptrdiff_t>(view.width) * channels;
}

}  // namespace

class Rectifier::State {
 public:
  State(const CameraCalibration& camera, const Rectification& rectification,
        const RectifiedView& view)
      : lens_(camera), view_(view) {
    map_.reset(rectification.width, rectification.height, camera.width, camera.height);
    for (int y = 0; y < rectification.height; ++y) {
      for (int x = 0; x < rectification.width; ++x) {
        const auto [u, v] = source_of(x, y);
        map_.append(x, y, u, v);
      }
    }
    columns_ = longest_runs(map_.runs(), rectification.height);
    rectangle_ = largest_rectangle(columns_);
  }

  std::array<double, 2> source_of(double x, double y) const {
    return lens_.project(view_.ray(x, y));
  }

  Status apply(ImageView<const std::uint8_t> in, ImageView<std::uint8_t> out, int channels,
               std::uint8_t border) const {
    if (channels != 1 && channels != 3 && channels != 4) {
      return Error{ErrorCode::kInvalidParameter, "An image to rectify has " +
                                                     std::to_string(channels) +
                                                     " channels; it must have 1, 3 or 4."};
    }
    if (in.width != map_.in_width() || in.height != map_.in_height() || out.width != map_.width() ||
        out.height != map_.height()) {
      return Error{ErrorCode::kSizeMismatch,
                   "The image to rectify has " + image_size_text(in.width, in.height) +
                       " and the rectified one " + image_size_text(out.width, out.height) +
                       ", but the calibration is for " +
                       image_size_text(map_.in_width(), map_.in_height()) + " and " +
                       image_size_text(map_.width(), map_.height()) + "."};
    }
    if (!has_rows(in, channels) || !has_rows(out, channels)) {
      return Error{ErrorCode::kInvalidImage,
                   "An image to rectify has no data, or a stride shorter than a row."};
    }
    remap(map_, in, out, channels, border);
    return {};
  }

  const std::vector<ValidColumns>& columns() const { return columns_; }
  PixelRectangle rectangle() const { return rectangle_; }

 private:
  Lens lens_;
  RectifiedView view_;
  PositionMap map_;
  std::vector<ValidColumns> columns_;
  PixelRectangle rectangle_;
};

Result<Rectifier> Rectifier::create(const StereoCalibration& calibration,
                                    const Rectification& rectification, Side side) noexcept {
  return guarded([&]() -> Result<Rectifier> {
    const bool left = side == Side::kLeft;
    const CameraCalibration& camera = left ? calibration.left : calibration.right;
    const std::string problem = camera_problem(camera);
    if (!problem.empty()) {
      return Error{ErrorCode::kInvalidCalibration, std::string("The calibration of the ") +
                                                       (left ? "left" : "right") + " camera " +
                                                       problem};
    }
    const RectifiedView view = view_of(rectification, left);
    const std::string wrong = rectification_problem(rectification, view);
    if (!wrong.empty()) return Error{ErrorCode::kInvalidCalibration, wrong};
    return Rectifier(std::make_unique<State>(camera, rectification, view));
  });
}

Rectifier::Rectifier(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
Rectifier::~Rectifier() = default;
Rectifier::Rectifier(Rectifier&&) noexcept = default;
Rectifier& Rectifier::operator=(Rectifier&&) noexcept = default;

Status Rectifier::apply(ImageView<const std::uint8_t> in, ImageView<std::uint8_t> out, int channels,
                        std::uint8_t border) noexcept {
  return guarded([&]() -> Status { return state_->apply(in, out, channels, border); });
}

std::array<double, 2> Rectifier::source_of(double x, double y) const noexcept {
  return state_->source_of(x, y);
}

const std::vector<ValidColumns>& Rectifier::valid_columns() const noexcept {
  return state_->columns();
}

PixelRectangle Rectifier::valid_rectangle() const noexcept { return state_->rectangle(); }

}  // namespace mtstereo
