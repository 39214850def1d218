// SPDX-License-Identifier: LGPL-2.1-or-later

// The subcommands task and merge of mtstereo-run, with lines of text in place of maps.
// "fake-run plan FOLDER" writes a plan of 17 pairs in 5 tasks, "fake-run jobs FOLDER N" does it,
// and "fake-run replan FOLDER" plans it again with what is prepared.
// "fake-run plan FOLDER PAIRS LENGTH" writes another one, of one recording.

#include <iostream>

#include "fake_pieces.hpp"
#include "lib/outputs/user_error.hpp"
#include "programs/run/cluster_commands.hpp"

namespace mtstereo::run {
namespace {

// The recordings of write_fake_plan(), for planning them. prepare_fake() prepares them.
ArchiveInput fake_archive() {
  const auto prepare = [](const Recording& recording) {
    return prepare_fake(recording.name, recording.name == "a" ? 10 : 7);
  };
  return {{fake_work("a", 1).recording, fake_work("b", 1).recording}, {}, prepare, "fake", false};
}

int plan(const std::filesystem::path& folder, Existing existing) {
  PlanOptions options;
  options.folder = folder;
  options.pairs_per_task = 4;
  return run_plan_command(fake_archive(), options, existing);
}

int run_jobs(const std::filesystem::path& folder, int jobs) {
  if (!std::filesystem::exists(folder / "plan")) plan(folder / "plan", Existing::kRefuse);
  return run_with_jobs(fake_archive(), folder, jobs, Existing::kContinue, fake_functions());
}

}  // namespace
}  // namespace mtstereo::run

int main(int argc, char** argv) {
  using namespace mtstereo::run;
  try {
    if (argc == 3 && std::string(argv[1]) == "plan") return plan(argv[2], Existing::kRefuse);
    if (argc == 3 && std::string(argv[1]) == "replan") return plan(argv[2], Existing::kContinue);
    if (argc == 5 && std::string(argv[1]) == "plan") {
      const int pairs = std::stoi(argv[3]);
      write_plan_of({fake_work("a", pairs)}, {{"a"}, divide("a", pairs, std::stoi(argv[4])), {}},
                    argv[2]);
      return kDone;
    }
    if (argc == 4 && std::string(argv[1]) == "jobs") return run_jobs(argv[2], std::stoi(argv[3]));
    return run_cluster_command(argc, argv, fake_functions()).value_or(kWrongUsage);
  } catch (const mtstereo::UserError& error) {
    std::cerr << "mtstereo-run: " << error.what() << '\n';
    return kFailed;
  }
}
