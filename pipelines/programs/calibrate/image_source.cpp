// SPDX-License-Identifier: LGPL-2.1-or-later

// Pairs from image files.

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "lib/files/file_names.hpp"
#include "lib/files/unread_kinds.hpp"
#include "lib/images/images.hpp"
#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "programs/calibrate/source.hpp"

namespace mtstereo::calibrate {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> list_images(const std::string& source) {
  std::vector<fs::path> files{source};
  if (fs::is_directory(source)) {
    files = files::images_in(source);
  } else if (files::is_pattern(source)) {
    files = files::files_of_pattern(source);
  }
  if (files.empty()) {
    const std::string unread = files::first_unread(files::files_in(source));
    throw UserError(unread.empty() ? source + ": there are no images" : unread);
  }
  return files;
}

cv::Mat read(const fs::path& file) {
  constexpr int kAsStored =
      cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION;
  cv::Mat image = images::read(file, kAsStored);
  if (image.empty()) throw UserError(file.string() + ": is not an image that can be read");
  if (image.depth() == CV_16U) {
    // Cameras of 10 or 12 bits and thermal cameras use a part of them.
    double least = 0, most = 0;
    cv::minMaxLoc(image, &least, &most);
    const double scale = 255 / std::max(most - least, 1.0);
    image.convertTo(image, CV_8U, scale, -scale * least);
  }
  if (image.depth() != CV_8U) {
    throw UserError(file.string() + ": has no values of 8 or 16 bits: convert it to PNG");
  }
  return image;
}

// The first image of a list, which stands for the others.
void check_first(const fs::path& image) {
  files::refuse_unread(image);
  images::refuse_turned(image);
}

// The images whose number the others do not have; none if an image has no number.
std::vector<fs::path> without_partner(const std::vector<fs::path>& images,
                                      const std::vector<fs::path>& others) {
  std::set<std::string> numbers;
  for (const fs::path& other : others) numbers.insert(files::last_number(other));
  std::vector<fs::path> alone;
  for (const fs::path& image : images) {
    const std::string number = files::last_number(image);
    if (number.empty()) return {};
    if (!numbers.contains(number)) alone.push_back(image);
  }
  return alone;
}

[[noreturn]] void refuse_counts(const SourceOptions& options, const std::vector<fs::path>& left,
                                const std::vector<fs::path>& right) {
  std::vector<fs::path> alone = without_partner(left, right);
  if (alone.empty()) alone = without_partner(right, left);
  throw UserError(options.left + " has " + outputs::counted(left.size(), "image") + ", but " +
                  options.right + " has " + std::to_string(right.size()) +
                  ": they are paired in order" +
                  (alone.empty() ? "" : "; " + alone[0].string() + " has no partner"));
}

// In lists of one length, an image may be missing on each side. If most numbers are those of both
// sides, images show it whose partner is at another place. Two without partners may be of one
// moment, as their numbers may be times in seconds.
void check_numbers(const std::vector<fs::path>& left, const std::vector<fs::path>& right) {
  const std::vector<fs::path> alone = without_partner(left, right);
  const std::vector<fs::path> other = without_partner(right, left);
  if (alone.empty() || other.empty() || 2 * alone.size() >= left.size()) return;
  const auto has = [](const std::vector<fs::path>& list, const fs::path& image) {
    return std::find(list.begin(), list.end(), image) != list.end();
  };
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (files::last_number(left[i]) == files::last_number(right[i])) continue;
    if (has(alone, left[i]) && has(other, right[i])) continue;
    throw UserError(alone[0].string() + " and " + other[0].string() +
                    " have no partner with their number, but images are paired in order: remove "
                    "both, or give images of one moment the same number");
  }
}

bool is_line(const std::string& source) {
  return source.find('!') != std::string::npos || source.find("://") != std::string::npos;
}

// Names of elements have no dot and no slash.
void check_exists(const std::string& source) {
  if (is_line(source) || source.starts_with("/dev/")) return;
  if (files::is_pattern(source)) {
    const std::string unread = files::first_unread(files::files_of_pattern(source));
    if (!unread.empty()) throw UserError(unread);
    return;
  }
  const fs::file_status status = fs::status(source);
  if (!fs::exists(status)) {
    const bool is_name = source.find_first_of("./") != std::string::npos;
    if (!is_name || source.find(' ') != std::string::npos) return;
    throw UserError(source + ": no such file or folder");
  }
  files::refuse_unread(source);
  if (fs::is_regular_file(status) || fs::is_directory(status)) return;
  throw UserError(source + ": is a pipe or a device, which may never end: record it first");
}

class ImageSource : public PairSource {
 public:
  explicit ImageSource(const SourceOptions& options)
      : arrangement_(options.arrangement), left_(list_images(options.left)) {
    if (arrangement_ != Arrangement::kTwoSources) return;
    right_ = list_images(options.right);
    if (left_.size() != right_.size()) refuse_counts(options, left_, right_);
    check_numbers(left_, right_);
  }

  SourceState next(ImagePair& pair) override {
    if (index_ == left_.size()) return SourceState::kEnd;
    pair.time = static_cast<double>(index_);
    pair.name = left_[index_].filename().string();
    if (index_ == 0) check_first(left_[0]);
    if (arrangement_ == Arrangement::kTwoSources) {
      if (index_ == 0) check_first(right_[0]);
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

bool is_images(const std::string& source) {
  if (is_line(source)) return false;
  return fs::is_directory(source) || files::is_image(source);
}

void split(const cv::Mat& image, Arrangement arrangement, ImagePair& pair) {
  const bool across = arrangement == Arrangement::kSideBySide;
  const int extent = across ? image.cols : image.rows;
  if (extent % 2 != 0) {
    throw UserError("images of " + std::to_string(image.cols) + "x" + std::to_string(image.rows) +
                    " cannot be halved: write the views to two folders, or cut off a pixel");
  }
  const int half = extent / 2;
  pair.left = across ? image.colRange(0, half) : image.rowRange(0, half);
  pair.right = across ? image.colRange(half, extent) : image.rowRange(half, extent);
  pair.left = pair.left.clone();
  pair.right = pair.right.clone();
}

std::unique_ptr<PairSource> open_images(const SourceOptions& options) {
  return std::make_unique<ImageSource>(options);
}

std::vector<fs::path> input_files(const SourceOptions& options) {
  std::vector<fs::path> files;
  for (const std::string& source : {options.left, options.right}) {
    if (source.empty()) continue;
    check_exists(source);
    const std::vector<fs::path> images =
        is_images(source) ? list_images(source) : std::vector<fs::path>{source};
    files.insert(files.end(), images.begin(), images.end());
  }
  return files;
}

std::unique_ptr<PairSource> open_source(const SourceOptions& options) {
  const bool two = options.arrangement == Arrangement::kTwoSources;
  const bool left = is_images(options.left);
  if (two && left != is_images(options.right)) {
    throw UserError("one source gives images and the other one video: " + options.left + ", " +
                    options.right);
  }
  return left ? open_images(options) : open_streams(options);
}

}  // namespace mtstereo::calibrate
