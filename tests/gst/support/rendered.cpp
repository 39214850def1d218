// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support/rendered.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace mtstereo::test {
namespace {

GrayImage image_of(const cv::Mat& gray) {
  GrayImage image{gray.cols, gray.rows, {}};
  for (int y = 0; y < gray.rows; ++y) {
    const auto* row = gray.ptr<std::uint8_t>(y);
    image.pixels.insert(image.pixels.end(), row, row + gray.cols);
  }
  return image;
}

}  // namespace

render::Settings rendered_settings(const render::Rig& rig) {
  render::Settings settings;
  settings.width = kRenderedWidth, settings.height = kRenderedHeight;
  settings.rig = rig;
  settings.samples = 1;  // textures are as soft as a pixel is wide, with one ray too
  return settings;
}

std::vector<Pair> rendered_pairs(const std::string& scene, int count, double step,
                                 const render::Settings& settings) {
  const render::Scene made = render::make_scene(scene, 1);
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i) {
    const auto view = [&](bool right) {
      return render::render_view(made, i * step, settings, right);
    };
    pairs.push_back(pair_of(view(false), view(true)));
  }
  return pairs;
}

Pair pair_of(const cv::Mat& left, const cv::Mat& right) {
  return {image_of(left), image_of(right)};
}

Pair swapped(const Pair& pair) { return {pair.right, pair.left}; }

GrayImage blurred(const GrayImage& image, double sigma) {
  GrayImage copy = image;
  const cv::Mat gray(copy.height, copy.width, CV_8UC1, copy.pixels.data());
  cv::Mat result;
  cv::GaussianBlur(gray, result, {}, sigma);
  return image_of(result);
}

std::vector<std::vector<std::uint16_t>> match_all(StereoHarness& harness,
                                                  const std::vector<Pair>& pairs,
                                                  GstClockTime first) {
  std::vector<std::vector<std::uint16_t>> maps;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const GrayImage& left = pairs[i].left;
    harness.push_pair(pairs[i], first + i * kFrame);
    const BufferPointer map = harness.pull();
    if (!map) {
      ADD_FAILURE() << "pair " << i << " has no map: " << harness.error(1).text;
      break;
    }
    maps.push_back(map_of(map.get(), left.width, left.height));
  }
  return maps;
}

double number_of(const GstStructure* structure, const char* field) {
  const GValue* value = structure != nullptr ? gst_structure_get_value(structure, field) : nullptr;
  if (value == nullptr) {
    ADD_FAILURE() << "there is no field " << field;
    return 0;
  }
  GValue number = G_VALUE_INIT;
  g_value_init(&number, G_TYPE_DOUBLE);
  EXPECT_TRUE(g_value_transform(value, &number)) << field;
  return g_value_get_double(&number);
}

StructurePointer stats_structure(GstElement* element) {
  GstStructure* stats = nullptr;
  g_object_get(element, "stats", &stats, nullptr);
  return StructurePointer(stats);
}

std::string field_text(GstElement* element) {
  gchar* text = nullptr;
  g_object_get(element, "alignment-field", &text, nullptr);
  const std::string result = text;
  g_free(text);
  return result;
}

double density_of(const std::vector<std::uint16_t>& map) {
  const auto missing = std::count(map.begin(), map.end(), std::uint16_t{0});
  return 1 - static_cast<double>(missing) / static_cast<double>(map.size());
}

}  // namespace mtstereo::test
