// SPDX-License-Identifier: LGPL-2.1-or-later
// mtstereo-figures: the images of docs/method.md, the table of docs/parameters.md, and the
// steps for docs/architecture.md.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drawings.hpp"
#include "matcher/frame_matcher.hpp"
#include "mtstereo/mtstereo.hpp"
#include "stages/nodes/disparity_drawing.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/prepare/max_tree.hpp"
#include "tools/eval/flicker.hpp"
#include "tools/eval/images.hpp"
#include "tools/eval/metrics.hpp"
#include "tools/render/render.hpp"

namespace {

using namespace mtstereo;
namespace fs = std::filesystem;

constexpr int kDisparities = 40;

/// A frame of a scene.
render::StereoFrame frame_of(const char* scene, double time) {
  render::Settings settings;
  settings.width = 480;
  settings.height = 270;
  return render::render(render::make_scene(scene, 1), time, settings);
}

/// A frame of the demo's scene, a little smaller.
render::StereoFrame demo_frame() {
  render::StereoFrame frame = frame_of("street", 1.0);
  for (float& disparity : cv::Mat_<float>(frame.truth)) {
    if (std::isinf(disparity)) disparity = std::numeric_limits<float>::quiet_NaN();  // the sky
  }
  return frame;
}

GrayView view_of(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

Parameters parameters_of(std::string_view preset, std::string_view mode) {
  Parameters parameters;
  for (const Status& status : {parameters.set("preset", preset), parameters.set("mode", mode),
                               parameters.set(Parameter::kMaxDisparity, kDisparities)}) {
    if (!status) throw std::runtime_error(status.error().message);
  }
  return parameters;
}

FrameMatcher matcher_of(std::string_view preset, std::string_view mode) {
  return FrameMatcher(Settings(parameters_of(preset, mode)));
}

using Drawing = std::function<void(const FrameMemory& memory)>;

/// Matches the frame and draws after the steps that are named.
void match(FrameMatcher matcher, const render::StereoFrame& frame,
           const std::map<std::string_view, Drawing>& drawings) {
  std::size_t drawn = 0;
  matcher.compute(view_of(frame.left), view_of(frame.right),
                  [&](const Step& step, const FrameMemory& memory) {
                    const auto drawing = drawings.find(step.name);
                    if (drawing == drawings.end()) return;
                    drawing->second(memory);
                    ++drawn;
                  });
  if (drawn != drawings.size()) throw std::runtime_error("a step that is to be drawn did not run");
}

cv::Mat colored(const cv::Mat& disparity) { return eval::color_disparity(disparity, kDisparities); }

/// The disparity of least cost of every pixel on its own, from the cost volume alone.
cv::Mat cheapest_disparity(const CostVolume& volume, cv::Size size) {
  cv::Mat map(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      int least = std::numeric_limits<int>::max();
      for (int d = 0; d < std::min(kDisparities, x + 1); ++d) {
        if (volume.at(x, y, d) >= least) continue;
        least = volume.at(x, y, d);
        map.at<float>(y, x) = static_cast<float>(d);
      }
    }
  }
  return map;
}

/// The nodes of level 1, the parents.
NodeLevel parents(const MaxTrees& trees, const Settings& settings) {
  const WidthRange widths = {1.0 * settings.min_node_width, settings.max_node_width * trees.width};
  NodeLevel level;
  level.resize(trees.width, trees.height);
  select_nodes(trees, 1, widths, 0, trees.height, level);
  return level;
}

/// The map of the matched leaves.
cv::Mat matched_leaves(const Nodes& nodes) {
  const NodeLevelMatches& leaves = nodes.leaves();
  Image<std::int32_t> map;
  map.resize(leaves.left.width, leaves.left.height);
  draw_matches(leaves.left, leaves.matches, 0, leaves.left.height, map);
  return eval::to_float(map.view());
}

/// The maps after the steps of preset paper, and other drawings.
using Maps = std::map<std::string, cv::Mat>;

Maps maps_of_steps(const render::StereoFrame& frame, std::map<std::string_view, Drawing> drawings) {
  Maps maps;
  drawings["node-matching"] = [&](const FrameMemory& memory) {
    maps["node-matching"] = matched_leaves(memory.nodes);
  };
  drawings["node-extrapolation"] = [&maps](const FrameMemory& memory) {
    maps["extrapolated"] = eval::to_float(memory.maps.disparity.view());
  };
  match(matcher_of("paper", "semi-dense"), frame, drawings);
  return maps;
}

/// The map after path-matching, with the defaults.
cv::Mat matched_along_paths(const char* mode, const render::StereoFrame& frame) {
  cv::Mat map;
  match(matcher_of("default", mode), frame, {{"path-matching", [&](const FrameMemory& memory) {
                                                map = eval::to_float(memory.maps.disparity.view());
                                              }}});
  return map;
}

/// The result with the defaults.
cv::Mat result_of(const char* mode, const render::StereoFrame& frame) {
  FrameMatcher matcher = matcher_of("default", mode);
  return eval::to_float(matcher.compute(view_of(frame.left), view_of(frame.right)).disparity);
}

/// The maps of the last of ten noisy frames before a moving camera, without and with the frames
/// before.
cv::Mat draw_moving_camera() {
  constexpr double kNoise = 5, kInterval = 1.0 / 15;
  std::vector<cv::Mat> maps;
  for (const char* const temporal : {"off", "filter"}) {
    Parameters parameters = parameters_of("default", "semi-dense");
    if (const Status status = parameters.set("temporal", temporal); !status) {
      throw std::runtime_error(status.error().message);
    }
    FrameMatcher matcher{Settings(parameters)};
    cv::Mat map;
    for (int i = 0; i < 10; ++i) {
      render::StereoFrame frame = frame_of("room", kInterval * i);
      eval::add_flicker_noise(kNoise, i, frame.left, frame.right);
      map = eval::to_float(matcher.compute(view_of(frame.left), view_of(frame.right)).disparity);
    }
    maps.push_back(colored(map));
  }
  return figures::side_by_side(maps[0], maps[1]);
}

void draw_images(const fs::path& folder) {
  fs::create_directories(folder);
  const render::StereoFrame frame = demo_frame();
  const auto write = [&](const char* name, const cv::Mat& image) {
    eval::write_image(folder / name, image);
  };
  write("pair.png", figures::side_by_side(frame.left, frame.right));
  write("moving-camera.png", draw_moving_camera());
  const Settings settings(parameters_of("paper", "semi-dense"));
  const Drawing preprocessed = [&](const FrameMemory& memory) {
    const auto draw = [&](int side) {
      return figures::draw_levels(memory.nodes.preprocessed[side].level.view(),
                                  settings.gray_levels);
    };
    write("preprocessed.png", figures::side_by_side(draw(0), draw(1)));
  };
  const Drawing trees = [&](const FrameMemory& memory) {
    const MaxTrees& left = memory.nodes.trees[0];
    write("max-tree.png", figures::draw_tree(left, left.height / 2, 14));
    write("nodes.png",
          figures::side_by_side(figures::draw_nodes(parents(left, settings), frame.left),
                                figures::draw_nodes(memory.nodes.leaves().left, frame.left)));
  };
  for (const auto& [name, map] :
       maps_of_steps(frame, {{"preprocessing", preprocessed}, {"max-trees", trees}})) {
    write((name + ".png").c_str(), figures::side_by_side(colored(map), colored(frame.truth)));
  }
  write("path-matching.png",
        figures::side_by_side(colored(matched_along_paths("semi-dense", frame)),
                              colored(matched_along_paths("full", frame))));
  write("final.png", figures::side_by_side(colored(result_of("semi-dense", frame)),
                                           colored(result_of("sparse", frame))));
  const Drawing volume = [&](const FrameMemory& memory) {
    const cv::Mat cheapest = cheapest_disparity(memory.costs.volume, frame.left.size());
    write("cost-volume.png", figures::side_by_side(colored(cheapest), colored(frame.truth)));
  };
  Maps paper;
  match(matcher_of("paper", "semi-dense"), frame,
        {{"cost-volume", volume},
         {"node-drawing",
          [&](const FrameMemory& m) { paper["drawn"] = eval::to_float(m.maps.disparity.view()); }},
         {"node-outliers", [&](const FrameMemory& m) {
            paper["filtered"] = eval::to_float(m.maps.disparity.view());
          }}});
  write("nodes-filtered.png",
        figures::side_by_side(colored(paper.at("drawn")), colored(paper.at("filtered"))));
}

/// Text inside a cell of a Markdown table.
std::string cell(std::string text) {
  for (size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, "\\|");
  }
  return text;
}

std::string range(const ParameterInfo& info) {
  switch (info.type) {
    case ParameterType::kBoolean:
      return "true, false";
    case ParameterType::kChoice:
      return cell(info.choices);
    case ParameterType::kLevels:
      return "descending, ends with 0";
    case ParameterType::kInteger:
    case ParameterType::kNumber:
      break;
  }
  char text[64];
  std::snprintf(text, sizeof text, "%g .. %g", info.minimum, info.maximum);
  return text;
}

void print_table() {
  std::puts("| parameter | range | default | what it does (symbol in the paper) |");
  std::puts("| --- | --- | --- | --- |");
  for (const ParameterInfo& info : parameter_table()) {
    const std::string unit = *info.unit ? std::string(" ") + info.unit : "";
    const std::string symbol = *info.symbol ? std::string(" (") + info.symbol + ")" : "";
    std::printf("| `%s` | %s%s | %s | %s%s |\n", info.name, range(info).c_str(), unit.c_str(),
                cell(parameter_defaults_text(info.id)).c_str(), cell(info.help).c_str(),
                symbol.c_str());
  }
}

bool runs(const StepList& list, const Step& step, const Settings& settings) {
  const auto lists = lists_of(settings);
  return step.runs(settings) && std::any_of(lists.begin(), lists.end(), [&](const StepList& other) {
           return other.data() == list.data();
         });
}

/// Prints a line for each step: its list and name, then PRESET/MODE for all presets and modes that
/// run it.
void print_steps() {
  const std::pair<const char*, StepList> lists[] = {{"View", kViewSteps},
                                                    {"Path", kPathSteps},
                                                    {"Node", kNodeSteps},
                                                    {"Result", kResultSteps},
                                                    {"Size", kSizeSteps}};
  for (const auto& [name, list] : lists) {
    for (const Step& step : list) {
      std::printf("%s %s", name, std::string(step.name).c_str());
      for (const std::string_view preset : ChoiceOf<Preset>::kWords) {
        for (const std::string_view mode : ChoiceOf<Mode>::kWords) {
          const FrameMatcher matcher = matcher_of(preset, mode);
          if (!runs(list, step, matcher.settings())) continue;
          std::printf(" %s/%s", std::string(preset).c_str(), std::string(mode).c_str());
        }
      }
      std::puts("");
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Images and tables of docs/");
  std::string folder;
  bool table = false;
  bool steps = false;
  app.add_option("--images", folder, "write the images of every stage into this folder");
  app.add_flag("--parameters", table, "print the parameter table in Markdown");
  app.add_flag("--steps", steps, "print all steps, each with the presets and modes that run it");
  CLI11_PARSE(app, argc, argv);
  try {
    if (table) print_table();
    if (steps) print_steps();
    if (!folder.empty()) draw_images(folder);
  } catch (const std::exception& exception) {
    std::fprintf(stderr, "mtstereo-figures: %s\n", exception.what());
    return 1;
  }
  if (!table && !steps && folder.empty()) {
    std::fputs(app.help().c_str(), stdout);
    return 2;
  }
  return 0;
}
