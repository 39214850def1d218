// SPDX-License-Identifier: LGPL-2.1-or-later
// Feature: leaks, sanitizers, fuzzing
// Plays the element in hostile ways for some time and prints what happened as a table.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "soak.hpp"
#include "support/test_environment.hpp"

namespace mtstereo::soak {
namespace {

struct Case {
  const char* name;
  void (*run)(Soak& soak);
};
constexpr std::array kCases = {
    Case{"seeks", seek_in_files},        Case{"states", change_states},
    Case{"properties", set_properties},  Case{"caps", change_caps},
    Case{"wrong-caps", send_wrong_caps}, Case{"wrong-frames", send_wrong_frames},
    Case{"ends", end_streams},           Case{"links", relink_pads},
    Case{"loss", lose_frames},           Case{"live", play_live}};

std::atomic<int> critical_messages{0};

/// GObject's message about a value that is out of range is expected.
void handle_message(const gchar* domain, GLogLevelFlags level, const gchar* message, gpointer) {
  const bool critical = (level & (G_LOG_LEVEL_CRITICAL | G_LOG_LEVEL_ERROR)) != 0;
  if (!critical || std::strstr(message, "out of range for property") != nullptr) return;
  ++critical_messages;
  std::fprintf(stderr, "critical: %s: %s\n", domain != nullptr ? domain : "", message);
}

/// Objects that the tracer reports as alive after gst_deinit(). Its first line explains the format.
int count_leaks(const std::string& file) {
  std::ifstream stream(file);
  int leaks = 0;
  for (std::string line; std::getline(stream, line);) {
    if (line.find("object-alive, type-name=(string)Gst") == std::string::npos) continue;
    ++leaks;
    std::fprintf(stderr, "leak: %s\n", line.c_str());
  }
  return leaks;
}

/// Runs all cases in turn, or only those of this name.
void run(Soak& soak, double seconds, const std::string& only) {
  const gint64 end = g_get_monotonic_time() + static_cast<gint64>(seconds * G_USEC_PER_SEC);
  while (g_get_monotonic_time() < end) {
    for (const Case& one_case : kCases) {
      if (only.empty() || only == one_case.name) one_case.run(soak);
    }
    soak.sample_memory();
  }
  if (critical_messages > 0) {
    soak.fail("all", std::to_string(critical_messages) + " critical messages");
  }
  if (testing::Test::HasFailure()) soak.fail("all", "an expectation of the support code failed");
}

int usage() {
  std::fprintf(stderr, "usage: mtstereo-soak --seconds N [--seed N] [--only CASES]\n");
  return 2;
}

}  // namespace
}  // namespace mtstereo::soak

int main(int argc, char** argv) {
  using namespace mtstereo;
  double seconds = 0;
  std::string only;
  std::uint64_t seed = std::random_device{}();
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--seconds") == 0) seconds = std::atof(argv[i + 1]);
    if (std::strcmp(argv[i], "--only") == 0) only = argv[i + 1];
    if (std::strcmp(argv[i], "--seed") == 0) seed = std::strtoull(argv[i + 1], nullptr, 10);
  }
  const bool known = only.empty() || std::any_of(soak::kCases.begin(), soak::kCases.end(),
                                                 [&](const auto& one) { return only == one.name; });
  if (!(seconds > 0) || !known) return soak::usage();
  const test::TestEnvironment environment;
  const std::string trace = environment.folder() + "/trace.log";
  setenv("GST_TRACERS", "leaks", 0);  // an empty value of the user disables it
  setenv("GST_DEBUG", "GST_TRACER:7", 1);
  setenv("GST_DEBUG_FILE", trace.c_str(), 1);
  testing::InitGoogleTest(&argc, argv);
  gst_init(nullptr, nullptr);
  g_log_set_default_handler(soak::handle_message, nullptr);
  soak::make_files(environment.folder());
  soak::Soak soak(seed);
  soak::run(soak, seconds, only);
  gst_deinit();
  return soak.print(soak::count_leaks(trace)) ? 0 : 1;
}
