// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::run::program_test {
namespace {

TEST(RunProgram, ReturnsStatusAndOutput) {
  const ProgramResult result = run_program({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(result.status, 3);
  EXPECT_EQ(result.output, "out\n");
  EXPECT_EQ(result.errors, "err\n");
  EXPECT_EQ(run_program({"sh", "-c", "kill -9 $$"}).status, 137);
}

TEST(RunProgram, NamesAProgramThatIsMissing) {
  EXPECT_THAT([] { run_program({"mtstereo-there-is-no-such-program"}); },
              ::testing::ThrowsMessage<UserError>(
                  "mtstereo-there-is-no-such-program: is not installed, or not in PATH"));
}

}  // namespace
}  // namespace mtstereo::run::program_test
