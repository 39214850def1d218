// SPDX-License-Identifier: LGPL-2.1-or-later
// mtstereo-compare: compares recorded disparity maps with the ground truth of their clip, and
// makes an image of one frame.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "lib/images/images.hpp"
#include "lib/options/parse.hpp"
#include "lib/outputs/standard_output.hpp"
#include "tools/compare/compare_depth.hpp"
#include "tools/compare/frame_files.hpp"
#include "tools/eval/ground_truth.hpp"
#include "tools/eval/images.hpp"
#include "tools/eval/metrics.hpp"

namespace {

namespace fs = std::filesystem;
using namespace mtstereo::eval;
using mtstereo::apps::by_name;
using mtstereo::apps::partner;

struct Options {
  fs::path disparity, truth, mask, left, image, depth, true_depth;
  std::string label = "clip";
  int frame = 0;
  int width = 0;
  int max_disparity = 64;
};

void define(CLI::App& app, Options& o) {
  app.add_option("--disparity", o.disparity,
                 "folder of 16-bit PNG images: px = value / 256, 0 = unknown");
  app.add_option("--truth", o.truth, "folder of PFM files with the same names: the ground truth");
  app.add_option("--mask", o.mask, "folder of masks: 255 = visible in both views, 128 = occluded");
  app.add_option("--depth", o.depth,
                 "folder of 16-bit PNG depth images: mm, 0 = unknown; compared in meters");
  app.add_option("--true-depth", o.true_depth,
                 "folder of PFM files with the same names: the true depths [m]");
  app.add_option("--label", o.label, "text of the first column")->capture_default_str();
  app.add_option("--picture", o.image, "PNG to write: left image, disparity, ground truth");
  app.add_option("--left", o.left, "folder of left images, or one image, for --picture");
  app.add_option("--frame", o.frame, "frame shown by --picture, counted from 0")
      ->check(CLI::Range(0, 999999))
      ->capture_default_str();
  app.add_option("--width", o.width, "scale --picture down to this width [px]; 0 = original size")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  app.add_option("--max-disparity", o.max_disparity,
                 "upper end of the color range of the image [px]")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

struct ClipEvaluation {
  std::size_t frames = 0;
  Evaluation mean;
};

ClipEvaluation evaluate_clip(const Options& o) {
  const auto disparities = by_name(o.disparity, ".png");
  const auto truths = by_name(o.truth, ".pfm");
  std::map<std::string, fs::path> masks;
  if (!o.mask.empty()) masks = by_name(o.mask, ".png");
  // A lost frame would shift all later frames, so it is an error.
  for (const auto& [name, file] : truths) partner(disparities, o.disparity, name);

  std::vector<Evaluation> frames;
  for (const auto& [name, file] : disparities) {
    const cv::Mat estimate = read_png_disparity(file);
    const fs::path& truth_file = partner(truths, o.truth, name);
    GroundTruth truth{read_pfm_disparity(truth_file), cv::Mat()};
    require_size(truth_file, truth.disparity, estimate.size());
    if (!masks.empty()) {
      const fs::path& mask_file = partner(masks, o.mask, name);
      truth.visible = read_visible_mask(mask_file);
      require_size(mask_file, truth.visible, estimate.size());
    }
    frames.push_back(evaluate(estimate, truth));
  }
  std::vector<WeightedEvaluation> weighted;
  for (const Evaluation& frame : frames) weighted.push_back({&frame, 1});
  return {frames.size(), mean(weighted)};
}

void print(const std::string& label, const ClipEvaluation& evaluated) {
  const Evaluation& clip = evaluated.mean;
  std::printf("%-12s %6zu", label.c_str(), evaluated.frames);
  std::printf(" %10.3f %9.2f %10.2f", clip.all.avgerr, clip.all.d_all, clip.density);
  if (clip.noc) std::printf(" %14.3f %13.2f", clip.noc->avgerr, clip.noc->d_all);
  std::printf("\n");
}

cv::Mat labeled(const cv::Mat& image, const std::string& text) {
  cv::Mat out = image.clone();
  // Bright text over a dark outline: readable on any background.
  const double size = std::max(0.35, image.rows / 500.0);
  const cv::Point at(image.cols / 60 + 2, image.rows - image.rows / 30 - 2);
  cv::putText(out, text, at, cv::FONT_HERSHEY_SIMPLEX, size, {0, 0, 0}, 3, cv::LINE_AA);
  cv::putText(out, text, at, cv::FONT_HERSHEY_SIMPLEX, size, {255, 255, 255}, 1, cv::LINE_AA);
  return out;
}

const fs::path& nth(const std::map<std::string, fs::path>& files, const fs::path& folder, int n) {
  if (n >= static_cast<int>(files.size())) {
    throw std::runtime_error(folder.string() + ": frame " + std::to_string(n) +
                             " was requested, but there are only " + std::to_string(files.size()));
  }
  return std::next(files.begin(), n)->second;
}

void write_montage(const Options& o) {
  const fs::path disparity_file = nth(by_name(o.disparity, ".png"), o.disparity, o.frame);
  const cv::Mat disparity = read_png_disparity(disparity_file);
  std::vector<cv::Mat> row;
  if (!o.left.empty()) {
    const fs::path file =
        fs::is_directory(o.left) ? nth(by_name(o.left, ".png"), o.left, o.frame) : o.left;
    const cv::Mat left = mtstereo::images::read(file, cv::IMREAD_COLOR);
    if (left.empty()) throw std::runtime_error(file.string() + ": cannot be read as an image");
    require_size(file, left, disparity.size());
    row.push_back(labeled(left, "left"));
  }
  row.push_back(labeled(color_disparity(disparity, o.max_disparity), "disparity"));
  if (!o.truth.empty()) {
    const fs::path file = nth(by_name(o.truth, ".pfm"), o.truth, o.frame);
    const cv::Mat truth = read_pfm_disparity(file);
    require_size(file, truth, disparity.size());
    row.push_back(labeled(color_disparity(truth, o.max_disparity), "ground truth"));
  }
  cv::Mat montage;
  cv::hconcat(row, montage);
  if (o.width > 0 && o.width < montage.cols) {
    const double factor = static_cast<double>(o.width) / montage.cols;
    cv::resize(montage, montage, cv::Size(), factor, factor, cv::INTER_AREA);
  }
  write_image(o.image, montage);
}

int run(const Options& o) {
  if (o.depth.empty() != o.true_depth.empty()) {
    std::cerr << "mtstereo-compare: --depth and --true-depth need each other\n";
    return 2;
  }
  const bool of_disparity = !o.truth.empty() || !o.image.empty();
  if (o.disparity.empty() ? of_disparity || o.depth.empty() : !of_disparity) {
    std::cerr << "mtstereo-compare: nothing to do: --disparity needs --truth, --picture or both, "
                 "and --depth needs --true-depth\n";
    return 2;
  }
  if (!o.depth.empty()) mtstereo::apps::print_depth_errors(o.depth, o.true_depth);
  if (!o.truth.empty()) print(o.label, evaluate_clip(o));
  if (!o.image.empty()) write_montage(o);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app("Compares recorded disparity with ground truth.", "mtstereo-compare");
    app.footer(
        "Columns: label, frames, then over all pixels avgerr [px], D-all [%], density [%],\n"
        "then, with --mask, avgerr and D-all over the pixels that are visible in both views.");
    Options options;
    define(app, options);
    const auto ended = mtstereo::options::parse(app, argc, argv, [] {});
    const int status = ended ? *ended : run(options);
    mtstereo::outputs::finish_standard_output();
    return status;
  } catch (const std::exception& error) {
    std::cerr << "mtstereo-compare: " << error.what() << '\n';
  } catch (...) {
    std::cerr << "mtstereo-compare: unknown error\n";
  }
  return 1;
}
