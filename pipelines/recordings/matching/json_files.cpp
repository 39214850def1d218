// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/json_files.hpp"

#include <unistd.h>

#include <cerrno>

#include "lib/outputs/json_text.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/matching/work_facts.hpp"

namespace mtstereo::run {

void write_whole(const std::filesystem::path& file,
                 const std::function<void(std::ostream& out)>& write) {
  // Several processes may write the same file at a time.
  std::filesystem::path aside = file;
  aside += "." + std::to_string(getpid()) + ".new";
  errno = 0;
  std::ofstream out(aside, std::ios::binary);
  write(out);
  out.close();
  std::error_code error;
  if (out) {
    std::filesystem::rename(aside, file, error);
    if (!error) return;
  } else {
    error.assign(errno, std::generic_category());
  }
  const std::string reason = error.message();
  std::filesystem::remove(aside, error);
  throw UserError(file.string() + ": cannot be written: " + reason);
}

Json read_json(const std::filesystem::path& file, const char* kind) {
  std::error_code error;
  std::ifstream in;
  if (std::filesystem::is_regular_file(file, error)) in.open(file, std::ios::binary);
  if (!in.is_open()) throw UserError(file.string() + ": cannot be read");
  const Json json = Json::parse(in, nullptr, false);
  if (!json.is_object() || json.value("kind", "") != kind) {
    throw UserError(file.string() + ": is damaged, or is not a " + kind);
  }
  const int version = json.value("version", 0);
  if (version != kJsonVersion) {
    throw UserError(file.string() + ": has version " + std::to_string(version) +
                    "; this program reads version " + std::to_string(kJsonVersion));
  }
  return json;
}

void read_fields(const std::filesystem::path& file, const std::function<void()>& read) {
  try {
    read();
  } catch (const nlohmann::json::exception& error) {
    throw UserError(file.string() + ": is damaged: " + error.what());
  }
}

void write_frames(std::ostream& out, const Json& object, const std::vector<FrameFigures>& frames) {
  std::string text = outputs::text_of(object, 2);
  text.resize(text.rfind('}'));
  while (text.back() == '\n' || text.back() == ' ') text.pop_back();
  out << text
      << ",\n  \"columns\": [\"pair\", \"left_frame\", \"right_frame\", \"density\", "
         "\"median_disparity_px\", \"matching_ms\"],\n  \"frames\": [";
  const char* separator = "\n    [";
  for (const FrameFigures& frame : frames) {
    out << separator << frame.pair << ", " << frame.frames.left << ", " << frame.frames.right
        << ", " << number_text(frame.density) << ", " << number_text(frame.median_disparity) << ", "
        << number_text(frame.matching_ms) << ']';
    separator = ",\n    [";
  }
  out << "\n  ]\n}\n";
}

std::vector<FrameFigures> read_frames(const Json& object) {
  std::vector<FrameFigures> frames;
  const Json& rows = object.at("frames");
  frames.reserve(rows.size());
  for (const Json& row : rows) {
    FrameFigures frame;
    frame.pair = row.at(0).get<std::int64_t>();
    frame.frames.left = row.at(1).get<std::int64_t>();
    frame.frames.right = row.at(2).get<std::int64_t>();
    frame.density = row.at(3).get<double>();
    frame.median_disparity = row.at(4).get<double>();
    frame.matching_ms = row.at(5).get<double>();
    frames.push_back(frame);
  }
  return frames;
}

}  // namespace mtstereo::run
