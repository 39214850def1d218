// SPDX-License-Identifier: LGPL-2.1-or-later
#include "render/clip_writer.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace mtstereo::render {
namespace {

namespace fs = std::filesystem;

std::string numbered(int number, const char* ending) {
  char name[32];
  std::snprintf(name, sizeof name, "%06d%s", number, ending);
  return name;
}

[[noreturn]] void cannot(const char* what, const fs::path& path, const std::string& reason) {
  throw std::runtime_error(std::string("cannot ") + what + " " + path.string() + ": " + reason);
}

std::string reason_of(int error) { return std::generic_category().message(error); }

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) cannot("create the folder", folder, error.message());
}

void write_bytes(const fs::path& file, const char* data, std::size_t size) {
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out.write(data, static_cast<std::streamsize>(size));
  out.close();
  if (!out) cannot("write", file, reason_of(errno));
}

void write_png(const fs::path& file, const cv::Mat& image) {
  // Encoded in memory, so that a full disk is detected: OpenCV's own writer does not report it.
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1})) {
    cannot("encode", file, "OpenCV's PNG encoder failed");
  }
  write_bytes(file, reinterpret_cast<const char*>(bytes.data()), bytes.size());
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

bool all_digits(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(),
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

// Removes only the files of a clip, so that a wrong folder name does no other damage.
void remove_clip(const fs::path& folder) {
  for (const char* name : {"left", "right", "truth", "mask", "depth", "calib.txt", "poses.txt",
                           "truth-calibration.yml"}) {
    fs::remove_all(folder / name);
  }
  std::vector<fs::path> frames;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_frame = entry.is_directory() && all_digits(entry.path().filename().string()) &&
                          fs::exists(entry.path() / "disp0GT.pfm");
    if (is_frame) frames.push_back(entry.path());
  }
  for (const auto& frame : frames) fs::remove_all(frame);
}

}  // namespace

void write_pfm(const fs::path& file, const cv::Mat& image) {
  if (image.type() != CV_32FC1) throw std::runtime_error("a PFM holds one float per pixel");
  std::string data = "Pf\n" + std::to_string(image.cols) + " " + std::to_string(image.rows) +
                     "\n-1.0\n";               // a negative scale means little-endian
  for (int y = image.rows - 1; y >= 0; --y) {  // the bottom row comes first
    const auto* row = image.ptr<float>(y);
    for (int x = 0; x < image.cols; ++x) {
      const auto bits = std::bit_cast<std::uint32_t>(row[x]);
      for (int shift = 0; shift < 32; shift += 8) {
        data.push_back(static_cast<char>(bits >> shift & 0xff));
      }
    }
  }
  write_bytes(file, data.data(), data.size());
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
  const std::string bytes = text.str();
  write_bytes(file, bytes.data(), bytes.size());
}

ClipWriter::ClipWriter(fs::path folder, Layout layout, bool overwrite, bool with_depth)
    : folder_(std::move(folder)), layout_(layout), with_depth_(with_depth) {
  std::error_code error;
  if (fs::exists(folder_, error) && !fs::is_directory(folder_, error)) {
    cannot("write into", folder_, "it is not a folder");
  }
  make_folder(folder_);
  try {
    if (overwrite) {
      remove_clip(folder_);
    } else if (!fs::is_empty(folder_)) {
      cannot("write into", folder_, "it is not empty; choose another folder or add --overwrite");
    }
  } catch (const fs::filesystem_error& e) {
    cannot("write into", folder_, e.code().message());
  }
  if (layout_ == Layout::kMiddlebury) return;
  for (const char* name : {"left", "right"}) make_folder(folder_ / name);
  if (layout_ == Layout::kViews) return;
  for (const char* name : {"truth", "mask"}) make_folder(folder_ / name);
  if (with_depth_) make_folder(folder_ / "depth");
}

void ClipWriter::write(int number, const StereoFrame& frame, const Rectification& rectification) {
  if (layout_ == Layout::kViews) {
    write_png(folder_ / "left" / numbered(number, ".png"), frame.left);
    write_png(folder_ / "right" / numbered(number, ".png"), frame.right);
    return;
  }
  const double largest = largest_disparity(frame.truth);
  largest_ = std::max(largest_, largest);
  if (layout_ == Layout::kClip) {
    write_png(folder_ / "left" / numbered(number, ".png"), frame.left);
    write_png(folder_ / "right" / numbered(number, ".png"), frame.right);
    write_pfm(folder_ / "truth" / numbered(number, ".pfm"), frame.truth);
    write_png(folder_ / "mask" / numbered(number, ".png"), mask_of(frame));
    if (with_depth_) {
      write_pfm(folder_ / "depth" / numbered(number, ".pfm"), depth_of(frame, rectification));
    }
    return;
  }
  const fs::path folder = folder_ / numbered(number, "");
  make_folder(folder);
  write_png(folder / "im0.png", frame.left);
  write_png(folder / "im1.png", frame.right);
  write_pfm(folder / "disp0GT.pfm", frame.truth);
  write_png(folder / "mask0nocc.png", mask_of(frame));
  const std::string text = calibration_text(rectification, range_for(largest));
  write_bytes(folder / "calib.txt", text.data(), text.size());
}

void ClipWriter::finish(const Rectification& rectification) {
  if (layout_ != Layout::kClip) return;  // in Middlebury's, each frame has its own calib.txt
  const std::string text = calibration_text(rectification, disparities());
  write_bytes(folder_ / "calib.txt", text.data(), text.size());
}

int ClipWriter::disparities() const { return range_for(largest_); }

}  // namespace mtstereo::render
