// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "recordings/matching/piece.hpp"

// Recordings of two cameras for the tests, and the results that the elements give for them.

namespace mtstereo::run::testing {

inline constexpr int kStereoWidth = 160, kStereoHeight = 96;

enum class View { kLeft, kRight, kBoth };

/// A frame of a textured scene that moves: no two frames are equal. `row_offset`: the right view is
/// so much lower. A frame with both views has the right one at the right side.
const std::vector<std::uint8_t>& stereo_frame(int number, View view, int row_offset = 0);

/// Encodes such frames by GStreamer. `coding`: what follows the source.
void write_view(const std::filesystem::path& file, View view, const std::string& coding,
                const std::vector<Nanoseconds>& times, int row_offset = 0);

/// Writes a calibration of rectified views of this size: f = 100 px, B = 0.1 m.
std::filesystem::path write_stereo_calibration(const std::filesystem::path& folder);

/// A work of two videos whose frames belong together by their numbers, without a correction.
Work work_of(const std::filesystem::path& left, const std::filesystem::path& right,
             const WorkOptions& options);
/// All pairs of a work.
Range whole(const Work& work);

/// The rows of the first plane of a frame, without padding.
std::string rows_of(GstBuffer* buffer, const GstCaps* caps);
/// The frames that reach the sink named "out" of a gst-launch line: the rows without padding.
std::vector<std::string> frames_of(const std::string& line);
/// The line of two videos into the element mtstereo.
std::string matcher_line(const std::filesystem::path& left, const std::filesystem::path& right,
                         const std::string& properties);

/// The files in a folder and their contents, without the reports.
std::map<std::string, std::string> contents_of(const std::filesystem::path& folder);
std::string bytes_of(const std::filesystem::path& file);

}  // namespace mtstereo::run::testing
