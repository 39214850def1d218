// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "cameras/camera_harness.hpp"
#include "geometry/rigs.hpp"
#include "support/counting_allocator.hpp"

namespace mtstereo::test::rectify_allocation_test {
namespace {

/// Allocations for `frames` frames that are passed one after the other.
long allocations_for(const char* format, int frames) {
  CalibrationFolder folder;
  CameraHarness harness("mtrectify",
                        "alpha=1 calibration=" + folder.write(plumb_bob_rig(320, 240)));
  harness.caps(raw_caps(format, 320, 240));
  const GrayImage image = noise_pair(320, 240, 0, 3).left;
  const BufferPointer frame(frame_buffer(image, 0, kFrame, {.format = format}));
  const BufferPointer out = harness.pass(gst_buffer_ref(frame.get()));
  EXPECT_NE(gst_buffer_get_custom_meta(out.get(), "MtStereoValidColumnsMeta"), nullptr);
  gst_harness_set_drop_buffers(harness.harness(), TRUE);
  for (int i = 0; i < 5; ++i) harness.push(gst_buffer_ref(frame.get()));
  count_allocations();
  for (int i = 0; i < frames; ++i) harness.push(gst_buffer_ref(frame.get()));
  return allocations();
}

TEST(RectifyAllocation, FramesAllocateNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  for (const char* format : {"GRAY8", "I420", "NV12"}) {
    EXPECT_EQ(allocations_for(format, 100), 0) << format;
  }
}

}  // namespace
}  // namespace mtstereo::test::rectify_allocation_test
