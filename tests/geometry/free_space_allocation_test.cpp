// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "mtstereo/geometry/free_space.hpp"
#include "support/counting_allocator.hpp"
#include "support/plane.hpp"

namespace mtstereo::test::free_space_allocation_test {
namespace {

Status bound(FreeSpace& space, Plane<std::uint16_t>& map, int width, int height) {
  const ImageView<std::uint16_t> view = {map.pixels.data(), width, height, map.view().stride};
  return space.bound_unknown({view.data, view.width, view.height, view.stride}, view);
}

TEST(FreeSpaceAllocation, MapsOfTheSameSizeOrSmallerAllocateNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  Plane<std::uint16_t> map(320, 240, 256);
  count_allocations();
  FreeSpace space;
  EXPECT_EQ(allocations(), 0);
  ASSERT_TRUE(bound(space, map, 320, 240).ok());
  EXPECT_GT(allocations(), 0);
  count_allocations();
  for (const auto& [width, height] : {std::pair{320, 240}, {319, 240}, {320, 1}, {1, 240}}) {
    ASSERT_TRUE(bound(space, map, width, height).ok());
  }
  EXPECT_EQ(allocations(), 0);
}

TEST(FreeSpaceAllocation, MissingMemoryIsAnError) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  Plane<std::uint16_t> map(32, 24);
  map(1, 4) = map(5, 4) = 256;
  const Plane<std::uint16_t> before = map;
  FreeSpace space;
  fail_allocation_after(0);
  const Status status = bound(space, map, 32, 24);
  EXPECT_TRUE(allocation_has_failed());
  fail_allocation_after(-1);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(map, before);
  EXPECT_TRUE(bound(space, map, 32, 24).ok());
  EXPECT_EQ(map(3, 4), 256);
}

}  // namespace
}  // namespace mtstereo::test::free_space_allocation_test
