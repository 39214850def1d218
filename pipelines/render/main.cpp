// SPDX-License-Identifier: LGPL-2.1-or-later
// mtstereo-render: writes a rendered stereo clip with its exact ground truth.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <new>
#include <string>

#include "render/clip_writer.hpp"
#include "render/render.hpp"

namespace {

using namespace mtstereo::render;

struct Options {
  std::string folder;
  std::string scene = "street";
  std::string size = "640x360";
  int frames = 48;
  double rate = 24;
  double start = 0;
  Layout layout = Layout::kClip;
  bool overwrite = false;
  bool gray = false;
  bool lights = false;
  Settings settings;
};

void define(CLI::App& app, Options& o) {
  app.add_option("folder", o.folder, "output folder; created if missing")->required();
  app.add_option("--scene", o.scene, "street, garden or room")->capture_default_str();
  app.add_option("--size", o.size, "width and height of a view [px]")->capture_default_str();
  app.add_option("--frames", o.frames, "number of frames")
      ->check(CLI::Range(1, 999999))
      ->capture_default_str();
  app.add_option("--rate", o.rate, "frames per second of scene time")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  app.add_option("--start", o.start, "scene time of the first frame [s]")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  app.add_option("--seed", o.settings.seed,
                 "seed of the noise, the textures and the positions of small objects")
      ->capture_default_str();
  app.add_option("--baseline", o.settings.baseline,
                 "distance between the cameras [m]; 0 = the scene's default")
      ->capture_default_str();
  app.add_option("--focal", o.settings.focal, "focal length [px]; 0 = 0.85 times the width")
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
  app.add_flag("--overwrite", o.overwrite, "replace an existing clip in the folder");
  app.add_flag("--lights", o.lights, "sun, lamps, and ground that reflects them");
  app.add_flag("--gray", o.gray, "gray images instead of color");
}

void define_sensor(CLI::App& app, Settings& s) {
  const auto number = [&app](const char* name, auto& value, const char* help) {
    app.add_option(name, value, help)->capture_default_str();
  };
  number("--noise", s.noise, "standard deviation of the constant sensor noise [gray values]");
  number("--shot-noise", s.shot_noise, "variance of the shot noise per gray value of the signal");
  number("--light", s.light, "light of both views; what exceeds white is clipped");
  number("--gain", s.gain, "amplification of signal and noise in both views");
  number("--exposure", s.exposure, "brightness of the right view relative to the left");
  number("--sky", s.sky, "brightness of the sky at the bottom of the image; 1 = white");
  number("--sky-gradient", s.sky_gradient,
         "what the sky loses up to the top of the image; 0 = a flat sky");
  number("--vignette", s.vignette, "fraction of the light that is lost in the corners");
  number("--jpeg", s.jpeg, "quality of JPEG compression, 1 to 100; 0 = no compression");
}

void define_rig(CLI::App& app, Rig& rig) {
  const auto number = [&app](const char* name, double& value, const char* help) {
    app.add_option(name, value, help)->capture_default_str();
  };
  number("--roll", rig.roll, "error of the right camera: roll, clockwise [degrees]");
  number("--pitch", rig.pitch, "error of the right camera: pitch, downwards [degrees]");
  number("--yaw", rig.yaw, "error of the right camera: yaw, to the right [degrees]");
  number("--focal-ratio", rig.focal_ratio, "focal length of the right camera / of the left");
  number("--row-offset", rig.row_offset, "error of the right image: lower by this [px]");
}

void parse_size(const std::string& text, Settings& settings) {
  int used = 0;
  const int found =
      std::sscanf(text.c_str(), "%5dx%5d%n", &settings.width, &settings.height, &used);
  if (found != 2 || used != static_cast<int>(text.size())) {
    throw std::invalid_argument("--size is '" + text + "'; expected WIDTHxHEIGHT, such as 640x360");
  }
}

int run(Options& o) {
  parse_size(o.size, o.settings);
  o.settings.color = !o.gray;
  if (const std::string wrong = check(o.settings); !wrong.empty()) {
    throw std::invalid_argument(wrong);
  }
  const Scene scene = make_scene(o.scene, o.settings.seed, o.lights);
  const Settings settings = complete(scene, o.settings);
  ClipWriter writer(o.folder, o.layout, o.overwrite);
  const bool terminal = isatty(STDERR_FILENO) != 0;
  for (int i = 0; i < o.frames; ++i) {
    writer.write(i, render(scene, o.start + i / o.rate, settings), rectification_of(settings));
    if (terminal) std::fprintf(stderr, "\rframe %d of %d", i + 1, o.frames);
  }
  if (terminal) std::fputc('\n', stderr);
  writer.finish(rectification_of(settings));
  std::cout << o.folder << ": " << o.frames << " frames of " << settings.width << "x"
            << settings.height << ", focal length " << settings.focal << " px, baseline "
            << settings.baseline << " m, disparities below " << writer.disparities() << " px\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app("Renders a stereo clip with exact ground truth.", "mtstereo-render");
    Options options;
    define(app, options);
    define_sensor(app, options.settings);
    define_rig(app, options.settings.rig);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? 0 : 2;
    }
    return run(options);
  } catch (const std::invalid_argument& error) {
    std::cerr << "mtstereo-render: " << error.what() << '\n';
    return 2;
  } catch (const std::bad_alloc&) {
    std::cerr << "mtstereo-render: out of memory for this size\n";
  } catch (const std::exception& error) {
    std::cerr << "mtstereo-render: " << error.what() << '\n';
  } catch (...) {
    std::cerr << "mtstereo-render: unknown error\n";
  }
  return 1;
}
