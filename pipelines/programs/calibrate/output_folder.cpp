// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/output_folder.hpp"

#include <utility>

#include "lib/images/images.hpp"
#include "lib/outputs/user_error.hpp"
#include "programs/calibrate/drawings.hpp"

namespace mtstereo::calibrate {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLeft = "left";
constexpr const char* kRight = "right";
constexpr const char* kViews = "views";

constexpr const char* kCalibration = "calibration.yml";

std::string numbered(const std::string& folder, std::size_t index, const char* extension) {
  const std::string number = std::to_string(index);
  return folder + "/" + std::string(number.size() < 3 ? 3 - number.size() : 0, '0') + number +
         extension;
}

std::string encoded(const std::string& name, const cv::Mat& image) {
  std::string bytes = images::encode(fs::path(name).extension().string(), image);
  if (bytes.empty()) throw UserError(name + ": cannot be encoded");
  return bytes;
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder, bool overwrite, const std::vector<fs::path>& inputs)
    : folder_(std::move(folder)), files_(folder_, "mtcalibrate") {
  std::error_code error;
  if (!overwrite && fs::exists(folder_ / kCalibration, error)) {
    throw UserError(folder_.string() +
                    ": has a calibration; choose another folder by --out, or --overwrite");
  }
  files_.check({kCalibration, "report.json", "rectified.png", "coverage.png", "residuals.png",
                kLeft, kRight, kViews},
               outputs::FileSet(inputs));
}

void OutputFolder::write_view(std::size_t index, const ImagePair& images,
                              const CornerPair& corners) {
  // Views of another calibration would be taken for those of this one.
  if (views_ == 0) files_.clear();
  const auto write = [this](const std::string& name, const cv::Mat& image) {
    files_.write(name, encoded(name, image));
  };
  write(numbered(kLeft, index, ".png"), images.left);
  write(numbered(kRight, index, ".png"), images.right);
  write(numbered(kViews, index, ".jpg"), draw_views(images, corners));
  ++views_;
}

cv::Mat OutputFolder::view(std::size_t index, bool left) const {
  const fs::path file = folder_ / numbered(left ? kLeft : kRight, index, ".png");
  return images::read(file, cv::IMREAD_GRAYSCALE);
}

void OutputFolder::swap_sides() {
  files_.exchange(kLeft, kRight);
  try {
    const fs::path aside = folder_ / "left.swapping";
    fs::rename(folder_ / kLeft, aside);
    fs::rename(folder_ / kRight, folder_ / kLeft);
    fs::rename(aside, folder_ / kRight);
  } catch (const fs::filesystem_error& error) {
    throw UserError(error.path1().string() + ": " + error.code().message());
  }
}

void OutputFolder::write_image(const std::string& name, const cv::Mat& image) {
  if (!image.empty()) files_.write(name, encoded(name, image));
}

void OutputFolder::write_text(const std::string& name, const std::string& text) {
  files_.write(name, text);
}

fs::path OutputFolder::calibration() { return files_.listed(kCalibration); }

}  // namespace mtstereo::calibrate
