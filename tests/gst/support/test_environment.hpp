// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace mtstereo::test {

/// A GStreamer that knows the plugin of this build and the few others that the tests name, and
/// nothing else: neither the user's plugins nor the user's registry. Made before gst_init().
class TestEnvironment {
 public:
  TestEnvironment();
  ~TestEnvironment();
  TestEnvironment(const TestEnvironment&) = delete;
  TestEnvironment& operator=(const TestEnvironment&) = delete;

  /// A folder that is removed with this object.
  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
};

/// A program that hangs is ended after this long in one test [s].
inline constexpr unsigned kTestTimeout = 120;

/// Runs the tests of a program: argc and argv as main() has them.
int run_tests(int argc, char** argv);

}  // namespace mtstereo::test
