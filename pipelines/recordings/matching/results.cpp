// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/results.hpp"

#include <algorithm>
#include <fstream>
#include <regex>
#include <system_error>

#include "lib/outputs/user_error.hpp"
#include "recordings/inputs/recording_files.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/matching/product_files.hpp"
#include "recordings/media/container.hpp"
#include "recordings/media/matroska_format.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnfinished = "unfinished";
constexpr const char* kJournal = "journal";
constexpr const char* kAdvice = ": move it, or choose another folder by --out";

fs::file_type type_of(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type();
}

// A product in one file, or the file of a pair, maybe one that is being written.
bool is_result_name(const fs::path& name) {
  static const std::regex kPair(R"(\d{6,}\.(png|pfm|ply)(\.\d+-\d+\.part)?)");
  static const std::vector<std::string> kPaths = product_paths();
  const auto known = [](const std::string& path) {
    return std::find(kPaths.begin(), kPaths.end(), path) != kPaths.end();
  };
  const std::string parent = name.parent_path().string();
  if (parent.empty()) return known(name.string()) && name.has_extension();
  return known(parent) && fs::path(parent).extension().empty() &&
         std::regex_match(name.filename().string(), kPair);
}

bool is_unfinished_name(const fs::path& name) {
  static const std::regex kOther(R"(journal(\.new)?|piece\.json(\.\d+\.new)?)");
  return is_result_name(name) || std::regex_match(name.string(), kOther);
}

// The first line of the journal; empty if there is none of this program.
std::string head_of_journal(const fs::path& folder) {
  if (type_of(journal_in(folder)) != fs::file_type::regular) return {};
  std::ifstream stream(journal_in(folder));
  static const std::regex kHead(R"(mtstereo-run journal \d+ [0-9a-f]+ \d+ \d+)");
  std::string line;
  if (!std::getline(stream, line) || !std::regex_match(line, kHead)) return {};
  return line + "\n";
}

// A folder that is empty, or in which a journal was about to be written.
bool is_new(const fs::path& unfinished) {
  std::error_code error;
  for (fs::directory_iterator entry(unfinished, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().filename() != "journal.new") return false;
  }
  return !error;
}

// Whether a file is the beginning of a Matroska file of this program.
bool begins_as_ours(const fs::path& file) {
  constexpr std::size_t kHead = 512;  // bytes, in which the program is named
  constexpr std::size_t kFixed = 40;  // bytes of the first element
  const std::string known = ebml::head_of({}).bytes.substr(0, kFixed);
  std::ifstream in(file, std::ios::binary);
  std::string head(kHead, '\0');
  in.read(head.data(), kHead);
  head.resize(static_cast<std::size_t>(in.gcount()));
  if (head.size() < kHead) return head.substr(0, kFixed) == known.substr(0, head.size());
  return head.starts_with(known) && head.find("mtstereo-run") != std::string::npos;
}

// Files that a crash or a full disk has cut off are those of this program still.
std::optional<std::uintmax_t> size_of_cut_video(const fs::path& file, std::uintmax_t bytes) {
  std::error_code error;
  if (type_of(file) != fs::file_type::regular) return std::nullopt;
  const std::uintmax_t found = fs::file_size(file, error);
  if (error || found >= bytes) return std::nullopt;
  return begins_as_ours(file) ? std::optional(found) : std::nullopt;
}

void add_listed(const fs::path& folder, const fs::path& report, outputs::WrittenFiles& written) {
  const std::optional<outputs::WrittenFiles> listed = files_listed_in(report);
  if (!listed) return;
  for (const auto& [name, bytes] : listed->files()) {
    if (!is_result_name(name)) continue;
    const auto cut = bytes ? size_of_cut_video(folder / name, *bytes) : std::nullopt;
    written.add(name, cut ? cut : bytes);
  }
  written.add(report.lexically_relative(folder).generic_string());
}

void check_unfinished(const fs::path& folder, Existing existing, const std::string& head) {
  const fs::path unfinished = unfinished_in(folder);
  if (type_of(unfinished) == fs::file_type::not_found) return;
  const std::string found = head_of_journal(folder);
  const bool plain = type_of(unfinished) == fs::file_type::directory;
  if (!plain || (found.empty() && !is_new(unfinished))) {
    throw UserError(unfinished.string() +
                    " is in the way, and no earlier run wrote it (it has no journal)" + kAdvice);
  }
  const outputs::Intent intent{{kUnfinished}, unfinished_files_in(folder), {}};
  if (std::string obstacle = outputs::obstacle_in(folder, intent); !obstacle.empty()) {
    throw UserError(obstacle);
  }
  if (!is_interrupted(folder) || existing == Existing::kReplace) return;
  if (existing == Existing::kRefuse) {
    throw UserError(folder.string() +
                    ": has a run that was interrupted: --resume continues it, --overwrite starts "
                    "over; or choose another folder by --out");
  }
  if (head.empty() || head == found) return;
  throw UserError(folder.string() +
                  ": has an interrupted run of another input or other options; choose another "
                  "folder by --out, or --overwrite");
}

}  // namespace

fs::path unfinished_in(const fs::path& folder) { return folder / kUnfinished; }

fs::path journal_in(const fs::path& folder) { return unfinished_in(folder) / kJournal; }

outputs::WrittenFiles results_in(const fs::path& folder) {
  outputs::WrittenFiles written;
  if (!head_of_journal(folder).empty()) {
    // A run that was interrupted while it published its files.
    const fs::path report = unfinished_in(folder) / kPieceFile;
    if (const auto listed = files_listed_in(report)) {
      for (const auto& [name, bytes] : listed->files()) {
        if (is_result_name(name)) written.add(name, bytes);
      }
    }
  }
  for (const char* report : kReportFiles) add_listed(folder, folder / report, written);
  return written;
}

outputs::WrittenFiles unfinished_files_in(const fs::path& folder) {
  outputs::WrittenFiles written;
  const fs::path unfinished = unfinished_in(folder);
  std::error_code error;
  for (fs::recursive_directory_iterator entry(unfinished, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path name = entry->path().lexically_relative(unfinished);
    if (is_unfinished_name(name)) written.add((fs::path(kUnfinished) / name).generic_string());
  }
  return written;
}

void check_results_folder(const fs::path& folder, const Recording& recording,
                          const WorkOptions& options, Existing existing, const std::string& head) {
  check_unfinished(folder, existing, head);
  outputs::Intent intent{{kReportFiles.begin(), kReportFiles.end()}, results_in(folder), {}};
  for (const Product product : options.products) {
    intent.targets.push_back(product_path(options, product));
  }
  intent.inputs = outputs::FileSet(recording_files(recording));
  const std::string obstacle = outputs::obstacle_in(folder, intent);
  if (!obstacle.empty()) throw UserError(obstacle);
  if (existing != Existing::kRefuse) return;
  for (const auto& [name, bytes] : intent.written.files()) {
    if (type_of(folder / name) == fs::file_type::not_found) continue;
    throw UserError(folder.string() + ": has results already (" + name +
                    "); choose another folder by --out, or --resume or --overwrite");
  }
}

bool is_interrupted(const fs::path& folder) {
  if (head_of_journal(folder).empty()) return false;
  std::ifstream stream(journal_in(folder));
  std::string head, pair;
  return std::getline(stream, head) && std::getline(stream, pair);
}

std::string defect_of_results(const fs::path& folder) {
  const std::optional<outputs::WrittenFiles> listed = files_listed_in(folder / kRunFile);
  if (!listed) return std::string(kRunFile) + " is missing or damaged";
  if (std::string defect = outputs::defect_of(folder, *listed); !defect.empty()) return defect;
  for (const auto& [name, bytes] : listed->files()) {
    if (fs::path(name).extension() != ".mkv") continue;
    if (const std::string end = missing_end(folder / name); !end.empty()) return name + ": " + end;
  }
  return {};
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
      const fs::path name = entry.path().filename();
      if (name.extension() != ".part") files.push_back(path + "/" + name.string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void remove_results(const fs::path& folder, const std::vector<std::string>& kept) {
  const outputs::WrittenFiles written = results_in(folder);
  outputs::WrittenFiles products, reports;
  for (const auto& [name, bytes] : written.files()) {
    if (std::binary_search(kept.begin(), kept.end(), name)) continue;
    (is_result_name(name) ? products : reports).add(name, bytes);
  }
  // The reports last: what is left is listed still if this is interrupted.
  outputs::remove_written(folder, products);
  outputs::remove_written(folder, reports);
}

}  // namespace mtstereo::run
