// SPDX-License-Identifier: LGPL-2.1-or-later
// mtstereo-render: writes a rendered stereo clip with its exact ground truth.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lib/images/images.hpp"
#include "lib/options/parse.hpp"
#include "lib/outputs/printable.hpp"
#include "lib/outputs/standard_output.hpp"
#include "mtstereo/geometry/calibration.hpp"
#include "mtstereo/geometry/rectification.hpp"
#include "options.hpp"
#include "tools/render/board.hpp"
#include "tools/render/clip_writer.hpp"
#include "tools/render/raw.hpp"
#include "tools/render/render.hpp"

namespace {

using namespace mtstereo;
using namespace mtstereo::render;

template <typename T>
T value_of(Result<T> result) {
  if (!result) throw std::invalid_argument(result.error().message);
  return std::move(*result);
}

StereoCalibration read_raw(const Options& o) {
  const int width = o.has_size ? o.settings.width : 0;
  const int height = o.has_size ? o.settings.height : 0;
  StereoCalibration c = value_of(read_calibration(o.raw, width, height));
  if (o.has_size && (c.left.width != width || c.left.height != height)) {
    c = value_of(scale_calibration(c, width, height));
  }
  return c;
}

// The raw cameras with their rectification; none for the cameras of the settings alone.
std::optional<RawRig> rig_of(const Options& o, const Settings& settings) {
  if (!o.has_raw_cameras() && o.scene != "board") return std::nullopt;
  StereoCalibration c = !o.raw.empty()    ? read_raw(o)
                        : !o.lens.empty() ? built_in_rig(o.lens, settings)
                                          : calibration_of(settings);
  if (!c.rectification) c.rectification = value_of(rectify(c));
  return RawRig(c);
}

std::shared_ptr<const ImageTexture> image_of(const BoardOptions& board) {
  if (board.image.empty()) {
    const auto [columns, rows] = parse_pair("--squares", board.squares, "10x7");
    return std::make_shared<const ImageTexture>(checkerboard(columns, rows, board.square));
  }
  const cv::Mat image = images::read(board.image, cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw std::runtime_error("cannot read the image " + board.image);
  std::vector<std::uint8_t> pixels(image.begin<std::uint8_t>(), image.end<std::uint8_t>());
  return std::make_shared<const ImageTexture>(image.cols, image.rows, pixels,
                                              image.cols / board.image_width);
}

Scene board_scene(const Options& o, const RawRig& rig) {
  const auto image = image_of(o.board);
  const BoardTimes times{(o.board.rest - 1) / o.rate, (o.board.move + 1) / o.rate};
  return make_board(image, choose_poses(o.board.poses, image->width(), image->height(), rig), times,
                    o.settings.seed);
}

// The rectified pair that the truth shows.
Rectification truth_pair(const Options& o, const StereoCalibration& cameras) {
  if (o.rectification.empty()) return *cameras.rectification;
  const CameraCalibration& left = cameras.left;
  RectificationOptions options;
  options.alpha = o.alpha;
  if (!o.rectified_size.empty()) {
    std::tie(options.width, options.height) =
        parse_pair("--rectified-size", o.rectified_size, "640x360");
  }
  return value_of(
      rectify(value_of(read_calibration(o.rectification, left.width, left.height)), options));
}

StereoFrame raw_frame(const Scene& scene, double time, const Settings& settings, const RawRig& rig,
                      const Rectification* pair) {
  const RawFrame raw = render_raw(scene, time, settings, rig);
  if (pair == nullptr) return {raw.left, raw.right, {}, {}};
  const Truth truth = render_truth(scene, time, settings, *pair);
  return {raw.left, raw.right, truth.disparity, truth.occluded};
}

/// A clip while it is written.
class Clip {
 public:
  explicit Clip(const Options& o) : o_(o), is_board_(o.scene == "board") {
    if (!is_board_) scene_ = make_scene(o.scene, o.settings.seed);
    settings_ = complete(scene_, o.settings);
    rig_ = rig_of(o, settings_);
    if (is_board_) scene_ = board_scene(o, *rig_);
    rectification_ = rig_ ? truth_pair(o, rig_->calibration) : rectification_of(settings_);
  }

  void write() {
    ClipWriter writer(o_.folder, o_.layout, o_.overwrite, o_.depth,
                      {o_.raw, o_.rectification, o_.board.image});
    const bool terminal = isatty(STDERR_FILENO) != 0;
    for (int i = 0; i < frames(); ++i) {
      writer.write(i, frame(o_.start + i / o_.rate), rectification_);
      if (terminal) std::fprintf(stderr, "\rframe %d of %d", i + 1, frames());
    }
    if (terminal) std::fputc('\n', stderr);
    writer.finish(rectification_);
    write_truth(writer);
    print(writer.disparities());
  }

 private:
  int frames() const {
    const BoardOptions& board = o_.board;
    const int all = board.poses.count * (board.rest + board.move) - board.move;
    return o_.frames.value_or(is_board_ ? all : 48);
  }

  StereoFrame frame(double time) const {
    if (rig_) {
      return raw_frame(scene_, time, settings_, *rig_, is_board_ ? nullptr : &rectification_);
    }
    return render::render(scene_, time, settings_);
  }

  void write_truth(ClipWriter& writer) const {
    if (rig_) {
      StereoCalibration calibration = rig_->calibration;
      // Not that of the day, so that the same options give the same bytes.
      if (calibration.date.empty()) calibration.date = "2000-01-01";
      const Status written =
          write_calibration(calibration, writer.listed("truth-calibration.yml").string());
      if (!written) throw std::runtime_error(written.error().message);
    }
    if (!is_board_) return;
    const Path& path = *scene_.objects.back().motion.path;
    std::vector<FramePose> poses;
    for (int i = 0; i < frames(); ++i) {
      const double time = o_.start + i / o_.rate;
      poses.push_back({path.rests_at(time), path.at(time)});
    }
    write_poses(writer.listed("poses.txt"), poses);
  }

  void print(int disparities) const {
    const Rectification& r = rectification_;
    std::cout << o_.folder << ": " << frames() << " frames of ";
    if (rig_) {
      const CameraCalibration& left = rig_->calibration.left;
      std::cout << left.width << "x" << left.height << "; rectified: ";
    }
    std::cout << r.width << "x" << r.height << ", focal length " << r.focal_length
              << " px, baseline " << r.baseline << " m";
    if (!is_board_) std::cout << ", disparities below " << disparities << " px";
    std::cout << '\n';
  }

  const Options& o_;
  bool is_board_;
  Scene scene_;
  Settings settings_;
  std::optional<RawRig> rig_;
  Rectification rectification_;
};

}  // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app("Renders a stereo clip with exact ground truth.", "mtstereo-render");
    Options options;
    define_options(app, options);
    const auto ended = options::parse(app, argc, argv, [] {});
    if (!ended) {
      complete_options(app, options);
      Clip(options).write();
    }
    outputs::finish_standard_output();
    return ended.value_or(0);
  } catch (const std::invalid_argument& error) {
    std::cerr << "mtstereo-render: " << outputs::printable(error.what()) << '\n';
    return 2;
  } catch (const std::bad_alloc&) {
    std::cerr << "mtstereo-render: out of memory for this size\n";
  } catch (const std::exception& error) {
    std::cerr << "mtstereo-render: " << outputs::printable(error.what()) << '\n';
  } catch (...) {
    std::cerr << "mtstereo-render: unknown error\n";
  }
  return 1;
}
