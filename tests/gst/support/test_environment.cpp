// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support/test_environment.hpp"

#include <gst/gst.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace mtstereo::test {
namespace {

constexpr const char* kPlugins[] = {
    "app",
    "debug",
    "coreelements",
    "coretracers",
    "deinterlace",
    "imagefreeze",
    "interlace",
    "isomp4",
    "libav",
    "matroska",
    "rawparse",
    "videobox",
    "videoconvertscale",
    "videocrop",
    "videoparsersbad",
    "videorate",
    "videotestsrc",
    "videofilter",
    "x264",
};

/// Timeout of a test [s]; then the program is terminated. The factor is 1 without a sanitizer.
constexpr unsigned kTestTimeout = 120 * MTSTEREO_SLOWNESS;

void unset_all() {
  for (const char* name : {"GST_PLUGIN_PATH", "GST_PLUGIN_SYSTEM_PATH", "GST_REGISTRY",
                           "GST_PLUGIN_LOADING_WHITELIST", "DISPLAY", "WAYLAND_DISPLAY"}) {
    unsetenv(name);
  }
}

/// Prints the name of a test that exceeds its timeout, and terminates the program.
class Watchdog : public testing::EmptyTestEventListener {
 public:
  Watchdog() { std::signal(SIGALRM, bark); }
  void OnTestStart(const testing::TestInfo& info) override {
    std::snprintf(name_, sizeof name_, "\n%s.%s timed out after %u s\n", info.test_suite_name(),
                  info.name(), kTestTimeout);
    alarm(kTestTimeout);
  }
  void OnTestEnd(const testing::TestInfo&) override { alarm(0); }

 private:
  static void bark(int) {
    const std::size_t length = __builtin_strlen(name_);
    if (write(STDERR_FILENO, name_, length) != static_cast<ssize_t>(length)) _exit(3);
    _exit(2);
  }
  static inline char name_[256] = {};
};

}  // namespace

TestEnvironment::TestEnvironment() {
  std::string pattern = (std::filesystem::temp_directory_path() / "mtstereo-test-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    std::perror("cannot create a temporary folder");
    std::exit(1);
  }
  folder_ = pattern;
  const std::filesystem::path plugins = std::filesystem::path(folder_) / "plugins";
  std::filesystem::create_directory(plugins);
  for (const char* name : kPlugins) {
    const std::string file = std::string("libgst") + name + ".so";
    const std::filesystem::path source = std::filesystem::path(MTSTEREO_SYSTEM_PLUGINS) / file;
    if (std::filesystem::exists(source)) std::filesystem::create_symlink(source, plugins / file);
  }
  unset_all();
  setenv("GST_PLUGIN_SYSTEM_PATH_1_0", plugins.c_str(), 1);
  setenv("GST_PLUGIN_PATH_1_0", MTSTEREO_PLUGIN, 1);
  setenv("GST_REGISTRY_1_0", (folder_ + "/registry.bin").c_str(), 1);
  // The plugin scanner is a separate program that cannot load a plugin built with sanitizers.
  setenv("GST_REGISTRY_FORK", "no", 1);
}

TestEnvironment::~TestEnvironment() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

int run_tests(int argc, char** argv) {
  const TestEnvironment environment;
  testing::InitGoogleTest(&argc, argv);
  gst_init(&argc, &argv);
  // A critical message of GStreamer means a bug in the element.
  g_log_set_always_fatal(static_cast<GLogLevelFlags>(G_LOG_FATAL_MASK | G_LOG_LEVEL_CRITICAL));
  testing::UnitTest::GetInstance()->listeners().Append(new Watchdog);
  const int result = RUN_ALL_TESTS();
  gst_deinit();
  return result;
}

}  // namespace mtstereo::test
