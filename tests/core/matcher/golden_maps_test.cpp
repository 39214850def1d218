// SPDX-License-Identifier: LGPL-2.1-or-later
// The results as hashes of the disparity map and the confidence of every preset and mode on
// synthetic pairs. They are equal on every processor, for every compiler and number of threads. A
// change that should not change results must not change them; for a change that should, the test
// prints the new table, see CONTRIBUTING.md.
#include <gtest/gtest.h>

#include <cinttypes>
#include <cstdio>

#include "support/matching.hpp"
#include "support/random.hpp"

namespace mtstereo::golden_maps_test {
namespace {

/// FNV-1a over the pixels of an image, in 64 bits.
template <typename View>
std::uint64_t hash_of(const View& view, std::uint64_t hash) {
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      auto value = static_cast<std::uint32_t>(view.row(y)[x]);
      for (int byte = 0; byte < 4; ++byte, value >>= 8) {
        hash = (hash ^ (value & 0xFF)) * 1099511628211u;
      }
    }
  }
  return hash;
}

/// A slanted surface, noise that matches nowhere, and steps: textured, flat and repetitive areas.
std::vector<test::Pair> pairs() {
  return {test::slanted_pair(333, 141, 50, 11),
          test::shifted_pair(200, 97, 13, 12),
          {test::noise(160, 64, 13), test::noise(160, 64, 14)},
          {test::black_and_white(121, 60, 15), test::black_and_white(121, 60, 15)}};
}

struct Golden {
  const char* preset;
  const char* mode;
  std::uint64_t hash;
};

// clang-format off
constexpr Golden kGolden[] = {
    {"default", "sparse", 0xe0957c121cff9865},
    {"default", "semi-dense", 0x4fc109c5223b254f},
    {"default", "dense", 0xa5cf07664216e372},
    {"default", "full", 0x7cc348e49d4efb26},
    {"fast", "sparse", 0x91f0fe2196c51870},
    {"fast", "semi-dense", 0xd2458e39ad48b083},
    {"fast", "dense", 0xf5a45e4274127e8f},
    {"fast", "full", 0xf5879c4ad90eeec3},
    {"paper", "sparse", 0x98e213ddc5698efd},
    {"paper", "semi-dense", 0x2b88bcb41e29aab0},
};
// clang-format on

TEST(GoldenMaps, AreEqualBitForBit) {
  for (const Golden& golden : kGolden) {
    std::uint64_t hash = 14695981039346656037u;
    for (const test::Pair& pair : pairs()) {
      Matcher matcher =
          test::matcher({{"preset", golden.preset}, {"mode", golden.mode}, {"threads", "2"}});
      const Result<FrameResult> result = matcher.compute(pair.left.view(), pair.right.view());
      ASSERT_TRUE(result.ok());
      hash = hash_of(result->confidence, hash_of(result->disparity, hash));
    }
    char row[96];
    std::snprintf(row, sizeof row, "{\"%s\", \"%s\", 0x%016" PRIx64 "},", golden.preset,
                  golden.mode, hash);
    EXPECT_EQ(golden.hash, hash) << "the row of the table is now\n    " << row;
  }
}

}  // namespace
}  // namespace mtstereo::golden_maps_test
