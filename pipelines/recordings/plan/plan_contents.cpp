// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/plan_contents.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "lib/outputs/user_error.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/plan/plan_folder.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kWhole = "whole.json";

std::vector<std::string> names_of(const PlanFolder& files) {
  std::vector<std::string> names;
  for (const fs::path& each : {files.plan(), files.summary(), files.works(), files.pieces(),
                               files.recordings(), files.unfinished()}) {
    names.push_back(each.filename().string());
  }
  return names;
}

// A pipe would be read without an end.
bool is_regular(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(fs::symlink_status(file, error));
}

bool begins_with(const fs::path& file, const std::string& text) {
  if (!is_regular(file)) return false;
  std::ifstream in(file, std::ios::binary);
  std::string head(text.size(), '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  // A file that is cut off is one of this program too.
  return head == text || (!in && text.starts_with(head));
}

// plan.json and summary.json, whose members are sorted by their names.
bool is_plan_file(const fs::path& file) { return begins_with(file, "{\n \"damaged\":"); }

bool is_work_file(const fs::path& file) {
  static const std::regex kAside(R"(.+\.json\.\d+\.new|\..+-\d+-\d+)");
  static const std::regex kKey("[0-9a-f]{64}");
  const std::string name = file.filename().string();
  if (std::regex_match(name, kAside)) return true;
  if (file.extension() == ".json") return begins_with(file, R"({"kind":"work of mtstereo-run")");
  if (!is_regular(file)) return false;
  std::ifstream in(file);
  std::string key;
  return file.extension() == ".key" && std::getline(in, key) && std::regex_match(key, kKey);
}

// The name of a NewFolder.
bool is_unfinished_folder(const fs::path& folder) {
  static const std::regex kFolder(R"((piece|recording)-?.*-\d+-\d+)");
  return std::regex_match(folder.filename().string(), kFolder);
}

// What discard() has set aside. It may have a file of the user, which appeared at the last moment.
bool is_discarded_folder(const fs::path& folder) {
  static const std::regex kFolder(R"(discarded-.*-\d+-\d+)");
  return std::regex_match(folder.filename().string(), kFolder);
}

void for_each_in(const fs::path& folder, const std::function<void(const fs::path&)>& visit) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    visit(entry->path());
  }
}

// Adds paths in the folder of the plan.
class Collector {
 public:
  explicit Collector(const PlanFolder& files) : files_(files) {}

  outputs::WrittenFiles collect() {
    for (const fs::path& file : {files_.plan(), files_.summary()}) {
      if (is_plan_file(file)) add(file);
    }
    for_each_in(files_.works(), [this](const fs::path& file) {
      if (is_work_file(file)) add(file);
    });
    for (const fs::path& folders : {files_.pieces(), files_.recordings()}) {
      for_each_in(folders, [this](const fs::path& folder) { add_whole(folder); });
    }
    for_each_in(files_.unfinished(), [this](const fs::path& folder) {
      if (is_unfinished_folder(folder)) add_all(folder);
      if (is_discarded_folder(folder)) add_whole(folder);
    });
    return std::move(written_);
  }

 private:
  void add(const fs::path& file) {
    written_.add(file.lexically_relative(files_.path()).generic_string());
  }
  void add_whole(const fs::path& folder) {
    const outputs::WrittenFiles listed = whole_files_in(folder);
    for (const auto& [name, bytes] : listed.files()) add(folder / name);
  }
  void add_all(const fs::path& folder) {
    std::error_code error;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      if (entry->is_regular_file(error)) add(entry->path());
    }
  }

  const PlanFolder& files_;
  outputs::WrittenFiles written_;
};

void remove_empty_below(const fs::path& folder) {
  for_each_in(folder, remove_empty_below);
  rmdir(folder.c_str());
}

std::vector<std::string> names_in(const fs::path& whole) {
  if (!is_regular(whole)) return {};
  std::ifstream in(whole, std::ios::binary);
  const json contents = json::parse(in, nullptr, false);
  std::vector<std::string> names;
  if (!contents.is_object() || !contents.contains("files")) return names;
  for (const json& file : contents["files"]) {
    if (file.is_object() && file.contains("name") && file["name"].is_string()) {
      names.push_back(file["name"].get<std::string>());
    }
  }
  return names;
}

}  // namespace

outputs::WrittenFiles whole_files_in(const fs::path& folder) {
  outputs::WrittenFiles written;
  for (const std::string& name : names_in(folder / kWhole)) written.add(name);
  for (const char* report : kReportFiles) {
    const auto listed = files_listed_in(folder / report);
    if (!listed) continue;
    for (const auto& [name, bytes] : listed->files()) written.add(name);
    written.add(report);
  }
  if (!written.empty()) written.add(kWhole);
  return written;
}

std::string foreign_file_in(const fs::path& folder) {
  outputs::Intent intent{{folder.filename().string()}, {}, {}};
  const outputs::WrittenFiles listed = whole_files_in(folder);
  for (const auto& [name, bytes] : listed.files()) {
    intent.written.add((folder.filename() / name).generic_string());
  }
  return outputs::obstacle_in(folder.parent_path(), intent);
}

void remove_listed(const fs::path& folder) {
  const outputs::WrittenFiles written = whole_files_in(folder);
  outputs::WrittenFiles products;
  for (const auto& [name, bytes] : written.files()) {
    const bool lists = name == kWhole || std::count(kReportFiles.begin(), kReportFiles.end(), name);
    if (!lists) products.add(name);
  }
  // The lists last: what is left is listed still if this is interrupted.
  outputs::remove_written(folder, products);
  outputs::remove_written(folder, written);
  rmdir(folder.c_str());
}

void check_plan_file(const fs::path& file) {
  std::error_code error;
  const fs::file_type type = fs::symlink_status(file, error).type();
  if (type == fs::file_type::not_found) return;
  if (type == fs::file_type::regular && is_plan_file(file)) return;
  throw UserError(file.string() +
                  " is in the way, and mtstereo-run did not write it: move it, or choose another "
                  "folder");
}

void check_plan_folder(const fs::path& folder, const outputs::FileSet& inputs) {
  const PlanFolder files(folder);
  const outputs::Intent intent{names_of(files), Collector(files).collect(), inputs};
  const std::string obstacle = outputs::obstacle_in(folder, intent);
  if (!obstacle.empty()) throw UserError(obstacle);
}

void remove_unfinished(const fs::path& folder) {
  const PlanFolder files(folder);
  for_each_in(files.unfinished(), [](const fs::path& each) {
    std::error_code error;
    if (is_unfinished_folder(each)) fs::remove_all(each, error);
    if (is_discarded_folder(each)) remove_listed(each);
  });
  rmdir(files.unfinished().c_str());
}

void remove_plan(const fs::path& folder) {
  check_plan_folder(folder, {});
  const PlanFolder files(folder);
  const outputs::WrittenFiles written = Collector(files).collect();
  // plan.json first: the rest is then not a plan.
  std::error_code error;
  fs::remove(files.plan(), error);
  outputs::remove_written(folder, written);
  for (const std::string& name : names_of(files)) remove_empty_below(folder / name);
  std::string obstacle = outputs::obstacle_in(folder, {names_of(files), {}, {}});
  if (!obstacle.empty()) throw UserError(obstacle);
}

}  // namespace mtstereo::run
