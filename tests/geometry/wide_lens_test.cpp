// SPDX-License-Identifier: LGPL-2.1-or-later

// Lenses that the usual ways of framing rectified views do not suit: models that cannot be inverted
// everywhere in the image, and fields of view that no plane can show.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/lens.hpp"
#include "mtstereo/geometry/rectification.hpp"
#include "mtstereo/geometry/rig.hpp"
#include "rigs.hpp"
#include "seen_border.hpp"

namespace mtstereo::test::wide_lens_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Rectification rectified(const StereoCalibration& rig, double alpha) {
  const Result<Rectification> result = rectify(rig, {.alpha = alpha});
  EXPECT_TRUE(result.ok()) << result.error().message;
  return result.ok() ? *result : Rectification{};
}

std::string remarks_of(const StereoCalibration& rig, const Rectification& rectification,
                       bool warnings = false) {
  const auto remarks = rectification_remarks(rig, rectification);
  EXPECT_TRUE(remarks.ok());
  std::string text;
  for (const RectificationRemark& remark : *remarks) {
    if (remark.warning || !warnings) text += remark.text + "\n";
  }
  return text;
}

std::vector<StereoCalibration> wide_rigs() {
  return {pole_rig(),          turning_rig(),       fisheye_rig_of(150),
          fisheye_rig_of(160), fisheye_rig_of(178), fisheye_rig_of(200)};
}

TEST(WideLenses, WithoutBordersAtAlpha0) {
  for (const StereoCalibration& rig : wide_rigs()) {
    const Rectification r = rectified(rig, 0);
    EXPECT_GT(seen_border(rig, r, Rectifier::Side::kLeft), 0.995) << rig.left.focal_x;
    EXPECT_GT(seen_border(rig, r, Rectifier::Side::kRight), 0.995) << rig.left.focal_x;
    EXPECT_NEAR(r.baseline, rig.baseline(), 1e-9);
    // The middle keeps at least 0.45 of the scale of the camera.
    EXPECT_GT(r.focal_length, 0.45 * rig.left.focal_x);
    EXPECT_EQ(remarks_of(rig, r, true), "");
  }
}

TEST(WideLenses, FieldOfView) {
  const auto across = [](const StereoCalibration& rig, double alpha) {
    return rig_figures(rectified(rig, alpha)).horizontal_field;
  };
  EXPECT_GT(across(pole_rig(), 0), 62);
  EXPECT_LT(across(pole_rig(), 0), 76);
  EXPECT_GT(across(turning_rig(), 0), 95);
  for (const double field : {160.0, 178.0, 200.0}) {
    EXPECT_GT(across(fisheye_rig_of(field), 0), 130) << field;
    EXPECT_LT(across(fisheye_rig_of(field), 0), 141) << field;
    EXPECT_NEAR(across(fisheye_rig_of(field), 1), 170, 2) << field;
  }
}

/// The directions of the pixels that a rectified view shows are those that the lens model gives
/// back for their positions: no pixel of the image is shown twice.
void expect_no_ghosts(const StereoCalibration& rig, const Rectification& r) {
  const auto rectifier = Rectifier::create(rig, r, Rectifier::Side::kLeft);
  ASSERT_TRUE(rectifier.ok());
  const Lens lens(rig.left);
  int shown = 0;
  for (int y = 0; y < r.height; y += 7) {
    for (int x = 0; x < r.width; x += 7) {
      const auto [u, v] = rectifier->source_of(x, y);
      if (!(u >= 0 && v >= 0 && u <= rig.left.width - 1 && v <= rig.left.height - 1)) continue;
      ++shown;
      const Vector3 ray = product(r.left_rotation, lens.direction(u, v));
      if (std::isnan(ray[2])) continue;  // a little beyond the limit of the radial part
      ASSERT_NEAR(r.focal_length * ray[0] / ray[2] + r.left_center_x, x, 0.01);
      ASSERT_NEAR(r.focal_length * ray[1] / ray[2] + r.center_y, y, 0.01);
    }
  }
  EXPECT_GT(shown, 100);
}

TEST(WideLenses, ShowNothingTwice) {
  for (const StereoCalibration& rig : wide_rigs()) {
    for (const double alpha : {0.0, 0.5, 1.0, kKeepScale})
      expect_no_ghosts(rig, rectified(rig, alpha));
  }
}

TEST(WideLenses, PixelsBeyondTheLimitOfTheModelAreInvalid) {
  const StereoCalibration rig = pole_rig();
  Rectification r = rectified(rig, 0);
  r.focal_length *= 0.7;
  const double limit = Lens(rig.left).widest_angle();
  const auto rectifier = Rectifier::create(rig, r, Rectifier::Side::kLeft);
  ASSERT_TRUE(rectifier.ok());
  for (int y = 0; y < r.height; y += 10) {
    const ValidColumns row = rectifier->valid_columns()[static_cast<std::size_t>(y)];
    if (row.begin == row.end) continue;
    for (const int x : {row.begin, row.end - 1}) {
      const double tangent =
          std::hypot((x - r.left_center_x) / r.focal_length, (y - r.center_y) / r.focal_length);
      EXPECT_LT(std::atan(tangent), limit + 2 * kDegree);
    }
    EXPECT_LT(row.end - row.begin, r.width);
  }
}

TEST(WideLenses, RemarksStateWhatIsCutOff) {
  const StereoCalibration pole = pole_rig();
  const std::string left_out = remarks_of(pole, rectified(pole, 0));
  EXPECT_NE(left_out.find("The lens model of the left camera ends 3"), std::string::npos)
      << left_out;
  EXPECT_NE(left_out.find("right camera ends"), std::string::npos) << left_out;
  const StereoCalibration fisheye = fisheye_rig_of(178);
  const std::string cut = remarks_of(fisheye, rectified(fisheye, 0));
  EXPECT_NE(cut.find("The left camera sees 17"), std::string::npos) << cut;
  EXPECT_NE(cut.find("show 140 x "), std::string::npos) << cut;
  for (const StereoCalibration& usual : all_rigs()) {
    EXPECT_EQ(remarks_of(usual, rectified(usual, 0)), "");
  }
}

TEST(WideLenses, ALensModelThatEndsBeforeMostOfTheImageIsAWarning) {
  StereoCalibration rig = plumb_bob_rig();
  EXPECT_EQ(remarks_of(pole_rig(), rectified(pole_rig(), 0), true), "");
  rig.left.coefficients = {-10, 0, 0, 0, 0};
  const std::string text = remarks_of(rig, rectified(rig, 0), true);
  EXPECT_NE(text.find("The lens model of the left camera ends 1"), std::string::npos) << text;
  EXPECT_NE(text.find("is hardly that of this camera"), std::string::npos) << text;
}

TEST(WideLenses, AViewThatIsNearlyEmptyIsAWarning) {
  const StereoCalibration rig = plumb_bob_rig();
  Rectification r = rectified(rig, 0);
  r.right_center_x += 0.9 * r.width;
  const std::string text = remarks_of(rig, r, true);
  EXPECT_NE(text.find("The right camera fills only 1"), std::string::npos) << text;
  EXPECT_NE(text.find("of 640 columns"), std::string::npos) << text;
  EXPECT_EQ(text.find("left camera"), std::string::npos) << text;
}

TEST(WideLenses, AModelThatCannotBeInvertedIsRefused) {
  StereoCalibration rig = plumb_bob_rig();
  rig.right.coefficients = {-1e9, 0, 0, 0, 0};
  rig.right.center_x = -200;  // the image is beyond where the model turns back
  for (const double alpha : {0.0, 1.0, kKeepScale}) {
    const auto result = rectify(rig, {.alpha = alpha});
    ASSERT_FALSE(result.ok());
    EXPECT_NE(result.error().message.find("right camera has a lens model that cannot be inverted"),
              std::string::npos)
        << result.error().message;
  }
}

TEST(WideLenses, PositionsWithoutADirectionAreNotANumber) {
  const CameraCalibration camera = turning_rig().left;
  for (const double component : Lens(camera).direction(0, 0)) EXPECT_TRUE(std::isnan(component));
}

}  // namespace
}  // namespace mtstereo::test::wide_lens_test
