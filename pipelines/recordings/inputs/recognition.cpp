// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/recognition.hpp"

#include <linux/magic.h>
#include <sys/vfs.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

#include "lib/files/file_names.hpp"
#include "lib/files/unread_kinds.hpp"
#include "lib/outputs/printable.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/inputs/completion.hpp"
#include "recordings/inputs/folder_search.hpp"
#include "recordings/inputs/sources.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

// Folders such as /proc never end.
bool is_of_kernel(const fs::path& folder) {
  struct statfs found = {};
  if (statfs(folder.c_str(), &found) != 0) return false;
  return found.f_type == PROC_SUPER_MAGIC || found.f_type == SYSFS_MAGIC;
}

std::string remark_on(const Problem& unread) {
  return unread.input + " is not used: it " + unread.reason + ".";
}

constexpr int kLevels = 3;  // below the given folder, to say what to give instead

// A file that may be a view and is of a kind that is not read, in a folder or those in it.
std::string unread_in(const fs::path& folder, int levels) {
  if (is_of_kernel(folder)) return {};
  std::string unread = files::first_unread(files::files_in(folder));
  for (const fs::path& inner : files::folders_in(folder)) {
    if (!unread.empty() || levels == 0) break;
    unread = unread_in(inner, levels - 1);
  }
  return unread;
}

// The folders with images in a folder, or in the first one below it that has two of them, or else
// all below it.
std::vector<fs::path> image_folders(const fs::path& folder, int levels) {
  if (is_of_kernel(folder)) return {};
  const std::vector<fs::path> inner = files::folders_in(folder);
  std::vector<fs::path> found;
  std::copy_if(inner.begin(), inner.end(), std::back_inserter(found),
               [](const fs::path& each) { return !files::images_in(each).empty(); });
  if (found.size() > 1 || levels == 0) return found;
  for (const fs::path& each : inner) {
    const std::vector<fs::path> deeper = image_folders(each, levels - 1);
    if (deeper.size() > 1) return deeper;
    found.insert(found.end(), deeper.begin(), deeper.end());
  }
  return found;
}

// What to give instead of a folder in which no name tells the views apart.
std::string views_to_give(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::path& inner : image_folders(folder, kLevels)) {
    names.push_back(outputs::printable(inner.lexically_relative(folder).string()));
  }
  if (names.empty()) {
    return "give the left and the right view, as two videos, images, folders or patterns";
  }
  if (names.size() == 1) {
    return "the images in " + names[0] +
           " do not say by their names which view is left: give two patterns of their names in "
           "quotes, the left one first";
  }
  const std::string more =
      names.size() == 2 ? "" : " (of " + std::to_string(names.size()) + " folders with images)";
  return "its folders, such as " + names[0] + " and " + names[1] + more +
         ", do not say by their names which view is left: give two of them, the left one first";
}

// What a folder has that is not the recording.
Recording only_recording(const std::string& folder, FolderContents contents) {
  if (contents.recordings.empty()) {
    if (contents.problems.empty()) {
      const std::string unread = unread_in(folder, kLevels);
      if (!unread.empty()) throw UserError(unread);
      throw UserError(folder + ": no recording is in this folder: " + views_to_give(folder));
    }
    throw UserError(text_of(contents.problems.front()));
  }
  if (contents.recordings.size() > 1) {
    throw UserError(folder + ": there are " + std::to_string(contents.recordings.size()) +
                    " recordings, such as " + contents.recordings[0].name + " and " +
                    contents.recordings[1].name + ": give one of them, or plan all");
  }
  Recording recording = std::move(contents.recordings.front());
  for (const Problem& problem : contents.problems) {
    recording.remarks.push_back(text_of(problem, " is not used: "));
  }
  if (contents.unread) recording.remarks.push_back(remark_on(*contents.unread));
  return recording;
}

// The name of a recording in an archive: its path in it.
std::string name_in(const fs::path& archive, const fs::path& folder, const std::string& name) {
  const fs::path below = folder.lexically_relative(archive).lexically_normal();
  std::string result;
  for (const fs::path& part : below) {
    if (part == "." || part.empty()) continue;
    result += (result.empty() ? "" : "-") + outputs::printable(part.string());
  }
  if (result.empty()) return name;
  return name == outputs::printable(folder_name(folder)) ? result : result + "-" + name;
}

class ArchiveSearch {
 public:
  ArchiveSearch(fs::path archive, const InputOptions& options, std::vector<Problem>& problems)
      : archive_(std::move(archive)), options_(options), problems_(problems) {}

  void enter(const fs::path& folder) {
    std::error_code error;
    if (is_of_kernel(folder)) {
      problems_.push_back({folder.string(), "has files of the kernel, and no recordings"});
      return;
    }
    const fs::directory_iterator readable(folder, error);
    if (error) {
      // Each disk has a folder of this name that only its administrator can read.
      if (folder.filename() == "lost+found") return;
      problems_.push_back({folder.string(), "the folder cannot be read: " + error.message()});
      return;
    }
    const fs::path real = fs::canonical(folder, error);
    const bool is_new = std::find(entered_.begin(), entered_.end(), real) == entered_.end();
    if (error || !is_new || is_result(folder)) return;
    entered_.push_back(real);
    FolderContents contents = search_folder(folder, archive_, options_, false);
    const std::size_t first = recordings_.size();
    for (Recording& recording : contents.recordings) {
      recording.name = name_in(archive_, folder, recording.name);
      recordings_.push_back(std::move(recording));
    }
    problems_.insert(problems_.end(), contents.problems.begin(), contents.problems.end());
    for (const fs::path& inner : files::folders_in(folder)) {
      const auto& used = contents.used_folders;
      if (std::find(used.begin(), used.end(), inner) == used.end()) enter(inner);
    }
    if (!contents.unread) return;
    if (first < recordings_.size()) {
      recordings_[first].remarks.push_back(remark_on(*contents.unread));
    } else {
      problems_.push_back(*contents.unread);
    }
  }

  std::vector<Recording> take() {
    std::stable_sort(recordings_.begin(), recordings_.end(),
                     [](const Recording& a, const Recording& b) { return a.name < b.name; });
    make_names_unique();
    return std::move(recordings_);
  }

 private:
  void make_names_unique() {
    constexpr std::size_t kLongest = 200;  // of 255 that file systems allow
    std::vector<std::string> names;
    for (Recording& recording : recordings_) {
      if (recording.name.size() > kLongest) {
        recording.name = outputs::printable(recording.name.substr(0, kLongest));
      }
      const std::string name = recording.name;
      for (int i = 2; std::find(names.begin(), names.end(), recording.name) != names.end(); ++i) {
        recording.name = name + "-" + std::to_string(i);
      }
      names.push_back(recording.name);
    }
  }

  fs::path archive_;
  const InputOptions& options_;
  std::vector<Problem>& problems_;
  std::vector<Recording> recordings_;
  std::vector<fs::path> entered_;
};

}  // namespace

std::string text_of(const Problem& problem, const std::string& between) {
  const std::string name = problem.input + ": ";
  const bool named = problem.reason.starts_with(name);
  // Of a file in it or beside it, such as one of the other view.
  const std::string beside = fs::path(problem.input).parent_path().string();
  if (!named && !beside.empty() && problem.reason.starts_with(beside + "/")) return problem.reason;
  if (!named && problem.reason.starts_with(problem.input)) return problem.reason;
  return problem.input + between + (named ? problem.reason.substr(name.size()) : problem.reason);
}

Recording recognize(const std::vector<std::string>& inputs, const InputOptions& options) {
  if (inputs.empty() || inputs.size() > 2) {
    throw UserError("a recording is one input, or two: left and right; there are " +
                    std::to_string(inputs.size()));
  }
  const std::string& left = inputs.front();
  if (inputs.size() == 2) {
    // The left one first, so that its error is the one that is stated if both are wrong.
    const Source first = source_of(left);
    return completed(recording_of(first, source_of(inputs[1]), options), options);
  }
  if (files::is_folder(left)) return only_recording(left, search_folder(left, left, options, true));
  return completed(recording_of(source_of(left), {}, options), options);
}

std::vector<Recording> find_recordings(const fs::path& archive, const InputOptions& options,
                                       std::vector<Problem>& problems) {
  std::error_code error;
  const fs::directory_iterator readable(archive, error);
  if (error) throw UserError(archive.string() + ": the folder cannot be read: " + error.message());
  if (is_of_kernel(archive)) {
    throw UserError(archive.string() + ": has files of the kernel, and no recordings");
  }
  ArchiveSearch search(archive, options, problems);
  search.enter(archive);
  return search.take();
}

}  // namespace mtstereo::run
