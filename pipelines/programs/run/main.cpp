// SPDX-License-Identifier: LGPL-2.1-or-later

// mtstereo-run: disparities, depths, clouds and figures of recordings.

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <opencv2/core/utils/logger.hpp>
#include <string>
#include <vector>

#include "lib/outputs/folder_lock.hpp"
#include "lib/outputs/printable.hpp"
#include "lib/outputs/standard_output.hpp"
#include "lib/outputs/user_error.hpp"
#include "programs/run/check_command.hpp"
#include "programs/run/cluster_commands.hpp"
#include "programs/run/interruption.hpp"
#include "programs/run/options.hpp"
#include "programs/run/own_plugin.hpp"
#include "programs/run/run_recording.hpp"
#include "recordings/inputs/recognition.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInterrupted = "mtstereo-run: interrupted; --resume continues\n";

void print_problem(const Problem& problem) {
  std::cerr << "mtstereo-run: " << outputs::printable(text_of(problem)) << '\n';
}

[[noreturn]] void fail_with(const std::vector<Problem>& problems) {
  for (std::size_t i = 0; i + 1 < problems.size(); ++i) print_problem(problems[i]);
  throw UserError(outputs::printable(text_of(problems.back())));
}

// One recording, or those in a folder.
std::vector<Recording> find(const Options& options, std::vector<Problem>& problems) {
  std::error_code error;
  if (options.inputs.size() == 1 && fs::is_directory(options.inputs.front(), error)) {
    std::vector<Recording> found = find_recordings(options.inputs.front(), options.input, problems);
    if (!found.empty()) return found;
    if (!problems.empty()) fail_with(problems);
  }
  return {recognize(options.inputs, options.input)};
}

void print_list(const std::vector<Recording>& recordings) {
  for (const Recording& recording : recordings) {
    std::cout << recording.name << ": " << recording.kind << '\n';
    for (const std::string& remark : recording.remarks) {
      std::cout << "  " << outputs::printable(remark) << '\n';
    }
  }
}

int run_all(const std::vector<Recording>& recordings, const std::vector<Problem>& problems,
            const Options& options) {
  for (const Problem& problem : problems) print_problem(problem);
  const outputs::FolderLock lock(options.folder);
  std::size_t failed = 0;
  int status = problems.empty() ? kDone : kIncomplete;
  for (const Recording& recording : recordings) {
    if (stop_requested()) break;
    try {
      const bool one = recordings.size() == 1 && problems.empty();
      const fs::path folder = one ? options.folder : options.folder / recording.name;
      status = std::max(status, run_recording(recording, options, folder));
    } catch (const std::exception& error) {
      std::cerr << "mtstereo-run: " << error.what() << '\n';
      status = std::max<int>(status, kIncomplete);
      ++failed;
    }
  }
  if (stop_requested()) {
    std::cerr << kInterrupted;
    return kIncomplete;
  }
  if (failed == recordings.size()) return kFailed;
  return status;
}

int run(const Options& options) {
  std::vector<Problem> problems;
  const std::vector<Recording> recordings = find(options, problems);
  if (options.list) {
    print_list(recordings);
    for (const Problem& problem : problems) print_problem(problem);
    return problems.empty() ? kDone : kIncomplete;
  }
  if (options.check) {
    for (const Problem& problem : problems) print_problem(problem);
    return run_check_command(recordings, problems, options);
  }
  if (!options.plan && options.jobs == 1) return run_all(recordings, problems, options);
  const auto prepare = [&options](const Recording& recording) {
    return prepare_recording(recording, options);
  };
  const ArchiveInput input{recordings,    problems,    prepare, preparation_settings(options),
                           options.quiet, options.work};
  const Existing existing = options.existing();
  if (options.plan) return run_plan_command(input, options.plan_options, existing);
  return run_with_jobs(input, options.folder, options.jobs, existing);
}

int run(int argc, const char* const* argv) {
  end_at_signals(kInterrupted, kIncomplete);
  if (const std::optional<int> status = run_cluster_command(argc, argv)) return *status;
  const ParsedOptions parsed = parse_options(argc, argv);
  return parsed.options ? run(*parsed.options) : parsed.exit_status;
}

}  // namespace
}  // namespace mtstereo::run

int main(int argc, char** argv) {
  try {
    mtstereo::run::use_own_plugin();
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    const int status = mtstereo::run::run(argc, argv);
    mtstereo::outputs::finish_standard_output();
    return status;
  } catch (const std::exception& error) {
    std::cerr << "mtstereo-run: " << error.what() << '\n';
  } catch (...) {
    std::cerr << "mtstereo-run: unknown error\n";
  }
  return mtstereo::run::kFailed;
}
