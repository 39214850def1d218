// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gtest/gtest.h>

#include <sstream>

#include "support/plane.hpp"

namespace mtstereo::test {

/// Compares expected(x, y) with actual(x, y) at every pixel. A failure states the number of
/// different pixels and the position and both values of the first one.
template <typename Expected, typename Actual>
::testing::AssertionResult same_pixels(int width, int height, Expected&& expected,
                                       Actual&& actual) {
  long wrong = 0;
  std::ostringstream first;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto e = expected(x, y);
      const auto a = actual(x, y);
      if (e == a) continue;
      if (wrong++ == 0) {
        first << "first at (" << x << ", " << y << "): expected " << +e << ", got " << +a;
      }
    }
  }
  if (wrong == 0) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << wrong << " of " << static_cast<long>(width) * height << " pixels of " << width << "x"
         << height << " differ, " << first.str();
}

template <typename T, typename U>
::testing::AssertionResult same_image(const Plane<T>& expected, const Plane<U>& actual) {
  if (expected.width != actual.width || expected.height != actual.height) {
    return ::testing::AssertionFailure() << "expected " << expected.width << "x" << expected.height
                                         << " px, got " << actual.width << "x" << actual.height;
  }
  return same_pixels(
      expected.width, expected.height, [&](int x, int y) { return expected(x, y); },
      [&](int x, int y) { return actual(x, y); });
}

template <typename T, typename U>
::testing::AssertionResult same_image(const Plane<T>& expected, const Image<U>& actual) {
  return same_image(expected, copy_of(actual));
}

template <typename T, typename U>
::testing::AssertionResult same_image(const Plane<T>& expected, ImageView<U> actual) {
  return same_image(expected, copy_of(actual));
}

}  // namespace mtstereo::test

namespace mtstereo {

using test::same_image;

}  // namespace mtstereo
