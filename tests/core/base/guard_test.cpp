// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/guard.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mtstereo::guard_test {
namespace {

TEST(Guard, ReturnsTheResultOfTheBody) {
  const Result<int> value = guarded([]() -> Result<int> { return 7; });
  ASSERT_TRUE(value.ok());
  EXPECT_EQ(7, *value);
  EXPECT_TRUE(guarded([]() -> Status { return {}; }).ok());
  const Status failed = guarded([]() -> Status {
    return Error{ErrorCode::kSizeMismatch, "sizes differ"};
  });
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(ErrorCode::kSizeMismatch, failed.error().code);
  EXPECT_EQ("sizes differ", failed.error().message);
}

TEST(Guard, TurnsBadAllocIntoAnOutOfMemoryError) {
  const Status status = guarded([]() -> Status { throw std::bad_alloc(); });
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(ErrorCode::kOutOfMemory, status.error().code);
}

TEST(Guard, TurnsEveryOtherExceptionIntoASystemError) {
  for (const bool standard : {true, false}) {
    const Result<int> result = guarded([&]() -> Result<int> {
      if (standard) throw std::runtime_error("broken");
      throw 5;
    });
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(ErrorCode::kSystem, result.error().code);
  }
}

}  // namespace
}  // namespace mtstereo::guard_test
