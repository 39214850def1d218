// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "mtstereo/geometry/rectification.hpp"
#include "opencv_camera.hpp"
#include "rigs.hpp"
#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"

namespace mtstereo::test::rectifier_test {
namespace {

using Side = Rectifier::Side;

/// A rectifier with what it was made from.
struct Made {
  StereoCalibration rig;
  Rectification rectification;
  Side side;
  Rectifier rectifier;

  const CameraCalibration& camera() const { return side == Side::kLeft ? rig.left : rig.right; }
};

Made make(const StereoCalibration& rig, const RectificationOptions& options, Side side) {
  Rectification rectification = rectify(rig, options).value();
  Rectifier rectifier = std::move(Rectifier::create(rig, rectification, side).value());
  return {rig, rectification, side, std::move(rectifier)};
}

/// The value of a channel of a rectified pixel, by a plain formula: the position is rounded to 1/32
/// px.
int expected_value(const Made& made, const GrayPlane& in, int channels, int x, int y, int channel,
                   int border) {
  const auto [u, v] = made.rectifier.source_of(x, y);
  const auto position = [](double value) { return std::lrint(value * 32); };
  if (std::isnan(u) || std::abs(u) > 1e6 || std::abs(v) > 1e6) return border;
  const long px = position(u);
  const long py = position(v);
  if (px < 0 || py < 0 || px > (made.camera().width - 1) * 32L ||
      py > (made.camera().height - 1) * 32L) {
    return border;
  }
  const auto value = [&](long column, long row) -> long {
    column = std::min<long>(column, made.camera().width - 1);
    row = std::min<long>(row, made.camera().height - 1);
    return in(static_cast<int>(column) * channels + channel, static_cast<int>(row));
  };
  const long fx = px % 32;
  const long fy = py % 32;
  const long sum =
      (value(px / 32, py / 32) * (32 - fx) + value(px / 32 + 1, py / 32) * fx) * (32 - fy) +
      (value(px / 32, py / 32 + 1) * (32 - fx) + value(px / 32 + 1, py / 32 + 1) * fx) * fy;
  return static_cast<int>((sum + 512) / 1024);
}

ImageView<const std::uint8_t> in_pixels(ImageView<const std::uint8_t> view, int channels) {
  view.width /= channels;
  return view;
}

ImageView<std::uint8_t> in_pixels(ImageView<std::uint8_t> view, int channels) {
  view.width /= channels;
  return view;
}

struct Case {
  int width, height, out_width, out_height, channels, padding;
  double alpha;
};

class Plain : public testing::TestWithParam<Case> {};

TEST_P(Plain, EqualsThePlainFormula) {
  const Case c = GetParam();
  constexpr int kBorder = 77;
  for (const StereoCalibration& rig :
       {plumb_bob_rig(c.width, c.height), fisheye_rig(c.width, c.height)}) {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      Made made = make(rig, {.alpha = c.alpha, .width = c.out_width, .height = c.out_height}, side);
      const GrayPlane image = noise(c.width * c.channels, c.height, 5);
      const PaddedImage<std::uint8_t> in(image, c.padding, 3);
      PaddedImage<std::uint8_t> out(GrayPlane(c.out_width * c.channels, c.out_height, 200),
                                    2 * c.padding, 1);
      const Status status =
          made.rectifier.apply(in_pixels(in.view(), c.channels),
                               in_pixels(out.writable(), c.channels), c.channels, kBorder);
      ASSERT_TRUE(status.ok()) << status.error().message;
      EXPECT_TRUE(in.unchanged());
      EXPECT_TRUE(out.padding_unchanged());
      const auto actual = out.view();
      EXPECT_TRUE(same_pixels(
          c.out_width * c.channels, c.out_height,
          [&](int x, int y) {
            return expected_value(made, image, c.channels, x / c.channels, y, x % c.channels,
                                  kBorder);
          },
          [&](int x, int y) { return static_cast<int>(actual.row(y)[x]); }));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, Plain,
    testing::Values(Case{64, 48, 64, 48, 1, 0, 0}, Case{65, 47, 131, 93, 1, 7, 1},
                    Case{320, 240, 301, 199, 1, 13, 0.5}, Case{97, 61, 97, 61, 3, 5, 1},
                    Case{97, 61, 33, 41, 4, 4, 1}, Case{64, 48, 1, 1, 1, 0, kKeepScale},
                    Case{32, 24, 3, 500, 3, 1, kKeepScale},
                    Case{32, 24, 500, 3, 4, 0, kKeepScale}));

TEST(Rectifier, HandlesImagesOf2Pixels) {
  StereoCalibration rig = pinhole_rig(2, 2);
  for (CameraCalibration* camera : {&rig.left, &rig.right}) {
    camera->center_x = camera->center_y = 0.5;
  }
  Made made = make(rig, {.alpha = kKeepScale, .width = 5, .height = 5}, Side::kLeft);
  const GrayPlane image = noise(2, 2, 3);
  GrayPlane out(5, 5);
  ASSERT_TRUE(made.rectifier.apply(image.view(), {out.pixels.data(), 5, 5, 5}, 1, 9).ok());
  EXPECT_TRUE(same_pixels(
      5, 5, [&](int x, int y) { return expected_value(made, image, 1, x, y, 0, 9); },
      [&](int x, int y) { return static_cast<int>(out(x, y)); }));
}

/// The same by OpenCV's maps and cv::remap().
cv::Mat opencv_rectified(const Made& made, const cv::Mat& image) {
  const Rectification& r = made.rectification;
  const bool left = made.side == Side::kLeft;
  const cv::Mat projection =
      (cv::Mat_<double>(3, 3) << r.focal_length, 0, left ? r.left_center_x : r.right_center_x, 0,
       r.focal_length, r.center_y, 0, 0, 1);
  const cv::Mat rotation = matrix_of(left ? r.left_rotation : r.right_rotation);
  const cv::Size size(r.width, r.height);
  cv::Mat positions;
  cv::Mat weights;
  const CameraCalibration& camera = made.camera();
  if (camera.lens == LensModel::kFisheye) {
    cv::fisheye::initUndistortRectifyMap(camera_matrix(camera), coefficients_of(camera), rotation,
                                         projection, size, CV_16SC2, positions, weights);
  } else {
    cv::initUndistortRectifyMap(camera_matrix(camera), coefficients_of(camera), rotation,
                                projection, size, CV_16SC2, positions, weights);
  }
  cv::Mat out;
  cv::remap(image, out, positions, weights, cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
  return out;
}

TEST(Rectifier, EqualsOpenCvsMapsAndRemap) {
  for (const StereoCalibration& rig : all_rigs()) {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      Made made = make(rig, {.alpha = 0}, side);
      cv::Mat image(rig.left.height, rig.left.width, CV_8U);
      cv::randu(image, 0, 256);
      cv::Mat out(made.rectification.height, made.rectification.width, CV_8U);
      ASSERT_TRUE(made.rectifier
                      .apply({image.data, image.cols, image.rows, image.cols},
                             {out.data, out.cols, out.rows, out.cols})
                      .ok());
      const cv::Mat expected = opencv_rectified(made, image);
      int same = 0;
      int valid = 0;
      for (int y = 0; y < out.rows; ++y) {
        const ValidColumns& columns = made.rectifier.valid_columns()[static_cast<std::size_t>(y)];
        for (int x = columns.begin; x < columns.end; ++x) {
          const int difference = std::abs(out.at<uchar>(y, x) - expected.at<uchar>(y, x));
          // A position in the middle of two steps may be rounded to either.
          ASSERT_LE(difference, 17) << x << " " << y;
          ++valid;
          same += difference == 0 ? 1 : 0;
        }
      }
      EXPECT_GT(valid, 0.98 * out.rows * out.cols);
      EXPECT_GT(same, 0.999 * valid) << "of " << valid;
    }
  }
}

TEST(Rectifier, FisheyePositionsAreExactAt120Degrees) {
  const StereoCalibration rig = fisheye_rig();
  const Made made = make(rig, {.alpha = 0}, Side::kRight);
  const Rectification& r = made.rectification;
  double widest = 0;
  for (const double x : {0.0, 100.5, 320.0, 639.0}) {
    for (const double y : {0.0, 77.25, 240.0, 479.0}) {
      // R2 is orthonormal: its transpose turns the ray back to the camera.
      const Matrix3& m = r.right_rotation;
      const Matrix3 back = {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
      const Vector3 ray = product(
          back, {(x - r.right_center_x) / r.focal_length, (y - r.center_y) / r.focal_length, 1});
      const double angle = std::atan2(std::hypot(ray[0], ray[1]), ray[2]);
      widest = std::max(widest, angle);
      const auto& k = rig.right.coefficients;
      const double distorted = angle * (1 + k[0] * std::pow(angle, 2) + k[1] * std::pow(angle, 4) +
                                        k[2] * std::pow(angle, 6) + k[3] * std::pow(angle, 8));
      const double azimuth = std::atan2(ray[1], ray[0]);
      const auto actual = made.rectifier.source_of(x, y);
      EXPECT_NEAR(actual[0], rig.right.center_x + rig.right.focal_x * distorted * std::cos(azimuth),
                  1e-6);
      EXPECT_NEAR(actual[1], rig.right.center_y + rig.right.focal_y * distorted * std::sin(azimuth),
                  1e-6);
    }
  }
  EXPECT_GT(widest * 180 / std::numbers::pi, 55);
}

TEST(Rectifier, ValidColumnsAreThePixelsThatTheCameraSees) {
  for (const StereoCalibration& rig : all_rigs()) {
    Made made = make(rig, {.alpha = 1}, Side::kLeft);
    const GrayPlane white(rig.left.width, rig.left.height, 255);
    const int width = made.rectification.width;
    const int height = made.rectification.height;
    GrayPlane out(width, height, 3);
    ASSERT_TRUE(made.rectifier.apply(white.view(), {out.pixels.data(), width, height, width}).ok());
    const auto& columns = made.rectifier.valid_columns();
    ASSERT_EQ(columns.size(), static_cast<std::size_t>(height));
    const auto seen = [&](int x, int y) { return x >= 0 && x < width && out(x, y) == 255; };
    for (int y = 0; y < height; ++y) {
      const ValidColumns& row = columns[static_cast<std::size_t>(y)];
      for (int x = row.begin; x < row.end; ++x) ASSERT_TRUE(seen(x, y)) << x << " " << y;
      EXPECT_FALSE(seen(row.begin - 1, y)) << y;
      EXPECT_FALSE(seen(row.end, y)) << y;
      // At the top and at the bottom both corners may be seen, but not what is between them.
      int run = 0;
      for (int x = 0; x < width; ++x) {
        run = seen(x, y) ? run + 1 : 0;
        ASSERT_LE(run, row.end - row.begin) << x << " " << y;
      }
    }
    for (const std::uint8_t pixel : out.pixels) ASSERT_TRUE(pixel == 0 || pixel == 255);
  }
}

TEST(Rectifier, ValidRectangleIsTheLargestOne) {
  for (const StereoCalibration& rig : {plumb_bob_rig(61, 43), fisheye_rig(61, 43)}) {
    const Made made = make(rig, {.alpha = 1}, Side::kLeft);
    const auto& columns = made.rectifier.valid_columns();
    const PixelRectangle found = made.rectifier.valid_rectangle();
    int largest = 0;
    for (int top = 0; top < 43; ++top) {
      for (int bottom = top + 1; bottom <= 43; ++bottom) {
        int begin = 0;
        int end = 61;
        for (int y = top; y < bottom; ++y) {
          begin = std::max(begin, columns[static_cast<std::size_t>(y)].begin);
          end = std::min(end, columns[static_cast<std::size_t>(y)].end);
        }
        largest = std::max(largest, std::max(end - begin, 0) * (bottom - top));
      }
    }
    EXPECT_EQ(found.width * found.height, largest);
    for (int y = found.y; y < found.y + found.height; ++y) {
      EXPECT_LE(columns[static_cast<std::size_t>(y)].begin, found.x);
      EXPECT_GE(columns[static_cast<std::size_t>(y)].end, found.x + found.width);
    }
  }
}

TEST(Rectifier, RefusesWrongImages) {
  Made made = make(plumb_bob_rig(64, 48), {}, Side::kLeft);
  std::vector<std::uint8_t> memory(64 * 48 * 4);
  const ImageView<const std::uint8_t> in{memory.data(), 64, 48, 64};
  const ImageView<std::uint8_t> out{memory.data(), 64, 48, 64};
  const auto code = [&](ImageView<const std::uint8_t> from, ImageView<std::uint8_t> to,
                        int channels) {
    const Status status = made.rectifier.apply(from, to, channels);
    return status.ok() ? -1 : static_cast<int>(status.error().code);
  };
  EXPECT_EQ(code({in.data, 63, 48, 64}, out, 1), static_cast<int>(ErrorCode::kSizeMismatch));
  EXPECT_EQ(code(in, {out.data, 64, 47, 64}, 1), static_cast<int>(ErrorCode::kSizeMismatch));
  EXPECT_EQ(code({nullptr, 64, 48, 64}, out, 1), static_cast<int>(ErrorCode::kInvalidImage));
  EXPECT_EQ(code(in, {nullptr, 64, 48, 64}, 1), static_cast<int>(ErrorCode::kInvalidImage));
  EXPECT_EQ(code(in, out, 3), static_cast<int>(ErrorCode::kInvalidImage));  // the stride
  EXPECT_EQ(code(in, out, 2), static_cast<int>(ErrorCode::kInvalidParameter));
}

TEST(Rectifier, RefusesWrongRectifications) {
  const StereoCalibration rig = plumb_bob_rig(64, 48);
  const Rectification good = rectify(rig).value();
  const auto refused = [&](void (*change)(Rectification&)) {
    Rectification wrong = good;
    change(wrong);
    const auto result = Rectifier::create(rig, wrong, Side::kLeft);
    return !result.ok() && result.error().code == ErrorCode::kInvalidCalibration &&
           !result.error().message.empty();
  };
  EXPECT_TRUE(refused([](Rectification& r) { r.width = 0; }));
  EXPECT_TRUE(refused([](Rectification& r) { r.height = 20000; }));
  EXPECT_TRUE(refused([](Rectification& r) { r.focal_length = 0; }));
  EXPECT_TRUE(refused([](Rectification& r) { r.center_y = std::nan(""); }));
  EXPECT_TRUE(refused([](Rectification& r) { r.left_rotation[4] = std::nan(""); }));
  StereoCalibration wrong = rig;
  wrong.left.focal_x = -1;
  EXPECT_FALSE(Rectifier::create(wrong, good, Side::kLeft).ok());
}

}  // namespace
}  // namespace mtstereo::test::rectifier_test
