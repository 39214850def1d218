// SPDX-License-Identifier: LGPL-2.1-or-later
#include "options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "lib/options/finite_range.hpp"
#include "lib/options/two_numbers.hpp"

namespace mtstereo::render {
namespace {

void define_clip(CLI::App& app, Options& o) {
  app.add_option("folder", o.folder, "output folder; created if missing")->required();
  app.add_option("--scene", o.scene, "street, garden, room or board")->capture_default_str();
  app.add_option("--size", o.size, "width and height of a view [px]")->capture_default_str();
  app.add_option("--frames", o.frames, "number of frames; board: that of all poses, others: 48")
      ->check(CLI::Range(1, 999999));
  app.add_option("--rate", o.rate, "frames per second of scene time")
      ->check(options::finite_range(0.1, 1000))
      ->capture_default_str();
  app.add_option("--start", o.start, "scene time of the first frame [s]")
      ->check(options::finite_range(0, 3600))
      ->capture_default_str();
  app.add_option("--seed", o.settings.seed,
                 "seed of the noise, the textures and the positions of small objects")
      ->capture_default_str();
  app.add_option("--baseline", o.settings.baseline,
                 "distance between the cameras [m]; 0 = the scene's default")
      ->check(options::finite())
      ->capture_default_str();
  app.add_option("--focal", o.settings.focal, "focal length [px]; 0 = 0.85 times the width")
      ->check(options::finite())
      ->capture_default_str();
  app.add_option("--samples", o.settings.samples, "samples x samples rays per pixel")
      ->capture_default_str();
  app.add_option("--threads", o.settings.threads, "number of threads; 0 = one per processor")
      ->capture_default_str();
  const std::map<std::string, Layout> layouts = {{"clip", Layout::kClip},
                                                 {"middlebury", Layout::kMiddlebury}};
  app.add_option("--layout", o.layout,
                 "clip: left/ right/ truth/ mask/ calib.txt; middlebury: one folder per frame")
      ->transform(CLI::CheckedTransformer(layouts, CLI::ignore_case))
      ->default_str("clip");
  app.add_flag("--depth", o.depth, "also write the true depths to depth/ (PFM) [m]");
  app.add_flag("--overwrite", o.overwrite, "replace an existing clip in the folder");
  app.add_flag("--gray", o.gray, "gray images instead of color");
}

void define_sensor(CLI::App& app, Settings& s) {
  const auto number = [&app](const char* name, auto& value, const char* help) {
    app.add_option(name, value, help)->check(options::finite())->capture_default_str();
  };
  number("--noise", s.noise, "standard deviation of the constant sensor noise [gray values]");
  number("--shot-noise", s.shot_noise, "variance of the shot noise per gray value of the signal");
  number("--light", s.light, "light of both views; values above white are clipped");
  number("--gain", s.gain, "amplification of signal and noise in both views");
  number("--exposure", s.exposure, "brightness of the right view relative to the left");
  number("--vignette", s.vignette, "fraction of the light that is lost in the corners");
  number("--blur", s.blur, "standard deviation of the blur of the lenses in the center [px]");
  number("--rim-blur", s.rim_blur, "additional blur of the lenses in the corners [px]");
  app.add_flag("--mosaic", s.mosaic,
               "sensors with a Bayer mosaic: demosaicing, noise reduction and sharpening");
  number("--jpeg", s.jpeg, "quality of JPEG compression, 1 to 100; 0 = no compression");
}

void define_rig(CLI::App& app, Options& o) {
  const auto number = [&app](const char* name, double& value, const char* help) {
    app.add_option(name, value, help)->check(options::finite())->capture_default_str();
  };
  Rig& rig = o.settings.rig;
  number("--roll", rig.roll, "error of the right camera: roll, clockwise [degrees]");
  number("--pitch", rig.pitch, "error of the right camera: pitch, downwards [degrees]");
  number("--yaw", rig.yaw, "error of the right camera: yaw, to the right [degrees]");
  number("--focal-ratio", rig.focal_ratio, "focal length of the right camera / of the left");
  number("--row-offset", rig.row_offset, "error of the right image: lower by this [px]");
  app.add_option(
      "--lens", o.lens,
      "built-in raw cameras with distortion and rotation: wide, or fisheye (120 degrees)");
  app.add_option("--raw", o.raw, "raw cameras of this calibration file");
  app.add_option("--rectification", o.rectification,
                 "raw cameras: rectify the truth by this calibration, such as one of mtcalibrate, "
                 "instead of the exact one");
  number("--alpha", o.alpha, "of that rectification, as for mtrectify: 0 to 1, or -1");
  app.add_option("--rectified-size", o.rectified_size,
                 "width and height of the views of that rectified pair [px]");
}

void define_scenes(CLI::App& app, Options& o) {
  const auto number = [&app](const char* name, auto& value, const char* help) {
    app.add_option(name, value, help)->check(options::finite())->capture_default_str();
  };
  app.add_option("--squares", o.board.squares, "board: columns and rows of the checkerboard")
      ->capture_default_str();
  number("--square", o.board.square, "board: edge of a square [m]");
  app.add_option("--picture", o.board.image, "board: image that replaces the checkerboard");
  number("--picture-width", o.board.image_width, "board: width of that image [m]");
  number("--poses", o.board.poses.count, "board: number of poses");
  number("--rest", o.board.rest, "board: frames at each pose");
  number("--move", o.board.move, "board: frames between two poses");
  number("--tilt", o.board.poses.tilt, "board: largest tilt [degrees]");
  number("--visible", o.board.poses.visible, "board: smallest part that both views show");
}

void require(bool valid, const char* sentence) {
  if (!valid) throw std::invalid_argument(sentence);
}

void check_scene(const std::string& name) {
  std::vector<std::string> names = scene_names();
  names.emplace_back("board");
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  std::string known;
  for (const auto& n : names) known += (known.empty() ? "" : ", ") + n;
  throw std::invalid_argument("there is no scene '" + name + "'; the scenes are " + known);
}

void check_board(const BoardOptions& b) {
  const auto between = [](double value, double low, double high) {
    return value >= low && value <= high;
  };
  require(between(b.square, 0.001, 10), "square must be 0.001 to 10 m");
  require(b.image.empty() || between(b.image_width, 0.001, 100),
          "picture needs picture-width, 0.001 to 100 m");
  require(between(b.poses.count, 1, 100000), "poses must be 1 to 100000");
  require(between(b.rest, 1, 1000), "rest must be 1 to 1000 frames");
  require(between(b.move, 0, 1000), "move must be 0 to 1000 frames");
  require(between(b.poses.tilt, 0, 60), "tilt must be 0 to 60 degrees");
  require(between(b.poses.visible, 0.2, 1), "visible must be 0.2 to 1");
}

}  // namespace

void define_options(CLI::App& app, Options& o) {
  define_clip(app, o);
  define_sensor(app, o.settings);
  define_rig(app, o);
  define_scenes(app, o);
}

void complete_options(const CLI::App& app, Options& o) {
  check_scene(o.scene);
  o.has_size = app.count("--size") > 0;
  std::tie(o.settings.width, o.settings.height) = parse_pair("--size", o.size, "640x360");
  o.settings.color = !o.gray;
  if (const std::string wrong = check(o.settings); !wrong.empty()) {
    throw std::invalid_argument(wrong);
  }
  require(o.raw.empty() || o.lens.empty(), "raw and lens cannot be combined");
  if (o.has_raw_cameras()) {
    require(o.settings.rig.aligned(),
            "roll, pitch, yaw, focal-ratio and row-offset cannot be combined with raw or lens");
    require(o.settings.focal == 0, "focal cannot be combined with raw or lens");
  }
  require(o.rectification.empty() || o.has_raw_cameras(), "rectification needs raw or lens");
  require(!o.rectification.empty() || (o.alpha == 0 && o.rectified_size.empty()),
          "alpha and rectified-size need rectification");
  require(!o.depth || (o.layout == Layout::kClip && o.scene != "board"),
          "depth needs the layout clip, and another scene than board");
  require(o.raw.empty() || o.settings.baseline == 0, "baseline cannot be combined with raw");
  if (o.scene == "board") {
    check_board(o.board);
    o.board.poses.seed = o.settings.seed;
    require(o.layout == Layout::kClip, "layout must be clip for the scene board");
    o.layout = Layout::kViews;
  }
}

std::pair<int, int> parse_pair(const std::string& option, const std::string& text,
                               const char* example) {
  if (const auto pair = options::two_numbers(text)) return *pair;
  throw std::invalid_argument(option + " is '" + text + "'; expected two numbers, such as " +
                              example);
}

}  // namespace mtstereo::render
