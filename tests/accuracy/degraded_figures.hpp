// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <ostream>

namespace mtstereo::tests {

/// Sets of pairs.
enum class Pairs {
  kTen,       ///< ten_pairs()
  kFurther,   ///< further_pairs()
  kRendered,  ///< one pair of each rendered scene
};

/// The means over a set of pairs that the matcher reached. degraded_test.cpp has the margins.
struct DegradedFigures {
  Pairs pairs;
  const char* kind;           ///< "clean", or a degradation of mtstereo-eval
  const char* properties;     ///< of the element
  double avgerr;              ///< [px]
  double d_all;               ///< [%]
  double density;             ///< [%]
  std::int64_t flat_answers;  ///< disparities in flat areas, all pairs [px]
};

/// The density that the default mode reached at a D-all of 1 %: of the largest share of pixels that
/// has so few gross errors, whatever the threshold of the confidence is.
struct EqualErrorFigures {
  Pairs pairs;
  const char* kind;  ///< as in DegradedFigures
  double density;    ///< [%]
};

/// The name of a set as in the table.
inline const char* code_of(Pairs pairs) {
  return pairs == Pairs::kTen       ? "Pairs::kTen"
         : pairs == Pairs::kFurther ? "Pairs::kFurther"
                                    : "Pairs::kRendered";
}

/// What GoogleTest prints of a row.
inline void PrintTo(const DegradedFigures& row, std::ostream* out) {
  *out << code_of(row.pairs) << ", " << row.kind << ", " << row.properties;
}

// clang-format off
inline constexpr DegradedFigures kDegradedFigures[] = {
    {Pairs::kTen, "clean", "mode=semi-dense", 0.288, 0.36, 73.4, 18330},
    {Pairs::kTen, "clean", "mode=sparse", 0.212, 0.04, 49.3, 4129},
    {Pairs::kTen, "clean", "mode=dense", 0.451, 1.17, 84.1, 26417},
    {Pairs::kTen, "clean", "preset=fast", 0.329, 0.62, 69.9, 11453},
    {Pairs::kTen, "clean", "mode=full", 1.017, 4.32, 100.0, 61200},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.294, 0.36, 72.9, 16332},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.288, 0.36, 73.4, 17558},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.212, 0.04, 49.1, 3899},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.452, 1.18, 84.0, 25510},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.329, 0.61, 69.9, 10963},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.288, 0.37, 73.2, 16663},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.312, 0.38, 73.5, 16757},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.411, 0.68, 62.7, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.254, 0.09, 33.4, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.618, 1.73, 74.9, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.555, 7.70, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.423, 0.66, 52.0, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.508, 0.95, 49.0, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.437, 0.68, 66.5, 30883},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.575, 1.00, 51.7, 83161},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.392, 0.05, 14.3, 13004},
    {Pairs::kTen, "jpeg=20", "mode=dense", 0.813, 2.50, 65.3, 123826},
    {Pairs::kTen, "jpeg=20", "mode=full", 1.940, 11.06, 100.0, 472288},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.639, 1.26, 47.5, 69025},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.559, 1.25, 43.7, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.287, 0.18, 8.8, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 0.971, 3.83, 59.9, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.537, 12.73, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.560, 1.16, 30.4, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.312, 0.47, 57.6, 146070},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.249, 0.06, 31.5, 30429},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.461, 1.19, 68.3, 230665},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.369, 0.68, 55.0, 150446},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.401, 0.91, 76.1, 23128},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.497, 1.48, 76.3, 20627},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.289, 0.53, 73.0, 69279},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.531, 1.20, 70.0, 2965},
    {Pairs::kTen, "cam", "mode=sparse", 0.305, 0.17, 38.9, 108},
    {Pairs::kTen, "cam", "mode=dense", 0.765, 2.64, 81.5, 4355},
    {Pairs::kTen, "cam", "mode=full", 1.528, 6.76, 100.0, 15973},
    {Pairs::kTen, "cam", "preset=fast", 0.576, 1.42, 68.3, 2580},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.334, 0.57, 66.9, 15024},
    {Pairs::kTen, "cam2x", "mode=dense", 0.523, 1.49, 77.8, 19204},
    {Pairs::kTen, "cam2x", "preset=fast", 0.357, 0.51, 66.1, 10212},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.404, 0.76, 67.9, 7409},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.466, 0.78, 65.4, 2462},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.600, 1.50, 69.8, 17731},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.309, 0.46, 67.7, 8511},
    {Pairs::kFurther, "clean", "mode=dense", 0.479, 1.48, 80.6, 13679},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 0.951, 4.19, 53.4, 120669},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.716, 2.51, 64.5, 0},
    {Pairs::kFurther, "clean", "mode=full", 0.879, 4.85, 100.0, 28398},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.308, 0.43, 66.6, 8375},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.310, 0.48, 67.7, 8456},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.311, 0.48, 67.5, 8087},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.317, 0.48, 66.6, 9950},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.449, 0.83, 49.5, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.521, 0.87, 36.3, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.454, 0.68, 52.5, 20934},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.623, 1.37, 37.4, 52354},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.549, 1.33, 29.2, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.407, 0.86, 41.6, 131262},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.500, 1.51, 68.9, 14462},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.662, 2.32, 69.6, 14105},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.316, 0.69, 65.4, 42790},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.587, 1.37, 57.8, 4616},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.387, 0.84, 55.1, 16787},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.226, 1.10, 74.8, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.337, 2.43, 89.7, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.230, 1.11, 74.8, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.229, 1.03, 74.5, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.385, 1.83, 69.1, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.383, 1.42, 59.3, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.489, 1.61, 58.8, 6781},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.580, 3.18, 57.9, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.192, 0.72, 71.4, 6673},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.268, 1.12, 70.9, 10635},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.354, 2.65, 80.6, 0},
};

inline constexpr EqualErrorFigures kEqualErrorFigures[] = {
    {Pairs::kTen, "clean", 79.6},
    {Pairs::kTen, "noise=5", 66.7},
    {Pairs::kTen, "jpeg=50", 70.5},
    {Pairs::kTen, "h264=28", 69.3},
    {Pairs::kTen, "dark=0.15", 39.7},
    {Pairs::kTen, "bright=1.8", 64.8},
    {Pairs::kTen, "soft2x", 76.4},
    {Pairs::kTen, "cam", 67.3},
    {Pairs::kTen, "cam2x", 71.1},
    {Pairs::kFurther, "clean", 72.3},
    {Pairs::kFurther, "noise=5", 50.5},
    {Pairs::kFurther, "jpeg=50", 54.9},
    {Pairs::kFurther, "h264=28", 53.1},
    {Pairs::kFurther, "dark=0.15", 24.9},
    {Pairs::kFurther, "bright=1.8", 41.6},
    {Pairs::kFurther, "soft2x", 67.9},
    {Pairs::kFurther, "cam", 52.9},
    {Pairs::kFurther, "cam2x", 55.7},
};
// clang-format on

}  // namespace mtstereo::tests
