// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace mtstereo::test {

/// Restricts GStreamer to the plugin of this build and the few others that the tests use: the
/// user's plugins and registry are not used. Create it before gst_init().
class TestEnvironment {
 public:
  TestEnvironment();
  ~TestEnvironment();
  TestEnvironment(const TestEnvironment&) = delete;
  TestEnvironment& operator=(const TestEnvironment&) = delete;

  /// A temporary folder, removed by the destructor.
  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
};

/// Runs the tests of a program. argc and argv are those of main().
int run_tests(int argc, char** argv);

}  // namespace mtstereo::test
