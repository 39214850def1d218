// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "recordings/matching/piece.hpp"

// Parts of the JSON files.

namespace mtstereo::run {

using Json = nlohmann::ordered_json;

/// The version of the files that processes exchange.
inline constexpr int kJsonVersion = 2;

/// Writes a file aside and renames it. Throws UserError.
void write_whole(const std::filesystem::path& file,
                 const std::function<void(std::ostream& out)>& write);

/// Reads a file of this program. Throws UserError.
Json read_json(const std::filesystem::path& file, const char* kind);

/// Runs a reader of `file`; what is missing or has a wrong type is a UserError.
void read_fields(const std::filesystem::path& file, const std::function<void()>& read);

/// The content of a work, and of parts of it.
Json work_json(const Work& work);
Json recording_json(const Recording& recording);
Json options_json(const WorkOptions& options);
/// The rectified pair and the calibration that it comes from; null without one.
Json geometry_json(const std::optional<ViewGeometry>& geometry);
/// How the clocks differ, and how sure it is; null if the frames' times count as they are.
Json clocks_json(const std::optional<ClockEstimate>& clocks);
/// Writes the figures of pairs as the last member of an object: one line per pair, without a copy
/// of them in memory.
void write_frames(std::ostream& out, const Json& object, const std::vector<FrameFigures>& frames);
/// Reads them.
std::vector<FrameFigures> read_frames(const Json& object);

/// The words of the JSON for enumerators.
const char* arrangement_name(Arrangement arrangement);
const char* format_name(MapFormat format);

}  // namespace mtstereo::run
