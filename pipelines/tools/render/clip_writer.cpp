// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/clip_writer.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "lib/images/images.hpp"
#include "lib/outputs/pfm_bytes.hpp"
#include "lib/outputs/texts.hpp"
#include "lib/outputs/write_file.hpp"

namespace mtstereo::render {
namespace {

namespace fs = std::filesystem;

std::string numbered(int number, const char* ending) {
  return outputs::format("%06d%s", number, ending);
}

[[noreturn]] void cannot(const char* what, const fs::path& path, const std::string& reason) {
  throw std::runtime_error(std::string("cannot ") + what + " " + path.string() + ": " + reason);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) cannot("create the folder", folder, error.message());
}

cv::Mat mask_of(const StereoFrame& frame) {
  cv::Mat mask(frame.truth.size(), CV_8UC1);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const bool known = std::isfinite(frame.truth.at<float>(y, x));
      const bool occluded = frame.occluded.at<std::uint8_t>(y, x) != 0;
      mask.at<std::uint8_t>(y, x) = !known ? 0 : occluded ? 128 : 255;
    }
  }
  return mask;
}

// Infinity where the ray hits nothing.
cv::Mat depth_of(const StereoFrame& frame, const Rectification& r) {
  cv::Mat depth(frame.truth.size(), CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double disparity = frame.truth.at<float>(y, x) + r.principal_offset();
      const double z = r.focal_length * r.baseline / disparity;
      depth.at<float>(y, x) = std::isfinite(disparity) ? static_cast<float>(z) : INFINITY;
    }
  }
  return depth;
}

double largest_disparity(const cv::Mat& truth) {
  double largest = 0;
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      const float d = truth.at<float>(y, x);
      if (std::isfinite(d)) largest = std::max(largest, static_cast<double>(d));
    }
  }
  return largest;
}

// Rounds up to a multiple of 16, with a margin for disparities that are slightly too large.
int range_for(double largest) { return (static_cast<int>(std::ceil(largest)) + 1 + 15) / 16 * 16; }

fs::path checked_folder(const fs::path& folder, bool overwrite) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status)) return folder;
  if (!fs::is_directory(status)) cannot("write into", folder, "it is not a folder");
  const bool empty = fs::is_empty(folder, error);
  if (error) cannot("write into", folder, error.message());
  if (!empty && !overwrite) {
    cannot("write into", folder, "it is not empty; choose another folder or add --overwrite");
  }
  return folder;
}

std::string pfm_of(const cv::Mat& image) {
  if (image.type() != CV_32FC1) throw std::runtime_error("a PFM holds one float per pixel");
  return outputs::pfm_bytes(image.cols, image.rows,
                            [&](int x, int y) { return image.at<float>(y, x); });
}

}  // namespace

void write_pfm(const fs::path& file, const cv::Mat& image) {
  outputs::write_file(file, pfm_of(image));
}

void write_poses(const fs::path& file, const std::vector<FramePose>& poses) {
  std::ostringstream text;
  text.precision(12);
  text << "# frame at-rest rx ry rz tx ty tz\n"
          "# From the board to the left camera: rotation vector [rad], center of the board [m]\n";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::AngleAxisd turn(poses[i].pose.linear());
    text << i << ' ' << (poses[i].rests ? 1 : 0);
    for (const double v : Eigen::Vector3d(turn.angle() * turn.axis())) text << ' ' << v;
    for (const double v : poses[i].pose.translation()) text << ' ' << v;
    text << '\n';
  }
  outputs::write_file(file, text.str());
}

ClipWriter::ClipWriter(fs::path folder, Layout layout, bool overwrite, bool with_depth,
                       const std::vector<fs::path>& inputs)
    : layout_(layout),
      with_depth_(with_depth),
      files_(checked_folder(folder, overwrite), "mtstereo-render") {
  std::vector<std::string> folders{"left", "right"};
  if (layout_ != Layout::kViews) folders.insert(folders.end(), {"truth", "mask"});
  if (with_depth_) folders.emplace_back("depth");
  if (layout_ == Layout::kMiddlebury) folders.clear();
  std::vector<std::string> targets = folders;
  targets.insert(targets.end(), {"calib.txt", "poses.txt", "truth-calibration.yml"});
  files_.check(targets, outputs::FileSet(inputs));
  files_.clear();
  for (const std::string& name : folders) make_folder(folder / name);
}

void ClipWriter::write_png(const std::string& name, const cv::Mat& image) {
  // Encoded in memory, so that a full disk is detected: OpenCV's own writer does not report it.
  const std::string bytes = images::encode(".png", image, {cv::IMWRITE_PNG_COMPRESSION, 1});
  if (bytes.empty()) cannot("encode", name, "OpenCV's PNG encoder failed");
  files_.write(name, bytes);
}

void ClipWriter::write(int number, const StereoFrame& frame, const Rectification& rectification) {
  if (layout_ == Layout::kViews) {
    write_png("left/" + numbered(number, ".png"), frame.left);
    write_png("right/" + numbered(number, ".png"), frame.right);
    return;
  }
  const double largest = largest_disparity(frame.truth);
  largest_ = std::max(largest_, largest);
  if (layout_ == Layout::kClip) {
    write_png("left/" + numbered(number, ".png"), frame.left);
    write_png("right/" + numbered(number, ".png"), frame.right);
    files_.write("truth/" + numbered(number, ".pfm"), pfm_of(frame.truth));
    write_png("mask/" + numbered(number, ".png"), mask_of(frame));
    if (with_depth_) {
      files_.write("depth/" + numbered(number, ".pfm"), pfm_of(depth_of(frame, rectification)));
    }
    return;
  }
  const std::string folder = numbered(number, "/");
  write_png(folder + "im0.png", frame.left);
  write_png(folder + "im1.png", frame.right);
  files_.write(folder + "disp0GT.pfm", pfm_of(frame.truth));
  write_png(folder + "mask0nocc.png", mask_of(frame));
  files_.write(folder + "calib.txt", calibration_text(rectification, range_for(largest)));
}

void ClipWriter::finish(const Rectification& rectification) {
  if (layout_ != Layout::kClip) return;  // in Middlebury's, each frame has its own calib.txt
  files_.write("calib.txt", calibration_text(rectification, disparities()));
}

int ClipWriter::disparities() const { return range_for(largest_); }

}  // namespace mtstereo::render
