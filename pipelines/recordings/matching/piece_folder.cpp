// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/piece_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <iterator>
#include <utility>

#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "lib/outputs/write_file.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/matching/product_files.hpp"
#include "recordings/media/matroska.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

std::string line_of(const FrameFigures& figures) {
  return outputs::format("%" PRId64 " %" PRId64 " %" PRId64 " %.17g %.17g %.17g\n", figures.pair,
                         figures.frames.left, figures.frames.right, figures.density,
                         figures.median_disparity, figures.matching_ms);
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
  } catch (const UserError&) {
    return 0;
  }
}

// What a run was writing when it was killed; nothing else of its kind can be there.
outputs::WrittenFiles cut_files_in(const fs::path& folder) {
  const outputs::WrittenFiles unfinished = unfinished_files_in(folder);
  outputs::WrittenFiles cut;
  for (const auto& [name, bytes] : unfinished.files()) {
    if (fs::path(name).extension() == ".part") cut.add(name, bytes);
  }
  return cut;
}

}  // namespace

PieceFolder::PieceFolder(const Work& work, Range range, fs::path folder, Existing existing)
    : work_(work), range_(range), folder_(std::move(folder)) {
  const std::string head = "mtstereo-run journal 1 " + fingerprint(work) + " " +
                           std::to_string(range.first) + " " + std::to_string(range.count) + "\n";
  check_results_folder(folder_, work.recording, work.options, existing, head);
  try {
    if (existing == Existing::kContinue && read_journal(head) && !read_whole()) keep_whole_frames();
    outputs::remove_written(folder_, cut_files_in(folder_));
    if (done_.empty() && !whole_) outputs::remove_written(folder_, unfinished_files_in(folder_));
    fs::create_directories(this->unfinished());
    write_journal(head);
    any_done_ = whole_ || !done_.empty();
  } catch (const fs::filesystem_error& error) {
    throw UserError(error.path1().string() + ": " + error.code().message());
  }
}

PieceFolder::~PieceFolder() {
  if (any_done_) return;
  // The folders of images have none if the first one failed.
  for (const Product product : work_.options.products) {
    rmdir((unfinished() / product_path(work_.options, product)).c_str());
  }
  outputs::remove_written(folder_, unfinished_files_in(folder_));
}

// Whether all pairs were done, and only their files have to be published.
bool PieceFolder::read_whole() {
  std::error_code error;
  const fs::path report = unfinished() / kPieceFile;
  if (!fs::exists(report, error)) return false;
  Range range;
  whole_ = read_piece(report, range);
  return true;
}

// False if it belongs to another work.
bool PieceFolder::read_journal(const std::string& head) {
  std::ifstream stream(journal());
  std::string line;
  if (!std::getline(stream, line) || line + "\n" != head) return false;
  while (std::getline(stream, line) && !stream.eof()) {
    FrameFigures figures;
    DamageNote note;
    if (!done_.empty() && parse_line(line, note)) {
      note.pair = done_.back().pair;
      damaged_.push_back(std::move(note));
    } else if (parse_line(line, figures)) {
      done_.push_back(figures);
    } else {
      break;
    }
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
  std::erase_if(damaged_, [this](const DamageNote& note) {
    return done_.empty() || note.pair > done_.back().pair;
  });
}

void PieceFolder::write_journal(const std::string& head) {
  const fs::path aside = unfinished() / "journal.new";
  std::ofstream stream(aside, std::ios::binary);
  stream << head;
  auto note = damaged_.begin();
  for (const FrameFigures& figures : done_) {
    stream << line_of(figures);
    for (; note != damaged_.end() && note->pair == figures.pair; ++note) stream << line_of(*note);
  }
  stream.close();
  if (!stream) throw write_error(aside);
  fs::rename(aside, journal());
  stream_.open(journal(), std::ios::binary | std::ios::app);
}

void PieceFolder::note(const FrameFigures& figures, const std::vector<DamageNote>& damaged) {
  stream_ << line_of(figures);
  for (const DamageNote& note : damaged) stream_ << line_of(note);
  stream_ << std::flush;
  if (!stream_) throw write_error(journal());
  any_done_ = true;
}

// The files of the report, and their sizes.
void PieceFolder::complete(PieceReport& report) const {
  report.files = result_files(work_.options, unfinished());
  report.file_bytes.clear();
  for (const std::string& file : report.files) {
    report.file_bytes.push_back(fs::file_size(unfinished() / file));
  }
  write_piece(report, range_, unfinished() / kPieceFile);
}

void PieceFolder::publish(const PieceReport& report) {
  std::vector<std::string> published;
  std::copy_if(report.files.begin(), report.files.end(), std::back_inserter(published),
               [this](const std::string& file) { return !fs::exists(unfinished() / file); });
  remove_results(folder_, published);
  for (const Product product : work_.options.products) {
    const std::string path = product_path(work_.options, product);
    if (fs::exists(unfinished() / path)) outputs::move_file(unfinished() / path, folder_ / path);
  }
  outputs::move_file(unfinished() / kPieceFile, folder_ / kPieceFile);
  outputs::remove_written(folder_, unfinished_files_in(folder_));
}

void PieceFolder::finish(PieceReport& report) {
  stream_.close();
  try {
    if (!whole_) complete(report);
    publish(report);
  } catch (const fs::filesystem_error& error) {
    throw UserError(error.path1().string() + ": " + error.code().message());
  }
}

}  // namespace mtstereo::run
