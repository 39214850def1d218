// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/fit/samples.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "matcher/frame_matcher.hpp"
#include "matcher/settings.hpp"
#include "mtstereo/parameters.hpp"
#include "stages/refine/reliability.hpp"
#include "tools/eval/degrade.hpp"
#include "tools/eval/metrics.hpp"
#include "tools/render/render.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::fit {
namespace {

/// For data sets that do not state it.
constexpr int kMaxDisparity = 128;

GrayView view_of(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

std::string family_of(eval::Layout layout) {
  switch (layout) {
    case eval::Layout::kMiddlebury:
      return "Middlebury";
    case eval::Layout::kKitti2015:
      return "KITTI";
    case eval::Layout::kEth3d:
      return "ETH3D";
    default:
      return "other";
  }
}

/// The bins of all pixels of a complete map.
class Bins {
 public:
  Bins(const RatedViews& views, const Image<std::int32_t>& disparity,
       const Image<std::uint8_t>& confidence)
      : views_(views), disparity_(disparity), confidence_(confidence) {
    const auto [data, width, height, stride] = views_.left;
    ClueScratch gathering;
    gathering.resize(width);
    clues_.resize(width, height);
    scratch_.resize(width);
    gather_clues(views_, disparity_, confidence_, 0, height, gathering, clues_);
  }

  std::array<std::uint8_t, kClues> at(int x, int y) {
    if (y != row_) find_clue_bins(views_, disparity_, confidence_, clues_, y, scratch_);
    row_ = y;
    std::array<std::uint8_t, kClues> bins{};
    for (int clue = 0; clue < kClues; ++clue) bins[clue] = scratch_.bins[clue][x];
    return bins;
  }

  double disparity(cv::Point pixel) const {
    return disparity_.row(pixel.y)[pixel.x] / double{kDisparityOne};
  }
  PartShares shares() const { return part_shares(views_); }
  bool is_matched(cv::Point pixel) const {
    return confidence_.row(pixel.y)[pixel.x] > kMostInferred;
  }

 private:
  RatedViews views_;
  const Image<std::int32_t>& disparity_;
  const Image<std::uint8_t>& confidence_;
  ClueMaps clues_;
  ReliabilityScratch scratch_;
  int row_ = -1;
};

/// Random pixels, row by row.
std::vector<cv::Point> random_pixels(const std::string& seed, cv::Size size, int count) {
  std::seed_seq sequence(seed.begin(), seed.end());
  std::mt19937 random(sequence);
  std::vector<cv::Point> pixels;
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<int>(random() % static_cast<unsigned>(size.area()));
    pixels.emplace_back(index % size.width, index / size.width);
  }
  std::sort(pixels.begin(), pixels.end(),
            [](cv::Point a, cv::Point b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  return pixels;
}

/// The confidence of the map that has guided the matching, after the step guide-support, by a
/// table.
Image<std::uint8_t> rated_guide(const FrameMemory& memory, const TableParts& parts) {
  const Image<std::int32_t>& map = memory.pyramid.levels[0].disparity;
  Bins bins(rated_guide_views(memory.views, memory.pyramid), map, memory.pyramid.confidence);
  const ReliabilityTable table = table_for(parts, bins.shares());
  Image<std::uint8_t> rated;
  rated.resize(map.width(), map.height());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      rated.row(y)[x] = static_cast<std::uint8_t>(confidence(table, {bins.at(x, y)}));
    }
  }
  return rated;
}

bool is_half(RatedMap rated) {
  return rated == RatedMap::kHalfComplete || rated == RatedMap::kHalfMatched;
}

Settings settings_for(int max_disparity, RatedMap rated) {
  Parameters parameters;
  const bool complete = rated == RatedMap::kComplete || rated == RatedMap::kHalfComplete;
  (void)parameters.set("preset", is_half(rated) ? "fast" : "default");
  (void)parameters.set("mode", complete ? "full" : "semi-dense");
  (void)parameters.set("max-disparity", std::to_string(max_disparity));
  return Settings(parameters);
}

}  // namespace

int confidence(const ReliabilityTable& table, const Sample& sample) {
  int sum = 0;
  for (int clue = 0; clue < kClues; ++clue) sum += table[clue][sample.bins[clue]];
  return std::clamp(sum / kReliabilityOne, 1, 255);
}

std::vector<TrainingPair> pairs_in(const std::string& folder) {
  std::vector<TrainingPair> pairs;
  const eval::DataSet set = eval::find_pairs(folder, eval::detect_layout(folder));
  for (const eval::StereoPair& pair : set.pairs) {
    pairs.push_back({pair.name, family_of(set.layout), pair.max_disparity.value_or(kMaxDisparity),
                     eval::load_pair(pair)});
  }
  return pairs;
}

std::vector<TrainingPair> rendered_pairs() {
  std::vector<TrainingPair> pairs;
  for (const std::string scene : {"street", "garden", "room"}) {
    for (const unsigned seed : {11U, 12U, 13U}) {
      render::Settings settings;
      settings.width = 640;
      settings.height = 384;
      const render::StereoFrame frame =
          render::render(render::make_scene(scene, seed), 0.5 * seed, settings);
      pairs.push_back({scene + std::to_string(seed),
                       "rendered",
                       96,
                       {frame.left, frame.right, {frame.truth, {}}}});
    }
  }
  return pairs;
}

PairSamples take_samples(const TrainingPair& pair, const std::string& kind, RatedMap rated,
                         const TableParts& guide, int count) {
  eval::DegradedPair degraded{pair.views, pair.max_disparity};
  if (kind != eval::kCleanKind) {
    degraded = eval::degrade(eval::parse_degradation(kind), pair.views, pair.max_disparity);
  }
  PairSamples taken{pair.family, kind, {}, {}};
  const cv::Mat& truth = degraded.images.truth.disparity;
  const double scale = degraded.images.truth.scale;
  const Settings settings = settings_for(degraded.max_disparity, rated);
  const bool is_guide = rated == RatedMap::kGuide;
  const auto sample = [&](Bins& bins, int shrinking) {
    taken.shares = bins.shares();
    for (const cv::Point pixel : random_pixels(pair.name + kind, truth.size(), count)) {
      const cv::Point place = pixel / shrinking;
      if (!settings.infers() && !is_guide && !bins.is_matched(place)) continue;
      const double expected = truth.at<float>(pixel);
      const double found = shrinking * bins.disparity(place);
      const bool known = std::isfinite(expected);
      const bool wrong =
          known && eval::is_outlier(std::abs(found - expected) / scale, expected / scale);
      taken.samples.push_back({bins.at(place.x, place.y), known, wrong});
    }
  };
  Image<std::uint8_t> guide_confidence;
  const auto observe = [&](const Step& step, const FrameMemory& memory) {
    const Pyramid& pyramid = memory.pyramid;
    if (step.name == "guide-support" && is_guide) {
      Bins bins(rated_guide_views(memory.views, pyramid), pyramid.levels[0].disparity,
                pyramid.confidence);
      sample(bins, 2);
    } else if (step.name == "guide-support") {
      guide_confidence = rated_guide(memory, guide);
    } else if (step.name == (settings.infers() ? "edge-alignment" : "edge-check") && !is_guide) {
      RatedViews views = rated_views(settings, memory.views, pyramid, memory.result);
      views.guide.confidence = &guide_confidence;
      Bins bins(views, *memory.result.disparity, *memory.result.confidence);
      sample(bins, is_half(rated) ? 2 : 1);
    }
  };
  FrameMatcher(settings).compute(view_of(degraded.images.left), view_of(degraded.images.right),
                                 observe);
  return taken;
}

}  // namespace mtstereo::fit
