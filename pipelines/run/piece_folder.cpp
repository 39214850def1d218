// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run/piece_folder.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <utility>

#include "run/json.hpp"
#include "run/matroska.hpp"
#include "run/product_files.hpp"
#include "run/run_error.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

// All names that products can have.
std::vector<std::string> product_paths() {
  std::vector<std::string> paths;
  for (const MapFormat format : {MapFormat::kMatroska, MapFormat::kPng}) {
    WorkOptions options;
    options.format = format;
    for (const Product product : kAllProducts) paths.push_back(product_path(options, product));
  }
  return paths;
}

std::string line_of(const FrameFigures& figures) {
  char text[160];
  std::snprintf(text, sizeof text, "%" PRId64 " %" PRId64 " %" PRId64 " %.17g %.17g %.17g\n",
                figures.pair, figures.frames.left, figures.frames.right, figures.density,
                figures.median_disparity, figures.matching_ms);
  return text;
}

bool parse_line(const std::string& line, FrameFigures& figures) {
  return std::sscanf(line.c_str(), "%" SCNd64 " %" SCNd64 " %" SCNd64 " %lf %lf %lf", &figures.pair,
                     &figures.frames.left, &figures.frames.right, &figures.density,
                     &figures.median_disparity, &figures.matching_ms) == 6;
}

// The number of whole frames in a file.
std::size_t frames_in(const fs::path& file) {
  try {
    MatroskaReader reader(file);
    std::size_t frames = 0;
    while (reader.skip()) ++frames;
    return frames;
  } catch (const RunError&) {
    return 0;
  }
}

}  // namespace

PieceFolder::PieceFolder(const Work& work, Range range, fs::path folder, Unfinished unfinished)
    : work_(work), range_(range), folder_(std::move(folder)) {
  const std::string head = "mtstereo-run journal 1 " + fingerprint(work) + " " +
                           std::to_string(range.first) + " " + std::to_string(range.count) + "\n";
  try {
    if (unfinished == Unfinished::kContinue && read_journal(head)) keep_whole_frames();
    if (done_.empty()) fs::remove_all(this->unfinished());
    fs::create_directories(this->unfinished());
    write_journal(head);
  } catch (const fs::filesystem_error& error) {
    throw RunError(error.path1().string() + ": " + error.code().message());
  }
}

// False if it belongs to another work.
bool PieceFolder::read_journal(const std::string& head) {
  std::ifstream stream(journal());
  std::string line;
  if (!std::getline(stream, line) || line + "\n" != head) return false;
  while (std::getline(stream, line) && !stream.eof()) {
    FrameFigures figures;
    if (!parse_line(line, figures)) break;
    done_.push_back(figures);
  }
  return true;
}

// A pair is done if all of its frames are in the files.
void PieceFolder::keep_whole_frames() {
  for (const Product product : work_.options.products) {
    if (!in_one_file(work_.options, product)) continue;
    const std::size_t frames = frames_in(unfinished() / product_path(work_.options, product));
    if (frames < done_.size()) done_.resize(frames);
  }
}

void PieceFolder::write_journal(const std::string& head) {
  const fs::path aside = unfinished() / "journal.new";
  std::ofstream stream(aside, std::ios::binary);
  stream << head;
  for (const FrameFigures& figures : done_) stream << line_of(figures);
  stream.close();
  if (!stream) throw RunError(aside.string() + ": cannot be written");
  fs::rename(aside, journal());
  stream_.open(journal(), std::ios::binary | std::ios::app);
}

void PieceFolder::note(const FrameFigures& figures) {
  stream_ << line_of(figures) << std::flush;
  if (!stream_) throw RunError(journal().string() + ": cannot be written");
}

void PieceFolder::finish(PieceReport& report) {
  stream_.close();
  try {
    fs::remove(journal());
    report.files = result_files(work_.options, unfinished());
    remove_results(folder_);
    for (const Product product : work_.options.products) {
      const std::string path = product_path(work_.options, product);
      if (fs::exists(unfinished() / path)) fs::rename(unfinished() / path, folder_ / path);
    }
    fs::remove_all(unfinished());
  } catch (const fs::filesystem_error& error) {
    throw RunError(error.path1().string() + ": " + error.code().message());
  }
  write_piece(report, range_, folder_ / kPieceFile);
}

std::vector<std::string> result_files(const WorkOptions& options, const fs::path& folder) {
  std::vector<std::string> files;
  for (const Product product : options.products) {
    const std::string path = product_path(options, product);
    if (in_one_file(options, product)) {
      if (fs::exists(folder / path)) files.push_back(path);
      continue;
    }
    if (!fs::is_directory(folder / path)) continue;
    for (const auto& entry : fs::directory_iterator(folder / path)) {
      files.push_back(path + "/" + entry.path().filename().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void remove_results(const fs::path& folder) {
  fs::remove(folder / kPieceFile);
  fs::remove(folder / kRunFile);
  for (const std::string& path : product_paths()) fs::remove_all(folder / path);
}

}  // namespace mtstereo::run
