// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace mtstereo::bench {

/// Google Benchmark's own settings of a run, which the user's options override.
struct RunDefaults {
  int repetitions;
  double min_time;  ///< of each repetition [s]
};

/// The command line: --quick, and Google Benchmark's options, which are set.
class Options {
 public:
  /// `print_help` is what --help runs.
  Options(int argc, char** argv, RunDefaults full, void (*print_help)());

  bool quick() const { return quick_; }
  /// False where there was an option that is not known; the standard error names it.
  bool good() const { return good_; }

 private:
  bool quick_ = false;
  bool good_ = true;
};

/// Tells, in the head of a result, the versions that were timed and the processor's name.
void add_context();

/// The processor's name as in this text of /proc/cpuinfo, "unknown" where it has none.
std::string processor_name(const std::string& cpuinfo);

}  // namespace mtstereo::bench
