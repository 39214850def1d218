// SPDX-License-Identifier: LGPL-2.1-or-later

// Pairs from picture files.

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <regex>
#include <vector>

#include "lib/outputs/user_error.hpp"
#include "programs/calibrate/source.hpp"
#include "programs/calibrate/texts.hpp"

namespace mtstereo::calibrate {
namespace {

namespace fs = std::filesystem;

bool has_picture_name(const fs::path& file) {
  constexpr std::array kExtensions{".png", ".jpg", ".jpeg", ".pgm",
                                   ".ppm", ".bmp", ".tif",  ".tiff"};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(kExtensions.begin(), kExtensions.end(),
                     [&](const char* each) { return extension == each; });
}

// left/%04d.png
const std::regex& number_pattern() {
  static const std::regex pattern("%0?([1-9]?)d");
  return pattern;
}

std::vector<fs::path> numbered(const std::string& text) {
  std::smatch match;
  std::regex_search(text, match, number_pattern());
  const std::string digits = match[1].length() > 0 ? match[1].str() : "1";
  const std::regex name("\\d{" + digits + ",}");
  const std::string before = match.prefix(), after = match.suffix();
  const fs::path folder = fs::path(text).parent_path();
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder)) {
    const std::string file = (folder / entry.path().filename()).string();
    if (file.size() <= before.size() + after.size() || !file.starts_with(before) ||
        !file.ends_with(after)) {
      continue;
    }
    const std::string number =
        file.substr(before.size(), file.size() - before.size() - after.size());
    if (std::regex_match(number, name)) files.emplace_back(file);
  }
  return files;
}

std::vector<fs::path> matching(const std::string& text) {
  const fs::path pattern(text);
  const fs::path folder = pattern.parent_path();
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder)) {
    const fs::path name = entry.path().filename();
    if (fnmatch(pattern.filename().c_str(), name.c_str(), 0) == 0) files.push_back(folder / name);
  }
  return files;
}

// By name; numbers without leading zeros by their value.
void sort_names(std::vector<fs::path>& files) {
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return strverscmp(a.filename().c_str(), b.filename().c_str()) < 0;
  });
}

std::vector<fs::path> list_pictures(const std::string& source) {
  std::vector<fs::path> files;
  try {
    if (fs::is_directory(source)) {
      for (const auto& entry : fs::directory_iterator(source)) {
        if (has_picture_name(entry.path())) files.push_back(entry.path());
      }
    } else if (std::regex_search(source, number_pattern())) {
      files = numbered(source);
    } else if (source.find_first_of("*?[") != std::string::npos) {
      files = matching(source);
    } else {
      files.emplace_back(source);
    }
  } catch (const fs::filesystem_error& error) {
    throw UserError(source + ": " + error.code().message());
  }
  if (files.empty()) throw UserError(source + ": there are no pictures");
  sort_names(files);
  return files;
}

cv::Mat read(const fs::path& file) {
  cv::Mat image;
  try {
    image = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) throw UserError(file.string() + ": is not a picture that can be read");
  return image;
}

// The last number in a name, such as 12 of "left_0012.png"; empty if there is none.
std::string number_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t end = stem.find_last_of("0123456789");
  if (end == std::string::npos) return {};
  const std::size_t before = stem.find_last_not_of("0123456789", end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const std::size_t first = std::min(stem.find_first_not_of('0', begin), end);
  return stem.substr(first, end - first + 1);
}

// The first picture whose number the others do not have; empty if numbers do not tell.
fs::path without_partner(const std::vector<fs::path>& pictures,
                         const std::vector<fs::path>& others) {
  for (const fs::path& picture : pictures) {
    const std::string number = number_of(picture);
    if (number.empty()) return {};
    const bool found = std::any_of(others.begin(), others.end(), [&](const fs::path& other) {
      return number_of(other) == number;
    });
    if (!found) return picture;
  }
  return {};
}

[[noreturn]] void refuse_counts(const SourceOptions& options, const std::vector<fs::path>& left,
                                const std::vector<fs::path>& right) {
  fs::path alone = without_partner(left, right);
  if (alone.empty()) alone = without_partner(right, left);
  throw UserError(options.left + " has " + counted(left.size(), "picture") + ", but " +
                  options.right + " has " + std::to_string(right.size()) +
                  ": they are paired in order" +
                  (alone.empty() ? "" : "; " + alone.string() + " has no partner"));
}

bool is_line(const std::string& source) {
  return source.find('!') != std::string::npos || source.find("://") != std::string::npos;
}

bool is_picture_pattern(const std::string& source) {
  return std::regex_search(source, number_pattern()) ||
         source.find_first_of("*?[") != std::string::npos;
}

// Names of elements have no dot and no slash.
void check_exists(const std::string& source) {
  if (is_line(source) || source.starts_with("/dev/") || is_picture_pattern(source)) return;
  const fs::file_status status = fs::status(source);
  if (!fs::exists(status)) {
    const bool is_name = source.find_first_of("./") != std::string::npos;
    if (!is_name || source.find(' ') != std::string::npos) return;
    throw UserError(source + ": no such file or folder");
  }
  if (fs::is_regular_file(status) || fs::is_directory(status)) return;
  throw UserError(source + ": is a pipe or a device, which may never end: record it first");
}

class Pictures : public PairSource {
 public:
  explicit Pictures(const SourceOptions& options)
      : arrangement_(options.arrangement), left_(list_pictures(options.left)) {
    if (arrangement_ != Arrangement::kTwoSources) return;
    right_ = list_pictures(options.right);
    if (left_.size() != right_.size()) refuse_counts(options, left_, right_);
  }

  SourceState next(ImagePair& pair) override {
    if (index_ == left_.size()) return SourceState::kEnd;
    pair.time = static_cast<double>(index_);
    pair.name = left_[index_].filename().string();
    if (arrangement_ == Arrangement::kTwoSources) {
      pair.left = read(left_[index_]);
      pair.right = read(right_[index_]);
    } else {
      split(read(left_[index_]), arrangement_, pair);
    }
    ++index_;
    return SourceState::kPair;
  }

  bool stills() const override { return true; }

 private:
  Arrangement arrangement_;
  std::vector<fs::path> left_, right_;
  std::size_t index_ = 0;
};

}  // namespace

bool is_pictures(const std::string& source) {
  if (is_line(source)) return false;
  return fs::is_directory(source) || has_picture_name(source);
}

void split(const cv::Mat& image, Arrangement arrangement, ImagePair& pair) {
  const bool across = arrangement == Arrangement::kSideBySide;
  const int extent = across ? image.cols : image.rows;
  if (extent % 2 != 0) {
    throw UserError("images of " + std::to_string(image.cols) + "x" + std::to_string(image.rows) +
                    " cannot be halved");
  }
  const int half = extent / 2;
  pair.left = across ? image.colRange(0, half) : image.rowRange(0, half);
  pair.right = across ? image.colRange(half, extent) : image.rowRange(half, extent);
  pair.left = pair.left.clone();
  pair.right = pair.right.clone();
}

std::unique_ptr<PairSource> open_pictures(const SourceOptions& options) {
  return std::make_unique<Pictures>(options);
}

std::vector<fs::path> input_files(const SourceOptions& options) {
  std::vector<fs::path> files;
  for (const std::string& source : {options.left, options.right}) {
    if (source.empty()) continue;
    check_exists(source);
    const std::vector<fs::path> pictures =
        is_pictures(source) ? list_pictures(source) : std::vector<fs::path>{source};
    files.insert(files.end(), pictures.begin(), pictures.end());
  }
  return files;
}

std::unique_ptr<PairSource> open_source(const SourceOptions& options) {
  const bool two = options.arrangement == Arrangement::kTwoSources;
  const bool left = is_pictures(options.left);
  if (two && left != is_pictures(options.right)) {
    throw UserError("one source gives pictures and the other one video: " + options.left + ", " +
                    options.right);
  }
  return left ? open_pictures(options) : open_streams(options);
}

}  // namespace mtstereo::calibrate
