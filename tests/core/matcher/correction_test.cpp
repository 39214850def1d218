// SPDX-License-Identifier: LGPL-2.1-or-later
// The correction of the views, seen through the public class: it must give what a caller gets who
// corrects the views and matches them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "stages/prepare/row_alignment.hpp"
#include "stages/prepare/view_blur.hpp"
#include "support/compare.hpp"
#include "support/matching.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"
#include "support/watching.hpp"

namespace mtstereo::correction_test {
namespace {

constexpr const char* kPresetNames[] = {"default", "fast", "paper"};

const test::Pair& pair() {
  static const test::Pair pair = test::slanted_pair(211, 97, 30, 1);
  return pair;
}

GrayPlane aligned(const GrayPlane& view, const RowField& field) {
  Image<std::uint8_t> out;
  out.resize(view.width, view.height);
  AlignmentScratch scratch;
  align_rows(view.view(), field, 0, view.height, scratch, out);
  return test::copy_of(out);
}

GrayPlane blurred(const GrayPlane& view, float sigma) {
  Image<std::uint8_t> out;
  out.resize(view.width, view.height);
  BlurScratch scratch;
  blur_rows(view.view(), gaussian_kernel(sigma), 0, view.height, scratch, out);
  return test::copy_of(out);
}

constexpr ViewCorrection kCorrections[] = {
    {{0.7, -0.5, 0.2, 0.4, -0.3}, 0, 0},
    {{}, 0.8F, 0},
    {{}, 0, 1.3F},
    {{-1.2, 2.5, 1, 0, 0}, 1.5F, 0.6F},
};

TEST(Correction, IsAppliedBeforeAllOtherSteps) {
  for (const char* const preset : kPresetNames) {
    for (const char* const mode : {"semi-dense", "dense"}) {
      Matcher corrects = test::matcher({{"preset", preset}, {"mode", mode}, {"threads", "3"}});
      Matcher plain = test::matcher({{"preset", preset}, {"mode", mode}});
      for (const ViewCorrection& correction : kCorrections) {
        // At full resolution, edges follow the caller's left view.
        if (preset == std::string("default") && correction.left_blur > 0) continue;
        ASSERT_TRUE(corrects.set_correction(correction).ok());
        EXPECT_EQ(correction, corrects.correction());
        GrayPlane left = pair().left, right = pair().right;
        if (!(correction.rows == RowField())) right = aligned(right, correction.rows);
        if (correction.left_blur > 0) left = blurred(left, correction.left_blur);
        if (correction.right_blur > 0) right = blurred(right, correction.right_blur);
        const test::DisparityPlane expected = test::compute(plain, left, right);
        EXPECT_TRUE(same_image(expected, test::compute(corrects, pair().left, pair().right)));
        EXPECT_GT(test::known(expected), 100);
      }
    }
  }
}

TEST(Correction, ThatDoesNothingRunsNoStep) {
  Matcher used = test::matcher({});
  ASSERT_TRUE(used.set_correction(kCorrections[3]).ok());
  test::compute(used, pair().left, pair().right);
  ASSERT_TRUE(used.set_correction({}).ok());
  Matcher fresh = test::matcher({});
  EXPECT_TRUE(same_image(test::compute(fresh, pair().left, pair().right),
                         test::compute(used, pair().left, pair().right)));
  for (const std::string& name : test::names_of_steps({})) {
    EXPECT_TRUE(name != "row-alignment" && name != "sharpness");
  }
}

TEST(Correction, IsKeptWhenParametersChange) {
  Matcher matcher = test::matcher({});
  ASSERT_TRUE(matcher.set_correction(kCorrections[0]).ok());
  ASSERT_TRUE(matcher.set_parameters(test::parameters({{"mode", "dense"}})).ok());
  EXPECT_EQ(kCorrections[0], matcher.correction());
}

TEST(Correction, LeavesTheCallersViewsAlone) {
  const test::PaddedImage<std::uint8_t> left(pair().left, 5, 3), right(pair().right, 11, 1);
  Matcher matcher = test::matcher({});
  ASSERT_TRUE(matcher.set_correction(kCorrections[3]).ok());
  ASSERT_TRUE(matcher.compute(left.view(), right.view()).ok());
  EXPECT_TRUE(left.unchanged() && right.unchanged());
}

TEST(Correction, WorksOnTheSmallestViews) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 20), std::pair(17, 2)}) {
    Matcher matcher = test::matcher({{"max-disparity", "1"}});
    ASSERT_TRUE(matcher.set_correction(kCorrections[3]).ok());
    const GrayPlane view = test::noise(width, height, 1);
    if (!matcher.parameters().check_frame(width, height).ok()) continue;
    EXPECT_TRUE(matcher.compute(view.view(), view.view()).ok());
  }
}

TEST(Correction, OutOfRangeIsAnErrorAndChangesNothing) {
  Matcher matcher = test::matcher({});
  ASSERT_TRUE(matcher.set_correction(kCorrections[0]).ok());
  const auto refused = [&](const ViewCorrection& correction) {
    return test::fails_with(matcher.set_correction(correction), ErrorCode::kInvalidParameter,
                            {"range"});
  };
  EXPECT_TRUE(refused({{101, 0, 0, 0, 0}, 0, 0}));
  EXPECT_TRUE(refused({{0, 0, 0, 0, std::nan("")}, 0, 0}));
  EXPECT_TRUE(refused({{}, 3.1F, 0}));
  EXPECT_TRUE(refused({{}, 0, -0.1F}));
  EXPECT_TRUE(refused({{}, std::numeric_limits<float>::quiet_NaN(), 0}));
  EXPECT_EQ(kCorrections[0], matcher.correction());
}

}  // namespace
}  // namespace mtstereo::correction_test
