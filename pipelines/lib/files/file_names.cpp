// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/files/file_names.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::files {

namespace fs = std::filesystem;

namespace {

bool is_digit(char each) { return std::isdigit(static_cast<unsigned char>(each)) != 0; }

std::string in_lower_case(std::string text) {
  for (char& each : text) each = static_cast<char>(std::tolower(static_cast<unsigned char>(each)));
  return text;
}

// Removes and returns the digits at the beginning, without leading zeros.
std::string_view take_number(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  std::string_view number = text.substr(0, end);
  text.remove_prefix(end);
  while (number.size() > 1 && number.front() == '0') number.remove_prefix(1);
  return number;
}

template <std::size_t kCount>
bool has_extension(const fs::path& file, const std::array<std::string_view, kCount>& known) {
  return std::find(known.begin(), known.end(), extension_of(file)) != known.end();
}

// What systems write beside files: previews and the metadata of other systems.
bool is_of_system(const std::string& name) {
  return name.starts_with('.') || name == "@eaDir" || name == "__MACOSX" ||
         name == "$RECYCLE.BIN" || name == "#recycle";
}

template <typename Accept>
std::vector<fs::path> entries_of(const fs::path& folder, Accept accept) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator each(folder, error), end; !error && each != end;
       each.increment(error)) {
    const fs::path& path = each->path();
    if (!is_of_system(path.filename().string()) && accept(*each)) found.push_back(path);
  }
  std::sort(found.begin(), found.end(), [](const fs::path& a, const fs::path& b) {
    return numbered_less(a.filename().string(), b.filename().string());
  });
  return found;
}

// Most file systems state with the name what an entry is.
bool is_file(const fs::directory_entry& entry) {
  std::error_code error;
  return entry.is_regular_file(error);
}

// The name of a pattern: what is before and after its number, and the width of the number.
struct Pattern {
  std::string before, after;
  std::size_t width = 0;  // with leading zeros; 0 = none
};

std::optional<Pattern> parse_pattern(const std::string& name) {
  Pattern pattern;
  bool found = false;
  for (std::size_t at = 0; at < name.size(); ++at) {
    std::string& text = found ? pattern.after : pattern.before;
    if (name[at] != '%') {
      text += name[at];
      continue;
    }
    if (name.substr(at, 2) == "%%") {
      text += '%';
      ++at;
      continue;
    }
    std::size_t end = at + 1;
    while (end < name.size() && is_digit(name[end])) ++end;
    const std::string width = name.substr(at + 1, end - at - 1);
    const bool is_number = end < name.size() && (name[end] == 'd' || name[end] == 'u');
    const bool is_width = width.empty() || (width.front() == '0' && width.size() <= 3);
    if (found || !is_number || !is_width) return std::nullopt;
    if (!width.empty()) std::from_chars(width.data(), width.data() + width.size(), pattern.width);
    found = true;
    at = end;
  }
  return found ? std::optional(pattern) : std::nullopt;
}

// The number of a file in a pattern; none if it does not fit.
std::optional<std::uint64_t> number_in(const Pattern& pattern, const std::string& name) {
  const std::size_t around = pattern.before.size() + pattern.after.size();
  if (name.size() <= around || !name.starts_with(pattern.before) ||
      !name.ends_with(pattern.after)) {
    return std::nullopt;
  }
  const std::string digits = name.substr(pattern.before.size(), name.size() - around);
  if (!std::all_of(digits.begin(), digits.end(), is_digit)) return std::nullopt;
  const bool padded = digits.size() > 1 && digits.front() == '0';
  if (digits.size() < pattern.width || (padded && digits.size() > pattern.width)) {
    return std::nullopt;
  }
  std::uint64_t number = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() ? std::optional(number) : std::nullopt;
}

}  // namespace

bool numbered_less(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a, whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view x = take_number(a), y = take_number(b);
      if (x != y) return x.size() != y.size() ? x.size() < y.size() : x < y;
      continue;
    }
    if (a.front() != b.front()) return a.front() < b.front();
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;  // the same numbers with other leading zeros
}

std::string last_digits(const fs::path& file) {
  const std::string stem = file.stem().string();
  const auto end = std::find_if(stem.rbegin(), stem.rend(), is_digit).base();
  const auto begin = std::find_if_not(std::reverse_iterator(end), stem.rend(), is_digit).base();
  return {begin, end};
}

std::string last_number(const fs::path& file) {
  const std::string digits = last_digits(file);
  std::string_view rest = digits;
  return std::string(take_number(rest));
}

std::string extension_of(const fs::path& file) { return in_lower_case(file.extension()); }

std::string lower_stem(const fs::path& file) { return in_lower_case(file.stem()); }

bool is_image(const fs::path& file) {
  constexpr std::array<std::string_view, 9> kKnown{".png", ".tif", ".tiff", ".bmp", ".jp2",
                                                   ".pgm", ".ppm", ".pnm",  ".webp"};
  return has_extension(file, kKnown) || is_jpeg(file);
}

bool is_jpeg(const fs::path& file) {
  constexpr std::array<std::string_view, 5> kKnown{".jpg", ".jpeg", ".jpe", ".jfif", ".jps"};
  return has_extension(file, kKnown);
}

bool is_video(const fs::path& file) {
  constexpr std::array<std::string_view, 29> kKnown{
      ".mp4", ".m4v", ".mov",  ".mkv", ".webm", ".ts",   ".mts", ".m2ts",  ".avi", ".mpg",
      ".flv", ".ogv", ".mpeg", ".3gp", ".wmv",  ".asf",  ".mxf", ".vob",   ".ivf", ".y4m",
      ".dv",  ".m2v", ".h264", ".264", ".h265", ".hevc", ".265", ".mjpeg", ".mjpg"};
  return has_extension(file, kKnown);
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::vector<fs::path> files_in(const fs::path& folder) { return entries_of(folder, is_file); }

std::vector<fs::path> folders_in(const fs::path& folder) {
  return entries_of(folder, [](const fs::directory_entry& entry) {
    std::error_code error;
    return entry.is_directory(error);
  });
}

std::vector<fs::path> images_in(const fs::path& folder) {
  return entries_of(folder, [](const fs::directory_entry& entry) {
    return is_image(entry.path()) && is_file(entry);
  });
}

bool is_pattern(const std::string& path) {
  return fs::path(path).filename().string().find_first_of("%*?[") != std::string::npos &&
         !fs::exists(path);
}

namespace {

std::vector<fs::path> files_of_shell_pattern(const fs::path& folder, const std::string& name) {
  return entries_of(folder, [&name](const fs::directory_entry& entry) {
    return fnmatch(name.c_str(), entry.path().filename().c_str(), 0) == 0 && is_file(entry);
  });
}

std::vector<fs::path> numbered_files(const fs::path& folder, const Pattern& pattern) {
  std::vector<std::pair<std::uint64_t, fs::path>> numbered;
  for (const fs::path& file : files_in(folder)) {
    const std::optional<std::uint64_t> number = number_in(pattern, file.filename().string());
    if (number) numbered.emplace_back(*number, file);
  }
  std::sort(numbered.begin(), numbered.end());
  std::vector<fs::path> files;
  files.reserve(numbered.size());
  for (auto& [number, file] : numbered) files.push_back(std::move(file));
  return files;
}

}  // namespace

std::vector<fs::path> files_of_pattern(const std::string& pattern) {
  const fs::path path(pattern);
  const std::string name = path.filename().string();
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::vector<fs::path> files;
  if (name.find('%') == std::string::npos) {
    files = files_of_shell_pattern(folder, name);
  } else if (const std::optional<Pattern> parsed = parse_pattern(name)) {
    files = numbered_files(folder, *parsed);
  } else {
    throw UserError(pattern + ": the name of the files must have one number, such as %d or %06d");
  }
  for (fs::path& file : files) file = path.parent_path() / file.filename();
  return files;
}

}  // namespace mtstereo::files
