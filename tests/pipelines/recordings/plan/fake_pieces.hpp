// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

#include "recordings/plan/piece_functions.hpp"
#include "recordings/plan/plan.hpp"
#include "support/temporary_folder.hpp"

// What tests of plans use in place of recordings and of a matcher.

namespace mtstereo::run {

using test::read_text;
using test::TemporaryFolder;
using test::write_text;

/// Name of the file that fake_process() writes.
constexpr const char* kFakeFile = "disparity.txt";

/// A work with this number of pairs; the n-th pair has the frames n and n + 7.
Work fake_work(const std::string& name, std::int64_t pairs);

/// The same as prepare() does it: waits MTSTEREO_FAKE_MS milliseconds, and adds a line to the file
/// MTSTEREO_FAKE_LOG, if these variables are set.
Work prepare_fake(const std::string& name, std::int64_t pairs);

/// Writes a line for each pair. Waits MTSTEREO_FAKE_MS milliseconds before each of them, and adds a
/// line with the range to the file MTSTEREO_FAKE_LOG at the end, if these variables are set.
PieceReport fake_process(const Work& work, Range range, const std::filesystem::path& folder,
                         const Progress& progress);

/// Joins what fake_process() wrote.
PieceReport fake_join(const Work& work, const std::vector<Range>& ranges,
                      const std::vector<std::filesystem::path>& pieces,
                      const std::filesystem::path& folder);

/// Both.
PieceFunctions fake_functions();

/// Writes a plan and its works.
void write_plan_of(const std::vector<Work>& works, const Plan& plan,
                   const std::filesystem::path& folder);

/// A plan of recordings "a" (10 pairs) and "b" (7 pairs) in tasks of at most 4 pairs: 3 and 2
/// tasks.
void write_fake_plan(const std::filesystem::path& folder);

/// What one uncut run writes for a recording.
std::string uncut(const std::string& name, std::int64_t pairs);

}  // namespace mtstereo::run
