// SPDX-License-Identifier: LGPL-2.1-or-later
#include "memory.hpp"

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "frame_timing.hpp"
#include "guarded.hpp"
#include "outcome.hpp"

namespace mtstereo::bench {
namespace {

struct Size {
  int width, height, disparities;
};

/// The measured settings besides the defaults of each size, as the text after the size.
struct Case {
  const char* settings;
  const char* preset;  ///< preset of the settings
  bool at_all_sizes;   ///< false: only at the last size
};
constexpr Case kCases[] = {
    {"", "default", true},
    {"/cost=gradient/cost-volume=full", "default", true},
    {"/preset=paper", "paper", true},
    {"/preset=paper/cost-volume=full", "paper", true},
    {"/preset=fast", "fast", true},
    {"/mode=sparse", "default", false},
    {"/mode=dense", "default", false},
    {"/threads=2", "default", false},
};

struct MemoryUse {
  double peak = 0;         ///< [KiB]
  double first_frame = 0;  ///< [s]
};

/// A value of /proc/self/status [KiB], 0 if it is missing.
double status_figure(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line)) {
    if (line.rfind(name + ":", 0) == 0) return std::stod(line.substr(name.size() + 1));
  }
  return 0;
}

/// Resets the peak (VmHWM) to the current resident set. False if the system does not allow it.
bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good() && status_figure("VmHWM") > 0;
}

/// Runs a command and returns its output. Throws std::runtime_error if it fails.
std::string output_of(const std::string& program, const std::string& argument) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  char* const arguments[] = {const_cast<char*>(program.c_str()),
                             const_cast<char*>(argument.c_str()), nullptr};
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  const std::unique_ptr<FILE, int (*)(FILE*)> out(fdopen(ends[0], "r"), fclose);
  if (error != 0) throw std::system_error(error, std::generic_category(), program);
  std::string text;
  for (int c = 0; out != nullptr && (c = std::fgetc(out.get())) != EOF;) {
    text += static_cast<char>(c);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error("the process that measures memory failed: " + program + " " +
                             argument);
  }
  return text;
}

MemoryUse use_of(const std::string& what) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  std::istringstream figures(output_of(program, kMemoryOption + what));
  MemoryUse use;
  if (figures >> use.peak >> use.first_frame) return use;
  throw std::runtime_error("the process that measures memory printed no figures");
}

/// Sets the parameters of a text such as "/mode=dense/threads=2".
Parameters parameters_with(Parameters parameters, std::string_view settings) {
  while (!settings.empty()) {
    const std::string_view setting = settings.substr(1, settings.find('/', 1) - 1);
    settings.remove_prefix(1 + setting.size());
    const std::string_view name = setting.substr(0, setting.find('='));
    const std::string_view value = setting.substr(std::min(name.size() + 1, setting.size()));
    const Status set = parameters.set(name, value);
    if (!set) throw std::runtime_error(set.error().message);
  }
  return parameters;
}

void measure(benchmark::State& state, const std::string& what) {
  MemoryUse use;
  for ([[maybe_unused]] auto _ : state) {
    use = use_of(what);
    state.SetIterationTime(use.first_frame);
  }
  constexpr double kKibPerMib = 1024;
  state.counters["peak_MiB"] = use.peak / kKibPerMib;
}

void add(const std::string& what, int repetitions) {
  benchmark::RegisterBenchmark(
      ("memory/first-frame-" + what).c_str(),
      [what](benchmark::State& state) { guarded(state, [&] { measure(state, what); }); })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime()
      ->Iterations(1)
      ->Repetitions(repetitions);
}

}  // namespace

void measure_memory(const char* what) {
  Size of{};
  int length = 0;
  if (std::sscanf(what, "%dx%dx%d%n", &of.width, &of.height, &of.disparities, &length) != 3 ||
      (what[length] != '\0' && what[length] != '/')) {
    throw std::runtime_error(std::string(kMemoryOption) + what +
                             ": expected WIDTHxHEIGHTxDISPARITIES[/PARAMETER=VALUE]..., such as "
                             "640x480x64/mode=dense");
  }
  const Parameters parameters =
      parameters_with(parameters_of("default", "semi-dense", of.disparities, 1), what + length);
  const Pair pair = render_street(of.width, of.height);
  const OpenCvThreads opencv_threads(parameters.integer(Parameter::kThreads));
  malloc_trim(0);
  if (!reset_peak()) throw std::runtime_error("/proc/self/clear_refs cannot be written");
  const double before = status_figure("VmRSS");
  const auto start = std::chrono::steady_clock::now();
  Matcher matcher = make_matcher(parameters);
  match(matcher, pair);
  const std::chrono::duration<double> first_frame = std::chrono::steady_clock::now() - start;
  const FrameResult result = match(matcher, pair);
  const double peak = status_figure("VmHWM") - before;
  require_density(outcome_of(result).disparity);
  std::printf("%.0f %.9f\n", peak, first_frame.count());
}

void register_memory(bool quick) {
  if (!reset_peak()) {
    std::cerr << "memory is not measured: /proc/self/clear_refs cannot be written\n";
    return;
  }
  std::vector<std::string> sizes = {"640x480x64"};
  if (!quick) sizes.emplace_back("1920x1080x128");
  for (const std::string& size : sizes) {
    for (const Case& one : kCases) {
      if (!has_preset(one.preset) || (!one.at_all_sizes && size != sizes.back())) continue;
      add(size + one.settings, quick ? 1 : 3);
    }
  }
}

}  // namespace mtstereo::bench
