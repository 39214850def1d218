// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace mtstereo::bench {

/// Defaults of Google Benchmark's options, which the user's options override.
struct RunDefaults {
  int repetitions;
  double min_time;  ///< minimum time of each repetition [s]
};

/// The command line: --quick and Google Benchmark's options, which are passed on.
class Options {
 public:
  /// --help calls `print_help`.
  Options(int argc, char** argv, RunDefaults full, void (*print_help)());

  bool quick() const { return quick_; }
  /// False if there was an unknown option; the standard error names it.
  bool good() const { return good_; }

 private:
  bool quick_ = false;
  bool good_ = true;
};

/// Adds the timed versions and the processor's name to the context of a result.
void add_context();

/// The processor's name in this text of /proc/cpuinfo, "unknown" if it has none.
std::string processor_name(const std::string& cpuinfo);

}  // namespace mtstereo::bench
