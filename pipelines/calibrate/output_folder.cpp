// SPDX-License-Identifier: LGPL-2.1-or-later
#include "calibrate/output_folder.hpp"

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "calibrate/calibration_error.hpp"
#include "calibrate/pictures.hpp"

namespace mtstereo::calibrate {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLeft = "left";
constexpr const char* kRight = "right";
constexpr const char* kViews = "views";

fs::path numbered(std::size_t index, const char* extension) {
  const std::string number = std::to_string(index);
  return std::string(number.size() < 3 ? 3 - number.size() : 0, '0') + number + extension;
}

void write_image(const fs::path& file, const cv::Mat& image) {
  bool written = false;
  try {
    written = cv::imwrite(file.string(), image);
  } catch (const cv::Exception&) {
    written = false;
  }
  if (!written) throw CalibrationError(file.string() + ": cannot be written");
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder, bool overwrite) : folder_(std::move(folder)) {
  try {
    if (fs::exists(calibration()) && !overwrite) {
      throw CalibrationError(folder_.string() +
                             ": has a calibration; choose another folder by --out, or --overwrite");
    }
    fs::remove(calibration());
    for (const char* name : {kLeft, kRight, kViews}) {
      // Views of another calibration would be taken for those of this one.
      if (fs::exists(folder_ / name)) {
        for (const auto& entry : fs::directory_iterator(folder_ / name)) {
          const std::string extension = entry.path().extension().string();
          if (extension == ".png" || extension == ".jpg") fs::remove(entry.path());
        }
      }
      fs::create_directories(folder_ / name);
    }
  } catch (const fs::filesystem_error& error) {
    throw CalibrationError(error.path1().string() + ": " + error.code().message());
  }
}

void OutputFolder::write_view(std::size_t index, const ImagePair& images,
                              const CornerPair& corners) const {
  write_image(folder_ / kLeft / numbered(index, ".png"), images.left);
  write_image(folder_ / kRight / numbered(index, ".png"), images.right);
  write_image(folder_ / kViews / numbered(index, ".jpg"), draw_views(images, corners));
}

cv::Mat OutputFolder::view(std::size_t index, bool left) const {
  const fs::path file = folder_ / (left ? kLeft : kRight) / numbered(index, ".png");
  return cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
}

void OutputFolder::swap_sides() const {
  try {
    const fs::path aside = folder_ / "left.swapping";
    fs::rename(folder_ / kLeft, aside);
    fs::rename(folder_ / kRight, folder_ / kLeft);
    fs::rename(aside, folder_ / kRight);
  } catch (const fs::filesystem_error& error) {
    throw CalibrationError(error.path1().string() + ": " + error.code().message());
  }
}

void OutputFolder::write_picture(const std::string& name, const cv::Mat& picture) const {
  if (!picture.empty()) write_image(folder_ / name, picture);
}

void OutputFolder::write_text(const std::string& name, const std::string& text) const {
  std::ofstream out(folder_ / name, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw CalibrationError((folder_ / name).string() + ": cannot be written");
}

}  // namespace mtstereo::calibrate
