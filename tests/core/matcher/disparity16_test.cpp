// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "support/compare.hpp"
#include "support/matching.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"

namespace mtstereo::disparity16_test {
namespace {

using test::fails_with;
using test::PaddedImage;
using test::Plane;

/// The value that is written for one disparity [1/256 px].
int written(std::int32_t disparity, int scale) {
  const DisparityPlane in(1, 1, disparity);
  std::uint16_t out = 0xA5A5;
  const Status status = write_disparity16(in.view(), scale, {&out, 1, 1, 2});
  EXPECT_TRUE(status.ok());
  return out;
}

// Feature: float output
TEST(WriteDisparity16, RoundsToTheNearestStep) {
  for (const int scale : {1, 2, 7, 16, 100, 256, 1000, 65535}) {
    for (std::int32_t d = 1; d < 1984 * 256; d += d < 2000 ? 1 : 997) {
      const double exact = std::floor(d * static_cast<double>(scale) / 256 + 0.5);
      ASSERT_EQ(std::clamp(exact, 1.0, 65535.0), written(d, scale))
          << d << "/256 px, scale " << scale;
    }
  }
}

TEST(WriteDisparity16, EqualsTheKittiFormatAtScale256) {
  EXPECT_EQ(37 * 256 + 128, written(37 * 256 + 128, 256));
}

// Feature: 0 marks unknown
TEST(WriteDisparity16, WritesAtLeastOneForAKnownDisparity) {
  for (const int scale : {1, 16, 127, 256}) {
    EXPECT_EQ(0, written(kNoDisparity, scale));
    EXPECT_EQ(1, written(1, scale)) << "scale " << scale;
  }
  EXPECT_EQ(0, written(kNoDisparity, 65535));
}

TEST(WriteDisparity16, SaturatesAtTheLargestValue) {
  EXPECT_EQ(65535, written(1023 * 256, 256));
  EXPECT_EQ(65535, written(1984 * 256 - 1, 65535));
  EXPECT_EQ(65535, written(256, 65535));
}

TEST(WriteDisparity16, WritesOnlyThePixelsOfAPaddedImage) {
  test::Random random(1);
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {33, 1}, {31, 13}}) {
    DisparityPlane map(width, height);
    for (std::int32_t& d : map.pixels) d = random.below(2) * random.between(1, 100 * 256);
    Plane<std::uint16_t> expected(width, height);
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
      expected.pixels[i] = static_cast<std::uint16_t>(written(map.pixels[i], 64));
    }
    for (const int padding : {0, 2, 62, 64}) {
      const PaddedImage<std::int32_t> in(map, 2 * padding);
      PaddedImage<std::uint16_t> out(Plane<std::uint16_t>(width, height, 9), padding, 2);
      ASSERT_TRUE(write_disparity16(in.view(), 64, out.writable()).ok());
      EXPECT_TRUE(same_image(expected, out.view()));
      EXPECT_TRUE(out.padding_unchanged() && in.unchanged())
          << "padding of " << padding << " bytes";
    }
  }
}

/// Both images of a call that may fail; after an error the output must be unchanged.
struct Call {
  DisparityPlane in = DisparityPlane(8, 4, 300);
  Plane<std::uint16_t> out = Plane<std::uint16_t>(8, 4, 7);
  DisparityView in_view = in.view();
  ImageView<std::uint16_t> out_view = {out.pixels.data(), 8, 4, 16};

  Status operator()(int scale = 256) {
    const Status status = write_disparity16(in_view, scale, out_view);
    if (!status) {
      EXPECT_TRUE(same_image(Plane<std::uint16_t>(8, 4, 7), out)) << "the output was written to";
    }
    return status;
  }
};

TEST(WriteDisparity16, RejectsDifferentSizes) {
  for (const auto& [width, height] : {std::pair{7, 4}, {9, 4}, {8, 3}, {8, 5}, {4, 8}, {0, 0}}) {
    Call call;
    call.out_view.width = width;
    call.out_view.height = height;
    EXPECT_TRUE(fails_with(call(), ErrorCode::kSizeMismatch,
                           {"8x4", std::to_string(width) + "x" + std::to_string(height)}));
  }
}

TEST(WriteDisparity16, RejectsMissingData) {
  Call no_in, no_out;
  no_in.in_view.data = nullptr;
  no_out.out_view.data = nullptr;
  EXPECT_TRUE(fails_with(no_in(), ErrorCode::kInvalidImage, {"no data"}));
  EXPECT_TRUE(fails_with(no_out(), ErrorCode::kInvalidImage, {"no data"}));
  Call empty;
  empty.in_view = {};
  empty.out_view = {};
  EXPECT_TRUE(fails_with(empty(), ErrorCode::kInvalidImage, {"no data"}));
}

TEST(WriteDisparity16, RejectsShortStrides) {
  for (const int stride : {15, 8, 0, -16}) {
    Call call;
    call.out_view.stride = stride;
    EXPECT_TRUE(fails_with(call(), ErrorCode::kInvalidImage, {"stride"})) << stride;
  }
  for (const int stride : {31, 8, 0, -32}) {
    Call call;
    call.in_view.stride = stride;
    EXPECT_TRUE(fails_with(call(), ErrorCode::kInvalidImage, {"stride"})) << stride;
  }
}

TEST(WriteDisparity16, RejectsScalesOutsideTheRange) {
  for (const int scale : {0, -1, 65536, 1 << 30, -(1 << 30)}) {
    Call call;
    EXPECT_TRUE(fails_with(call(scale), ErrorCode::kInvalidParameter,
                           {"disparity-scale", std::to_string(scale), "1 to 65535"}));
  }
}

}  // namespace
}  // namespace mtstereo::disparity16_test
