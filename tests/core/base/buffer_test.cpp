// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/buffer.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>

namespace mtstereo::buffer_test {
namespace {

TEST(Buffer, IsAlignedForTheWidestVector) {
  for (const std::size_t count : {1, 3, 63, 64, 65, 1000}) {
    Buffer<std::uint8_t> buffer;
    buffer.resize(count);
    EXPECT_EQ(0u, reinterpret_cast<std::uintptr_t>(buffer.data()) % kAlignment) << count;
    EXPECT_EQ(count, buffer.size());
  }
}

TEST(Buffer, KeepsItsMemoryWhenItShrinksAndGrowsBack) {
  Buffer<int> buffer;
  buffer.resize(1000);
  const int* const memory = buffer.data();
  for (const std::size_t count : {10, 0, 1000, 999}) {
    buffer.resize(count);
    EXPECT_EQ(memory, buffer.data());
    EXPECT_EQ(count, buffer.size());
  }
}

TEST(Buffer, ThrowsBadAllocForImpossibleSizes) {
  Buffer<std::int64_t> buffer;
  buffer.resize(5);
  for (const std::size_t count :
       {std::numeric_limits<std::size_t>::max(), std::numeric_limits<std::size_t>::max() / 8,
        std::numeric_limits<std::size_t>::max() / 8 - 10}) {
    EXPECT_THROW(buffer.resize(count), std::bad_alloc) << count;
  }
  buffer.resize(6);
  buffer[5] = 1;
  EXPECT_EQ(6u, buffer.size());
}

TEST(ReusedMemory, GivesGroupsTheSameMemoryAndBuffersOfAGroupTheirOwn) {
  ReusedMemory memory;
  Buffer<std::uint8_t> first, second;
  Buffer<std::int32_t> other;
  for (int time = 0; time < 2; ++time) {  // the memory grows the first time only
    memory.start_group();
    first.resize(100, &memory);
    second.resize(3, &memory);
    memory.start_group();
    other.resize(1000, &memory);
  }
  EXPECT_EQ(static_cast<void*>(first.data()), other.data());
  EXPECT_GE(second.data() - first.data(), static_cast<std::ptrdiff_t>(100 + kAlignment));
  EXPECT_EQ(0u, reinterpret_cast<std::uintptr_t>(second.data()) % kAlignment);
  EXPECT_EQ(3u, second.size());
  for (std::size_t i = 0; i < other.size(); ++i) other[i] = 1;

  first.resize(100);  // own memory again
  EXPECT_NE(static_cast<void*>(first.data()), other.data());
  for (std::size_t i = 0; i < first.size(); ++i) first[i] = 2;
  EXPECT_EQ(1, other[0]);
}

TEST(ReusedMemory, ThrowsBadAllocForImpossibleSizes) {
  ReusedMemory memory;
  Buffer<std::int64_t> buffer;
  EXPECT_THROW(buffer.resize(std::numeric_limits<std::size_t>::max() / 8, &memory), std::bad_alloc);
  EXPECT_EQ(0u, buffer.size());
  memory.start_group();
  buffer.resize(6, &memory);
  buffer[5] = 1;
  EXPECT_EQ(6u, buffer.size());
}

TEST(Image, PadsEachRowByAWholeVector) {
  for (int width = 1; width <= 130; ++width) {
    Image<std::int16_t> image;
    image.resize(width, 3);
    EXPECT_GE(image.stride() - width, static_cast<std::ptrdiff_t>(kAlignment / 2)) << width;
    EXPECT_EQ(0u, reinterpret_cast<std::uintptr_t>(image.row(1)) % kAlignment) << width;
  }
}

TEST(Image, ViewHasItsSizeAndPixels) {
  Image<std::int32_t> image;
  image.resize(7, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) image.row(y)[x] = 10 * y + x;
  }
  const ImageView<const std::int32_t> view = image.view();
  EXPECT_EQ(7, view.width);
  EXPECT_EQ(5, view.height);
  EXPECT_EQ(34, view.row(3)[4]);
  EXPECT_EQ(0, Image<int>().view().width);
  EXPECT_EQ(nullptr, Image<int>().view().data);
}

}  // namespace
}  // namespace mtstereo::buffer_test
