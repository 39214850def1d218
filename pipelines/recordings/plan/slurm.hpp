// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "recordings/plan/program.hpp"

// Submits the tasks of a plan to Slurm: arrays of tasks, and a merge that starts when they ended.

namespace mtstereo::run {

/// Runs a program of Slurm; the tests replace it.
using RunProgram = std::function<ProgramResult(const std::vector<std::string>&)>;

struct SlurmOptions {
  std::filesystem::path program;     ///< mtstereo-run, under its name on the nodes
  int limit = 0;                     ///< tasks at the same time; 0: no limit
  int merge_jobs = 1;                ///< recordings that the merge joins at the same time
  bool remove_pieces = false;        ///< after they are joined
  std::vector<std::string> options;  ///< of sbatch, for tasks and merge: --partition=long
  RunProgram run = run_program;
};

/// What was submitted.
struct Submission {
  std::vector<std::string> arrays;  ///< numbers of the jobs
  std::string merge;                ///< number of the job; empty: none was needed
  std::size_t tasks = 0;            ///< submitted
  std::size_t active = 0;           ///< tasks that are queued or running already
  std::size_t done = 0;             ///< tasks whose pieces are there
  std::size_t all = 0;
};

/// Submits the tasks that are neither done nor queued nor running, and a merge after them. Throws
/// RunError if there is no plan, or if Slurm refuses.
Submission submit(const std::filesystem::path& folder, const SlurmOptions& options);

/// The jobs of a plan have this name and "-N" with the number of the first task of the array, or
/// "-merge".
std::string job_name(const std::filesystem::path& folder);
/// Numbers in increasing order, as sbatch takes them: "0-3,7".
std::string array_text(const std::vector<std::size_t>& numbers);
/// A word of a shell script.
std::string quoted(const std::string& word);

}  // namespace mtstereo::run
