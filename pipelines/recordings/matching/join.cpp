// SPDX-License-Identifier: LGPL-2.1-or-later

// join(): one result of the pieces of a recording.

#include <algorithm>
#include <memory>
#include <string>

#include "lib/outputs/user_error.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/matching/piece.hpp"
#include "recordings/matching/piece_folder.hpp"
#include "recordings/matching/product_files.hpp"
#include "recordings/media/damage_notes.hpp"
#include "recordings/media/matroska.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

struct Piece {
  Range range;
  fs::path folder;
  PieceReport report;
};

// The pieces in the order of their pairs. Throws if they do not cover the recording.
std::vector<Piece> read_pieces(const Work& work, const std::vector<Range>& ranges,
                               const std::vector<fs::path>& folders) {
  if (ranges.size() != folders.size()) throw UserError("as many folders as pieces are needed");
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    Piece piece{ranges[i], folders[i], {}};
    Range found;
    piece.report = read_piece(folders[i] / kPieceFile, found);
    if (found.first != ranges[i].first || found.count != ranges[i].count) {
      throw UserError(folders[i].string() + ": has other pairs than its place in the plan");
    }
    pieces.push_back(std::move(piece));
  }
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& a, const Piece& b) { return a.range.first < b.range.first; });
  std::int64_t next = 0;
  for (const Piece& piece : pieces) {
    if (piece.range.first != next) {
      throw UserError(work.recording.name + ": no piece begins with pair " + std::to_string(next));
    }
    next += piece.range.count;
  }
  if (next != static_cast<std::int64_t>(work.pairs.pairs.size())) {
    throw UserError(work.recording.name + ": the pieces end before pair " + std::to_string(next));
  }
  return pieces;
}

// The files of the piece must be those of its report.
void check_files(const WorkOptions& options, const Piece& piece) {
  if (result_files(options, piece.folder) == piece.report.files) return;
  throw UserError(piece.folder.string() + ": has other files than its report states");
}

void join_video(const std::vector<Piece>& pieces, const std::string& name, const fs::path& folder) {
  std::unique_ptr<MatroskaWriter> writer;
  MatroskaTrack track;
  for (const Piece& piece : pieces) {
    if (piece.report.frames.empty()) continue;
    MatroskaReader reader(piece.folder / name);
    if (!writer) {
      track = reader.track();
      writer = std::make_unique<MatroskaWriter>(folder / name, track);
    } else if (!(reader.track() == track)) {
      throw UserError((piece.folder / name).string() +
                      ": has another size or was written by another version of the encoder");
    }
    std::size_t frames = 0;
    for (; const std::optional<MatroskaReader::Cluster> cluster = reader.next(); ++frames) {
      writer->append_cluster(cluster->time, cluster->bytes);
    }
    if (frames != piece.report.frames.size()) {
      throw UserError((piece.folder / name).string() + ": has " + std::to_string(frames) +
                      " frames; its report states " + std::to_string(piece.report.frames.size()));
    }
  }
  if (writer) writer->finish();
}

// Links the files of a product, or copies them where that is not possible.
void join_files(const std::vector<Piece>& pieces, const std::string& name, const fs::path& folder) {
  fs::create_directories(folder / name);
  for (const Piece& piece : pieces) {
    for (const std::string& file : piece.report.files) {
      if (!file.starts_with(name + "/")) continue;
      std::error_code error;
      fs::create_hard_link(piece.folder / file, folder / file, error);
      if (error) fs::copy_file(piece.folder / file, folder / file);
    }
  }
}

PieceReport joined_report(const std::vector<Piece>& pieces) {
  PieceReport report;
  for (const Piece& piece : pieces) {
    const PieceReport& part = piece.report;
    report.frames.insert(report.frames.end(), part.frames.begin(), part.frames.end());
    // Where the recording ends is stated once, by the first piece that has no more frames.
    if (!part.frames.empty() || report.damage.empty()) add_damage(report.damage, part.damage);
  }
  return report;
}

}  // namespace

PieceReport join(const Work& work, const std::vector<Range>& ranges,
                 const std::vector<fs::path>& folders, const fs::path& folder) {
  const std::vector<Piece> pieces = read_pieces(work, ranges, folders);
  try {
    PieceFolder whole(work, {0, static_cast<std::int64_t>(work.pairs.pairs.size())}, folder,
                      Existing::kReplace);
    for (const Piece& piece : pieces) check_files(work.options, piece);
    for (const Product product : work.options.products) {
      const std::string name = product_path(work.options, product);
      if (in_one_file(work.options, product)) {
        join_video(pieces, name, whole.unfinished());
      } else {
        join_files(pieces, name, whole.unfinished());
      }
    }
    PieceReport report = joined_report(pieces);
    whole.finish(report);
    return report;
  } catch (const fs::filesystem_error& error) {
    throw UserError(error.path1().string() + ": " + error.code().message());
  }
}

}  // namespace mtstereo::run
