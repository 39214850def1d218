// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "recordings/matching/piece.hpp"

// Folders that appear at once, with all of their files, and that state their content in whole.json.
// Whether a folder is whole is checked, not assumed from its existence.

namespace mtstereo::run {

/// What a folder of results was made from. A folder of another plan is not taken for one of this.
struct Origin {
  std::string work;  ///< SHA-256 of the file of the work
  Range range;
};

/// The figures of a piece or of a recording.
struct Figures {
  std::int64_t pairs = 0;       ///< processed pairs
  double density = 0;           ///< mean over these
  double median_disparity = 0;  ///< mean over these [px]
  double seconds = 0;           ///< of processing, of all pieces
  std::string damage;           ///< where the input ended early; empty if it did not
};

/// How thoroughly a folder is checked.
enum class Check {
  kSizes,     ///< origin, names and sizes
  kContents,  ///< the files are read, and their SHA-256 is compared
};

/// Whether whole.json states the SHA-256 of the files.
enum class Checksums {
  kWith,
  kWithout,  ///< Check::kContents compares sizes only
};

/// A folder for files that are being written. It is removed unless it is published.
class NewFolder {
 public:
  /// Creates a folder in `parent` with a name that no other process has. Throws UserError.
  NewFolder(const std::filesystem::path& parent, const std::string& label);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Writes whole.json, waits until all files are stored, and renames the folder to `target`. If
  /// there is a whole folder of this origin already, this one is removed; if there is a damaged
  /// one, it is replaced. Returns whether this one was published. Throws UserError.
  bool publish(const std::filesystem::path& target, const Origin& origin, const Figures& figures,
               Checksums checksums);

 private:
  std::filesystem::path path_;
};

/// Why a folder is not whole, as the end of a sentence such as "disparity.mkv has 3 of 9 bytes";
/// empty if it is whole.
std::string defect(const std::filesystem::path& folder, const Origin& origin, Check check);
/// The figures in the whole.json of a whole folder. Throws UserError.
Figures read_figures(const std::filesystem::path& folder);
/// As discard(), but a folder that is whole stays: another process may have replaced the damaged
/// one meanwhile. Returns false if it stays. Throws UserError.
bool discard_damaged(const std::filesystem::path& folder, const Origin& origin,
                     const std::filesystem::path& parent);

/// Links a file under another name, or copies it where that is not possible. Replaces what has this
/// name at once. Throws UserError.
void link_file(const std::filesystem::path& file, const std::filesystem::path& link);
/// Links all files of a whole folder but these into another one. Throws UserError.
void link_files(const std::filesystem::path& whole, const std::filesystem::path& folder,
                const std::vector<std::string>& without = {});

/// Lists a folder, so that a network file system shows what other machines added to it. Does
/// nothing if there is none.
void refresh(const std::filesystem::path& folder);

/// SHA-256 of a file, in hexadecimal digits. Throws UserError.
std::string sha256_of(const std::filesystem::path& file);
/// Writes a file aside, waits until it is stored, and renames it. Throws UserError.
void write_aside(const std::filesystem::path& file, const std::string& text);

}  // namespace mtstereo::run
