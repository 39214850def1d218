// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <vector>

#include "base/thread_pool.hpp"
#include "reference/refine/gap_filling.hpp"
#include "reference/refine/speckle_removal.hpp"
#include "stages/refine/gap_filling.hpp"
#include "stages/refine/speckle_removal.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"

namespace mtstereo::filter_threads_test {
namespace {

constexpr int kThreadCounts[] = {1, 2, 3, 5};
constexpr int kBand = 32;

/// Calls body(first, last, worker) for parts of `part` rows or columns of `length`.
template <typename Body>
void for_parts(ThreadPool& pool, int length, int part, Body&& body) {
  pool.run((length + part - 1) / part,
           [&](int i, int worker) { body(i * part, std::min((i + 1) * part, length), worker); });
}

/// A map of many bands with patches across the borders of bands.
DisparityPlane tall_map(std::uint64_t seed) { return test::patches(150, 330, 1, seed); }

TEST(FilterThreads, RemoveTheSameSpecklesForAnyNumber) {
  SpeckleRuns runs;
  for (const int threads : kThreadCounts) {
    ThreadPool pool(threads);
    for (int seed = 0; seed < 10; ++seed) {
      const DisparityPlane map = tall_map(seed);
      Image<std::int32_t> image = image_of(map);
      runs.resize(map.width, map.height);
      Image<std::uint8_t> area;
      area.resize(map.width, map.height);
      for_parts(pool, map.height, kBand,
                [&](int y0, int y1, int) { find_runs(image, 64, y0, y1, runs); });
      join_bands(image, 64, kBand, runs);
      for_parts(pool, map.height, kBand,
                [&](int y0, int y1, int) { remove_small(runs, 40, y0, y1, image, &area); });
      const reference::Areas expected = reference::remove_speckles(map, 64, 40);
      EXPECT_TRUE(same_image(expected.map, image)) << threads << " threads";
      EXPECT_TRUE(same_image(expected.weight, area)) << threads << " threads";
    }
  }
}

TEST(FilterThreads, FillTheSameGapsForAnyNumber) {
  for (const int threads : kThreadCounts) {
    ThreadPool pool(threads);
    for (int seed = 0; seed < 10; ++seed) {
      const DisparityPlane map = tall_map(20 + seed);
      GrayPlane confidence(map.width, map.height);
      for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        confidence.pixels[i] = map.pixels[i] == 0 ? 0 : static_cast<std::uint8_t>(1 + i % 255);
      }
      Image<std::int32_t> image = image_of(map);
      Image<std::uint8_t> image_confidence = image_of(confidence);
      for_parts(pool, map.height, kBand, [&](int y0, int y1, int) {
        fill_gaps_along_rows({9, 500}, y0, y1, image, image_confidence);
      });
      for_parts(pool, map.width, kGapColumns, [&](int x0, int x1, int) {
        fill_gaps_along_columns({9, 500}, x0, x1, image, image_confidence);
      });
      const reference::ConfidentMap rows = reference::fill_gaps({map, confidence}, 9, 500, 1, 0);
      const reference::ConfidentMap expected = reference::fill_gaps(rows, 9, 500, 0, 1);
      EXPECT_TRUE(same_image(expected.map, image)) << threads << " threads";
      EXPECT_TRUE(same_image(expected.confidence, image_confidence)) << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace mtstereo::filter_threads_test
