// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/time_filter.hpp"

#include <gtest/gtest.h>

#include "reference/prepare/time_filter.hpp"
#include "support/compare.hpp"
#include "support/means.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::time_filter_test {
namespace {

/// A stream of one view.
class Stream {
 public:
  Stream(int width, int height, int band) : band_(band) {
    blocks.resize(width, height);
    means.resize(width, height);
    means.clear();
  }

  /// Adds a frame with this noise, and returns the share of still blocks.
  double add(GrayView view, float noise, bool anew) {
    double share = 0;
    if (!first_) {
      bands(view, [&](int y0, int y1) { measure_changes(view, means.filtered, y0, y1, blocks); });
      share = rate_changes(noise, means.frames, blocks);
    }
    count_frames(anew || first_, means.frames, blocks, means.frames);
    first_ = false;
    bands(view, [&](int y0, int y1) { average_rows(view, y0, y1, blocks, means, means); });
    return share;
  }
  double add(const GrayPlane& view, float noise, bool anew = false) {
    return add(view.view(), noise, anew);
  }

  TimeBlocks blocks;
  Means means;

 private:
  template <typename Body>
  void bands(GrayView view, Body body) const {
    for (int i = (view.height - 1) / band_; i >= 0; --i) {
      body(i * band_, std::min(i * band_ + band_, view.height));
    }
  }

  int band_;
  bool first_ = true;
};

/// The next frame of a view, with other noise.
GrayPlane with_noise(GrayPlane view, int most, Random& random) {
  for (std::uint8_t& pixel : view.pixels) {
    pixel = static_cast<std::uint8_t>(std::clamp(pixel + random.between(-most, most), 0, 255));
  }
  return view;
}

TEST(TimeFilter, EqualsReferenceAtEverySizeOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    Random random(1);
    for (int width = 1; width <= 150; width += random.between(1, 9)) {
      const int height = random.between(1, 40);
      Stream stream(width, height, random.below(2) == 0 ? 8 : 32);
      reference::PastView expected;
      GrayPlane scene = test::noise(width, height, width);
      for (int frame = 0; frame < 6; ++frame) {
        GrayPlane view = with_noise(scene, 3, random);
        if (frame == 3) view(width / 2, height / 2) ^= 128;
        const test::PaddedImage<std::uint8_t> padded(view, random.below(70), random.below(9));
        const bool anew = frame == 0 || random.below(8) == 0;
        double share = 0;
        if (frame > 0) share = reference::rate_changes(view, 1.7F, expected);
        reference::average(view, anew, expected);
        EXPECT_EQ(share, stream.add(padded.view(), 1.7F, anew)) << width << ", frame " << frame;
        EXPECT_TRUE(same_image(expected.frames, copy_of(stream.means.frames))) << width;
        EXPECT_TRUE(same_image(expected.filtered, copy_of(stream.means.filtered))) << width;
        EXPECT_TRUE(same_image(expected.mean, test::copy_of_means(stream.means))) << width;
      }
    }
  });
}

TEST(TimeFilter, AveragesFramesThatDifferByNoise) {
  Random random(2);
  const GrayPlane scene = test::noise(160, 96, 5);
  Stream stream(160, 96, 32);
  double first = 0, last = 0;
  for (int frame = 0; frame < 20; ++frame) {
    const GrayPlane view = with_noise(scene, 5, random);
    const double share = stream.add(view, 3.2F);
    EXPECT_TRUE(frame == 0 || share > 0.95) << frame;
    double sum = 0;
    for (int y = 0; y < 96; ++y) {
      for (int x = 0; x < 160; ++x) {
        const double error = stream.means.filtered.row(y)[x] - scene(x, y);
        sum += error * error;
      }
    }
    (frame == 0 ? first : last) = sum;
  }
  EXPECT_LT(last, 0.25 * first) << "less than half of the noise";
}

TEST(TimeFilter, AFrameThatBeginsAnewIsTheView) {
  Random random(3);
  Stream stream(50, 30, 32);
  for (int frame = 0; frame < 9; ++frame) {
    const GrayPlane view = test::noise(50, 30, frame / 4);
    stream.add(view, 2, frame == 6);
    if (frame == 0 || frame == 6) {
      EXPECT_TRUE(same_image(view, copy_of(stream.means.filtered)));
    }
  }
}

TEST(TimeFilter, NothingIsAveragedInAndBesideABlockThatChanges) {
  Random random(4);
  const GrayPlane scene(120, 88, 100);
  Stream stream(120, 88, 32);
  for (int frame = 0; frame < 12; ++frame) {
    GrayPlane view = with_noise(scene, 2, random);
    const int moving = frame % 2 == 0 ? 60 : 140;
    for (int y = 40; y < 48; ++y) {
      for (int x = 56; x < 64; ++x) view(x, y) = static_cast<std::uint8_t>(moving);
    }
    stream.add(view, 1.4F);
    for (int y = 32; y < 56; ++y) {
      for (int x = 48; x < 72; ++x) ASSERT_EQ(view(x, y), stream.means.filtered.row(y)[x]);
    }
  }
  EXPECT_GT(stream.means.frames.row(1)[1], 4 * kFramesOne) << "far from it";
}

TEST(TimeFilter, NothingIsAveragedWhenTheLightChanges) {
  Random random(5);
  Stream stream(64, 64, 32);
  for (int frame = 0; frame < 6; ++frame) {
    const GrayPlane view = with_noise(GrayPlane(64, 64, frame < 5 ? 100 : 103), 2, random);
    const double share = stream.add(view, 1.4F);
    if (frame == 5) {
      EXPECT_LT(share, 0.1);
    }
  }
  EXPECT_EQ(kFramesOne, stream.means.frames.row(0)[0]);
}

}  // namespace
}  // namespace mtstereo::time_filter_test
