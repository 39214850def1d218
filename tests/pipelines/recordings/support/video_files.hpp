// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recordings/inputs/recording.hpp"
#include "support/temporary_folder.hpp"

// Files for the tests: made and read back by programs that are not part of this project.

namespace mtstereo::run::testing {

/// A temporary folder whose paths have their folders.
class TemporaryFolder : public test::TemporaryFolder {
 public:
  std::filesystem::path operator/(const std::string& name) const;
};

/// Writes a text file.
void write_text(const std::filesystem::path& file, const std::string& text);
/// The first bytes of a file as another file.
void write_beginning(const std::filesystem::path& from, const std::filesystem::path& to,
                     double fraction);

/// Runs a pipeline to its end in this process: gst-launch-1.0 cannot load a plugin that was built
/// with a sanitizer. Throws at an error.
void run_pipeline(const std::string& line);

/// Whether ffmpeg and ffprobe are installed.
bool have_ffmpeg();
/// Runs a command in a shell; a failure fails the test.
void run_command(const std::string& command);

/// Times of frames at 30 frames/s.
std::vector<Nanoseconds> constant_times(int count);
/// Times of frames with periods between 17 ms and 100 ms.
std::vector<Nanoseconds> variable_times(int count);

/// Encodes moving frames of 64x48 px by GStreamer. `coding`: what follows the source, such as
/// "x264enc bframes=2 ! h264parse ! mp4mux".
void write_video(const std::filesystem::path& file, const std::string& coding,
                 const std::vector<Nanoseconds>& times);

/// H.264 with two B-frames between others and a keyframe each second.
extern const char* const kBFrames;

/// The stream times of all frames as GStreamer's decodebin shows them.
std::vector<Nanoseconds> decoded_times(const std::filesystem::path& file);
/// The times of all frames as ffprobe decodes them [s].
std::vector<double> ffprobe_times(const std::filesystem::path& file);

}  // namespace mtstereo::run::testing
