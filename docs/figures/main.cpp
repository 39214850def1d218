// SPDX-License-Identifier: LGPL-2.1-or-later
// mtstereo-figures: the pictures of docs/algorithm.md, the table of docs/parameters.md, and the
// plots of docs/benchmark.md.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "drawings.hpp"
#include "eval/metrics.hpp"
#include "eval/pictures.hpp"
#include "growth.hpp"
#include "mtstereo/mtstereo.hpp"
#include "render/render.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/prepare/max_tree.hpp"

namespace {

using namespace mtstereo;
namespace fs = std::filesystem;

constexpr int kDisparities = 40;

/// A frame of the demo's scene, a little smaller.
render::StereoFrame demo_frame() {
  render::Settings settings;
  settings.width = 480;
  settings.height = 270;
  render::StereoFrame frame = render::render(render::make_scene("street", 1), 1.0, settings);
  for (float& disparity : cv::Mat_<float>(frame.truth)) {
    if (std::isinf(disparity)) disparity = std::numeric_limits<float>::quiet_NaN();  // the sky
  }
  return frame;
}

GrayView view_of(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

Matcher matcher_of(const char* preset, const char* mode) {
  Parameters parameters;
  for (const Status& status : {parameters.set("preset", preset), parameters.set("mode", mode),
                               parameters.set(Parameter::kMaxDisparity, kDisparities)}) {
    if (!status) throw std::runtime_error(status.error().message);
  }
  Result<Matcher> matcher = Matcher::create(parameters);
  if (!matcher) throw std::runtime_error(matcher.error().message);
  matcher->keep_stages(true);
  return std::move(*matcher);
}

void match(Matcher& matcher, const render::StereoFrame& frame) {
  const auto result = matcher.compute(view_of(frame.left), view_of(frame.right));
  if (!result) throw std::runtime_error(result.error().message);
}

cv::Mat colored(const cv::Mat& disparity) { return eval::color_disparity(disparity, kDisparities); }

/// The disparity of least cost of every pixel on its own: what the cost volume alone knows.
cv::Mat cheapest_disparity(const Matcher& matcher, cv::Size size) {
  cv::Mat map(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      double least = std::numeric_limits<double>::infinity();
      for (int d = 0; d < std::min(kDisparities, x + 1); ++d) {
        const double cost = matcher.cost(x, y, d);
        if (cost >= least) continue;
        least = cost;
        map.at<float>(y, x) = static_cast<float>(d);
      }
    }
  }
  return map;
}

/// The pictures of the trees and the nodes, made by the stages themselves.
void draw_nodes(const Matcher& matcher, const render::StereoFrame& frame, const fs::path& folder) {
  const Parameters& parameters = matcher.parameters();
  const GrayView levels = matcher.preprocessed(Side::kLeft);
  Image<std::uint8_t> image;
  image.resize(levels.width, levels.height);
  for (int y = 0; y < levels.height; ++y) {
    std::copy_n(levels.row(y), levels.width, image.row(y));
  }
  MaxTrees trees;
  trees.resize(levels.width, levels.height);
  build_max_trees(image, 0, levels.height, trees);
  eval::write_picture(folder / "max-tree.png", figures::draw_tree(trees, levels.height / 2, 14));

  const WidthRange widths = {parameters.get(Parameter::kMinNodeWidth),
                             parameters.get(Parameter::kMaxNodeWidth) * levels.width};
  NodeLevel coarse;
  NodeLevel fine;
  for (auto [ancestor, level] : {std::pair{1, &coarse}, std::pair{0, &fine}}) {
    level->resize(levels.width, levels.height);
    select_nodes(trees, ancestor, widths, 0, levels.height, *level);
  }
  eval::write_picture(folder / "nodes.png",
                      figures::side_by_side(figures::draw_nodes(coarse, frame.left),
                                            figures::draw_nodes(fine, frame.left)));
}

void draw_pictures(const fs::path& folder) {
  fs::create_directories(folder);
  const render::StereoFrame frame = demo_frame();
  Matcher semi_dense = matcher_of("default", "semi-dense");
  Matcher sparse = matcher_of("default", "sparse");
  Matcher paper = matcher_of("paper", "semi-dense");  // has a cost volume
  match(semi_dense, frame);
  match(paper, frame);
  match(sparse, frame);

  eval::write_picture(folder / "pair.png", figures::side_by_side(frame.left, frame.right));
  const int gray_levels = semi_dense.parameters().integer(Parameter::kGrayLevels);
  eval::write_picture(
      folder / "preprocessed.png",
      figures::side_by_side(
          figures::draw_levels(semi_dense.preprocessed(Side::kLeft), gray_levels),
          figures::draw_levels(semi_dense.preprocessed(Side::kRight), gray_levels)));
  draw_nodes(semi_dense, frame, folder);
  eval::write_picture(folder / "cost-volume.png",
                      figures::side_by_side(colored(cheapest_disparity(paper, frame.left.size())),
                                            colored(frame.truth)));
  const std::pair<const char*, Stage> stages[] = {
      {"node-matching.png", Stage::kNodeMatching},
      {"nodes-filtered.png", Stage::kNodesFiltered},
      {"extrapolated.png", Stage::kExtrapolated},
      {"pixel-matching.png", Stage::kPixelMatching},
      {"final.png", Stage::kFinal},
  };
  for (const auto& [name, stage] : stages) {
    eval::write_picture(folder / name,
                        figures::side_by_side(colored(eval::to_float(semi_dense.stage(stage))),
                                              colored(eval::to_float(sparse.stage(stage)))));
  }
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
      return "falling, ends with 0";
    case ParameterType::kInteger:
    case ParameterType::kNumber:
      break;
  }
  char text[64];
  std::snprintf(text, sizeof text, "%g .. %g", info.minimum, info.maximum);
  return text;
}

void print_table() {
  std::puts("| parameter | symbol | unit | range | default | what it does |");
  std::puts("| --- | --- | --- | --- | --- | --- |");
  for (const ParameterInfo& info : parameter_table()) {
    std::printf("| `%s` | %s | %s | %s | %s | %s |\n", info.name, info.symbol, info.unit,
                range(info).c_str(), cell(parameter_defaults_text(info.id)).c_str(),
                cell(info.help).c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Pictures and tables of docs/");
  std::string folder;
  std::vector<std::string> growth;
  bool table = false;
  app.add_option("--pictures", folder, "write the pictures of every stage into this folder");
  app.add_flag("--parameters", table, "print the parameter table in Markdown");
  app.add_option("--growth", growth,
                 "draw what a file of JSON describes, see growth.hpp, to a picture")
      ->type_name("PLOT.json PICTURE.png")
      ->expected(2);
  CLI11_PARSE(app, argc, argv);
  try {
    if (!growth.empty()) {
      eval::write_picture(growth[1], figures::draw_growth(figures::read_growth(growth[0])));
    }
    if (table) print_table();
    if (!folder.empty()) draw_pictures(folder);
  } catch (const std::exception& exception) {
    std::fprintf(stderr, "mtstereo-figures: %s\n", exception.what());
    return 1;
  }
  if (!table && folder.empty() && growth.empty()) {
    std::fputs(app.help().c_str(), stdout);
    return 2;
  }
  return 0;
}
