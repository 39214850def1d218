// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/pair_axis.hpp"

#include <gtest/gtest.h>

#include "shared/running_time.hpp"

namespace mtstereo::plugin::pair_axis_test {
namespace {

constexpr Nanoseconds kSkew = 100'000'000;

/// The segment of a file of 10 s, as a pad with this offset gets it.
std::shared_ptr<StreamSegment> segment_at(double rate, Nanoseconds pad_offset) {
  auto stream = std::make_shared<StreamSegment>();
  GstSegment& segment = stream->segment;
  gst_segment_init(&segment, GST_FORMAT_TIME);
  segment.rate = rate;
  segment.stop = 10 * GST_SECOND;
  stream->pad_offset = pad_offset;
  gst_segment_offset_running_time(&segment, GST_FORMAT_TIME, pad_offset);
  return stream;
}

TEST(PairAxis, AnOffsetShiftsFramesOfTheFileAlikeAtEveryRate) {
  for (const double rate : {1.0, 2.0, -1.0, -2.0}) {
    const auto left = segment_at(rate, 0);
    const auto right = segment_at(rate, kSkew);
    const PairAxis axis(left, right);
    const auto left_time = to_running_time(left->segment, 5 * GST_SECOND + kSkew);
    const auto right_time = to_running_time(right->segment, 5 * GST_SECOND);
    ASSERT_TRUE(left_time && right_time);
    EXPECT_EQ(axis.time(Side::kLeft, *left_time), axis.time(Side::kRight, *right_time)) << rate;
  }
}

}  // namespace
}  // namespace mtstereo::plugin::pair_axis_test
