// SPDX-License-Identifier: LGPL-2.1-or-later

// mtstereo-eval: measures the matcher's errors, density and time on pairs with ground truth.

#include <unistd.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <opencv2/core/utils/logger.hpp>
#include <utility>

#include "lib/outputs/standard_output.hpp"
#include "lib/outputs/user_error.hpp"
#include "tools/eval/options.hpp"
#include "tools/eval/outputs.hpp"
#include "tools/eval/report.hpp"

namespace mtstereo::eval {
namespace {

// One line that is rewritten on a terminal; prints nothing if stderr is redirected.
class Progress {
 public:
  explicit Progress(std::size_t total) : total_(total), on_(isatty(STDERR_FILENO) == 1) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::size_t done, const std::string& name) const {
    if (!on_) return;
    constexpr std::size_t kWidth = 30;
    const std::size_t filled = done * kWidth / std::max<std::size_t>(total_, 1);
    std::cerr << "\r\033[K[" << std::string(filled, '#') << std::string(kWidth - filled, '.')
              << "] " << done + 1 << "/" << total_ << " " << name << std::flush;
  }
  void clear() const {
    if (on_) std::cerr << "\r\033[K" << std::flush;
  }

 private:
  std::size_t total_;
  bool on_;
};

void print_failure(const Problem& failure) {
  std::cerr << "mtstereo-eval: " << failure.pair << ": " << failure.reason << '\n';
}

std::string list_of(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "'" : " or '") + text + "'";
  return list;
}

// The pairs to run, after --only and --limit.
DataSet select_pairs(const Options& options, DataSet set) {
  const auto unwanted = [&](const std::string& name) {
    return !options.only.empty() &&
           std::none_of(options.only.begin(), options.only.end(), [&](const std::string& text) {
             return name.find(text) != std::string::npos;
           });
  };
  std::erase_if(set.pairs, [&](const StereoPair& pair) { return unwanted(pair.name); });
  std::erase_if(set.problems, [&](const Problem& problem) { return unwanted(problem.pair); });
  const auto limit = static_cast<std::size_t>(options.limit);
  if (limit > 0 && set.pairs.size() > limit) set.pairs.resize(limit);
  return set;
}

Report start_report(const Options& options, const DataSet& set) {
  Report report;
  report.dataset = set.name;
  report.folder = set.folder;
  report.kinds = kinds_of(options.run);
  report.flicker = options.run.flicker;
  report.stream = options.run.stream;
  report.warm_up = options.run.warm_up;
  report.repeat = options.run.repeat;
  for (const ParameterInfo& info : parameter_table()) {
    const bool from_data = info.id == Parameter::kMaxDisparity &&
                           !options.run.parameters.is_set(Parameter::kMaxDisparity);
    report.parameters.emplace_back(
        info.name, from_data ? "from the data set" : options.run.parameters.text(info.id));
  }
  report.parameters.emplace_back("alignment", aligns(options.run) ? "correct" : "off");
  report.methods.emplace_back(kOwnMethod);
  for (const OpenCvMethod method : options.run.opencv_methods) {
    report.methods.emplace_back(opencv_name(method));
    report.opencv_settings.emplace_back(opencv_name(method), opencv_settings(method));
  }
  report.failures = set.problems;
  return report;
}

// The curves of all kinds.
class Curves {
 public:
  explicit Curves(const Report& report) {
    for (const std::string& kind : report.kinds) {
      collectors_.emplace_back(kind, CurveCollector(report.methods));
    }
  }

  void add(PairReport& pair) {
    for (auto& [kind, collector] : collectors_) {
      if (kind == pair.kind) collector.add(pair.pair.name, std::exchange(pair.sweeps, {}));
    }
  }

  void finish(const Options& options, Report& report) const {
    for (const auto& [kind, collector] : collectors_) {
      report.curves.push_back(make_curves(report.dataset, report.parameters,
                                          filter_settings(options.run.parameters),
                                          collector.means()));
      report.curves.back().kind = kind;
    }
  }

 private:
  std::vector<std::pair<std::string, CurveCollector>> collectors_;
};

void add_pair(PairReport pair, Report& report) {
  for (const std::string& note : pair.notes) std::cerr << "mtstereo-eval: note: " << note << '\n';
  for (const std::string& reason : pair.failures) {
    report.failures.push_back({pair.pair.name, reason});
    print_failure(report.failures.back());
  }
  report.pairs.push_back(std::move(pair));
}

void run_all(const Options& options, const DataSet& set, Report& report) {
  const int threads = options.run.parameters.integer(Parameter::kThreads);
  cv::setNumThreads(threads > 0 ? threads : -1);  // -1: one per processor
  for (const Problem& problem : set.problems) print_failure(problem);
  for (const std::string& note : set.notes) std::cerr << "mtstereo-eval: note: " << note << '\n';
  Runner runner(options.run);
  Curves curves(report);
  const Progress progress(set.pairs.size());
  for (std::size_t i = 0; i < set.pairs.size(); ++i) {
    progress.show(i, set.pairs[i].name);
    std::vector<PairReport> kinds = runner.run_kinds(set.pairs[i]);
    progress.clear();
    for (PairReport& pair : kinds) {
      if (options.run.curve) curves.add(pair);
      add_pair(std::move(pair), report);
    }
  }
  if (options.run.curve) curves.finish(options, report);
}

int list_pairs(const DataSet& set) {
  for (const StereoPair& pair : set.pairs) {
    std::cout << pair.name << "\n  left   " << pair.left.string() << "\n  right  "
              << pair.right.string() << "\n  truth  " << pair.truth.string() << "\n  range  "
              << (pair.max_disparity ? std::to_string(*pair.max_disparity) + " px" : "unknown")
              << '\n';
  }
  for (const Problem& problem : set.problems) print_failure(problem);
  std::cout << set.pairs.size() << " pairs of " << set.name << '\n';
  return set.problems.empty() ? kAllFine : kSomeFailed;
}

void print(const Report& report) {
  print_table(std::cout, report);
  if (report.kinds.size() > 1) {
    std::cout << '\n';
    print_kinds(std::cout, report);
  }
  if (report.flicker || report.stream) {
    std::cout << '\n';
    print_flicker(std::cout, report);
  }
  for (const CurveReport& curve : report.curves) {
    std::cout << '\n';
    print_curves(std::cout, curve);
  }
  if (!report.curves.empty()) print_curve_settings(std::cout, report.curves.front());
  std::cout << std::flush;
}

void check_degradations(const Options& options) {
  for (const Degradation& degradation : options.run.degradations) {
    if (const std::optional<std::string> obstacle = degradation_obstacle(degradation)) {
      throw UserError("--degrade " + degradation_text(degradation) + ": " + *obstacle);
    }
  }
}

int run(const Options& options) {
  const DataSet all = find_pairs(options.folders, options.layout);
  const DataSet set = select_pairs(options, all);
  if (set.pairs.empty() && set.problems.empty()) {
    throw UserError(all.folder, "no pair has " + list_of(options.only) + " in its name");
  }
  if (options.list) return list_pairs(set);
  check_degradations(options);
  check_outputs(options, all);
  Report report = start_report(options, set);
  run_all(options, set, report);
  print(report);
  if (!report.failures.empty()) {
    std::cerr << "mtstereo-eval: " << report.failures.size()
              << " failures (listed above); the mean is over the other pairs\n";
  }
  const bool written = write_outputs(options, report);
  return written && report.failures.empty() ? kAllFine : kSomeFailed;
}

}  // namespace
}  // namespace mtstereo::eval

int main(int argc, char** argv) {
  using namespace mtstereo::eval;
  try {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    const ParsedOptions parsed = parse_options(argc, argv);
    const int status = parsed.options ? run(*parsed.options) : parsed.exit_status;
    mtstereo::outputs::finish_standard_output();
    return status;
  } catch (const std::exception& error) {
    std::cerr << "mtstereo-eval: " << error.what() << '\n';
    return kWrongUsage;
  } catch (...) {
    std::cerr << "mtstereo-eval: unknown error\n";
    return kWrongUsage;
  }
}
