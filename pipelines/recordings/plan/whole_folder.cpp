// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/whole_folder.hpp"

#include <fcntl.h>
#include <glib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "lib/outputs/json_text.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/plan/discard.hpp"
#include "recordings/plan/folder_names.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kContents = "whole.json";
constexpr int kContentsVersion = 1;
// Above this number of files, one call that stores the whole file system is faster.
constexpr std::size_t kMostSynchronizedFiles = 64;

class FileDescriptor {
 public:
  FileDescriptor(const fs::path& file, int flags) : number_(open(file.c_str(), flags | O_CLOEXEC)) {
    if (number_ < 0) throw UserError(file.string() + ": " + std::generic_category().message(errno));
  }
  ~FileDescriptor() { close(number_); }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

void check_stored(int result, const fs::path& file) {
  // Some file systems cannot synchronize folders; they state EINVAL.
  if (result != 0 && errno != EINVAL) {
    throw UserError(file.string() +
                    ": cannot be stored: " + std::generic_category().message(errno));
  }
}

void synchronize(const fs::path& file) {
  const FileDescriptor descriptor(file, O_RDONLY);
  check_stored(fsync(descriptor.number()), file);
}

void synchronize(const fs::path& folder, const std::vector<fs::path>& names) {
  if (names.size() > kMostSynchronizedFiles) {
    const FileDescriptor descriptor(folder, O_RDONLY);
    check_stored(syncfs(descriptor.number()), folder);
    return;
  }
  for (const fs::path& name : names) synchronize(folder / name);
  synchronize(folder / kContents);
  synchronize(folder);
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) names.push_back(fs::relative(entry.path(), folder));
  }
  std::sort(names.begin(), names.end());
  return names;
}

json read_contents(const fs::path& folder) {
  std::error_code error;  // a pipe would be read without an end
  if (!fs::is_regular_file(folder / kContents, error)) return {};
  std::ifstream in(folder / kContents, std::ios::binary);
  return json::parse(in);
}

std::string file_defect(const fs::path& folder, const json& file, Check check) {
  const std::string name = file.at("name");
  const auto bytes = file.at("bytes").get<std::uintmax_t>();
  std::error_code error;
  const std::uintmax_t found = fs::file_size(folder / name, error);
  if (error) return name + " is missing";
  if (found != bytes) {
    return name + " has " + std::to_string(found) + " of " + std::to_string(bytes) + " bytes";
  }
  if (check == Check::kContents && file.contains("sha256") &&
      sha256_of(folder / name) != file.at("sha256")) {
    return name + " has changed since it was written";
  }
  return {};
}

std::string contents_defect(const fs::path& folder, const Origin& origin, Check check) {
  const json contents = read_contents(folder);
  if (contents.at("version") != kContentsVersion) return "it is of another version of mtstereo-run";
  if (contents.at("work") != origin.work || contents.at("first") != origin.range.first ||
      contents.at("count") != origin.range.count) {
    return "it belongs to another plan";
  }
  for (const json& file : contents.at("files")) {
    if (std::string found = file_defect(folder, file, check); !found.empty()) return found;
  }
  return {};
}

}  // namespace

std::string sha256_of(const fs::path& file) {
  const std::unique_ptr<GChecksum, decltype(&g_checksum_free)> sum(
      g_checksum_new(G_CHECKSUM_SHA256), g_checksum_free);
  const FileDescriptor descriptor(file, O_RDONLY);
  std::vector<unsigned char> buffer(1 << 20);
  ssize_t size = 0;
  while ((size = read(descriptor.number(), buffer.data(), buffer.size())) != 0) {
    if (size > 0) {
      g_checksum_update(sum.get(), buffer.data(), size);
    } else if (errno != EINTR) {
      throw UserError(file.string() + ": " + std::generic_category().message(errno));
    }
  }
  return g_checksum_get_string(sum.get());
}

void write_aside(const fs::path& file, const std::string& text) {
  const fs::path aside = unused_name(file.parent_path(), "." + file.filename().string());
  errno = 0;
  std::ofstream out(aside, std::ios::binary);
  out << text;
  out.close();
  std::error_code error;
  if (!out) {
    const std::string reason = std::generic_category().message(errno);
    fs::remove(aside, error);
    throw UserError(file.string() + ": cannot be written: " + reason);
  }
  synchronize(aside);
  fs::rename(aside, file, error);
  if (error) {
    const std::string reason = error.message();
    fs::remove(aside, error);
    throw UserError(file.string() + ": " + reason);
  }
}

NewFolder::NewFolder(const fs::path& parent, const std::string& label)
    : path_(unused_name(parent, label)) {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw UserError(path_.string() + ": " + error.message());
}

NewFolder::~NewFolder() {
  std::error_code error;
  if (!path_.empty()) fs::remove_all(path_, error);
}

bool NewFolder::publish(const fs::path& target, const Origin& origin, const Figures& figures,
                        Checksums checksums) {
  try {
    const std::vector<fs::path> names = files_in(path_);
    json files = json::array();
    for (const fs::path& name : names) {
      files.push_back({{"name", name.string()}, {"bytes", fs::file_size(path_ / name)}});
      if (checksums == Checksums::kWith) files.back()["sha256"] = sha256_of(path_ / name);
    }
    const json contents{{"version", kContentsVersion},
                        {"work", origin.work},
                        {"first", origin.range.first},
                        {"count", origin.range.count},
                        {"pairs", figures.pairs},
                        {"density", figures.density},
                        {"median_disparity", figures.median_disparity},
                        {"seconds", figures.seconds},
                        {"damage", figures.damage},
                        {"files", std::move(files)}};
    write_aside(path_ / kContents, outputs::text_of(contents, 1) + "\n");
    synchronize(path_, names);
    fs::create_directories(target.parent_path());
    while (!rename_folder(path_, target)) {
      if (defect(target, origin, Check::kContents).empty())
        return false;  // another process was first
      discard_damaged(target, origin, path_.parent_path());
    }
    path_.clear();
    synchronize(target.parent_path());
    return true;
  } catch (const fs::filesystem_error& error) {
    throw UserError(error.path1().string() + ": " + error.code().message());
  }
}

void refresh(const fs::path& folder) {
  // NFS remembers for up to a minute that a name did not exist, unless the folder is opened.
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  while (!error && entry != fs::directory_iterator()) entry.increment(error);
}

void link_file(const fs::path& file, const fs::path& link) {
  std::error_code error;
  if (fs::equivalent(file, link, error)) return;
  const fs::path aside = unused_name(link.parent_path(), "." + link.filename().string());
  fs::create_directories(link.parent_path(), error);
  fs::create_hard_link(file, aside, error);
  if (error) fs::copy_file(file, aside, error);
  if (!error) fs::rename(aside, link, error);
  if (!error) return;
  const std::string reason = error.message();
  fs::remove(aside, error);
  throw UserError(link.string() + ": " + reason);
}

void link_files(const fs::path& whole, const fs::path& folder,
                const std::vector<std::string>& without) {
  try {
    for (const fs::path& name : files_in(whole)) {
      if (name == kContents || std::count(without.begin(), without.end(), name) != 0) continue;
      link_file(whole / name, folder / name);
    }
  } catch (const fs::filesystem_error& error) {
    throw UserError(error.path1().string() + ": " + error.code().message());
  }
}

std::string defect(const fs::path& folder, const Origin& origin, Check check) {
  std::error_code error;
  if (!fs::exists(folder / kContents, error)) return "it is missing";
  try {
    return contents_defect(folder, origin, check);
  } catch (const json::exception&) {
    return std::string(kContents) + " is damaged";
  } catch (const UserError& unreadable) {
    return unreadable.what();
  }
}

Figures read_figures(const fs::path& folder) {
  try {
    const json contents = read_contents(folder);
    return {contents.at("pairs"), contents.at("density"), contents.at("median_disparity"),
            contents.at("seconds"), contents.at("damage")};
  } catch (const json::exception&) {
    throw UserError((folder / kContents).string() + ": is damaged");
  }
}

bool discard_damaged(const fs::path& folder, const Origin& origin, const fs::path& parent) {
  return discard(folder, parent, [&origin](const fs::path& aside) {
    return defect(aside, origin, Check::kContents).empty();
  });
}

}  // namespace mtstereo::run
