// SPDX-License-Identifier: LGPL-2.1-or-later
#include "options.hpp"

#include <benchmark/benchmark.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <opencv2/core/version.hpp>
#include <sstream>
#include <vector>

#include "mtstereo/matcher.hpp"

namespace mtstereo::bench {
namespace {

constexpr const char* kQuickOption = "--quick";
constexpr RunDefaults kQuick = {2, 0.001};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace

Options::Options(int argc, char** argv, RunDefaults full, void (*print_help)()) {
  std::vector<char*> own;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], kQuickOption) == 0) {
      quick_ = true;
    } else {
      own.push_back(argv[i]);
    }
  }
  const RunDefaults& defaults = quick_ ? kQuick : full;
  // Before the user's own options, so that those take precedence.
  std::string set[] = {"--benchmark_repetitions=" + std::to_string(defaults.repetitions),
                       "--benchmark_min_time=" + number(defaults.min_time),
                       "--benchmark_display_aggregates_only=true"};
  std::vector<char*> arguments = {argv[0]};  // not copied; it is part of the result
  for (std::string& argument : set) arguments.push_back(argument.data());
  arguments.insert(arguments.end(), own.begin(), own.end());
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data(), print_help);
  good_ = !benchmark::ReportUnrecognizedArguments(count, arguments.data());
}

void add_context() {
  std::ifstream file("/proc/cpuinfo");
  const std::string cpuinfo{std::istreambuf_iterator<char>(file), {}};
  benchmark::AddCustomContext("processor", processor_name(cpuinfo));
  benchmark::AddCustomContext("mtstereo", version());
  benchmark::AddCustomContext("opencv", CV_VERSION);
}

std::string processor_name(const std::string& cpuinfo) {
  // x86 has "model name"; ARM systems have "Model" or "Hardware", if any.
  for (const char* key : {"model name", "Model", "Hardware"}) {
    std::istringstream lines(cpuinfo);
    std::string line;
    while (std::getline(lines, line)) {
      const std::size_t colon = line.find(':');
      if (colon == std::string::npos || trimmed(line.substr(0, colon)) != key) continue;
      std::string name = trimmed(line.substr(colon + 1));
      if (!name.empty()) return name;
    }
  }
  return "unknown";
}

}  // namespace mtstereo::bench
