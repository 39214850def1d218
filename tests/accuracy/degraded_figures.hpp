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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.303, 0.42, 72.4, 13887},
    {Pairs::kTen, "clean", "mode=sparse", 0.231, 0.04, 45.9, 3592},
    {Pairs::kTen, "clean", "mode=dense", 0.479, 1.30, 83.2, 24862},
    {Pairs::kTen, "clean", "preset=fast", 0.326, 0.58, 68.4, 12391},
    {Pairs::kTen, "clean", "mode=full", 1.142, 4.60, 100.0, 61232},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.306, 0.44, 71.8, 11554},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.303, 0.42, 72.4, 13153},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.231, 0.04, 45.9, 3384},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.479, 1.30, 83.2, 24228},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.327, 0.58, 68.4, 11814},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.304, 0.43, 72.3, 12324},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.323, 0.45, 72.3, 13329},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.408, 0.65, 60.7, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.260, 0.09, 29.4, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.622, 1.75, 72.8, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.686, 8.03, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.408, 0.60, 51.0, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.494, 0.92, 47.5, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.451, 0.75, 65.7, 29909},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.567, 1.01, 51.0, 74735},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.383, 0.03, 13.3, 9297},
    {Pairs::kTen, "jpeg=20", "mode=dense", 0.814, 2.56, 63.4, 121258},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.067, 11.65, 100.0, 471703},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.617, 1.11, 45.0, 68827},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.533, 1.11, 42.3, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.296, 0.18, 7.9, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.002, 4.07, 60.1, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.597, 13.07, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.573, 1.16, 30.6, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.325, 0.55, 57.0, 144824},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.251, 0.07, 30.8, 33668},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.463, 1.29, 68.3, 251923},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.395, 1.02, 56.6, 194546},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.394, 0.76, 73.8, 22490},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.476, 1.20, 73.7, 19454},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.278, 0.44, 70.8, 57775},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.528, 1.10, 66.9, 2983},
    {Pairs::kTen, "cam", "mode=sparse", 0.309, 0.12, 32.7, 308},
    {Pairs::kTen, "cam", "mode=dense", 0.805, 2.79, 79.8, 4916},
    {Pairs::kTen, "cam", "mode=full", 1.589, 7.19, 100.0, 16023},
    {Pairs::kTen, "cam", "preset=fast", 0.547, 1.21, 63.8, 2387},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.321, 0.48, 64.4, 14690},
    {Pairs::kTen, "cam2x", "mode=dense", 0.521, 1.44, 75.3, 20247},
    {Pairs::kTen, "cam2x", "preset=fast", 0.353, 0.50, 62.8, 8566},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.389, 0.61, 65.1, 7791},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.486, 0.86, 64.1, 2837},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.610, 1.48, 67.0, 15605},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.314, 0.59, 65.8, 8147},
    {Pairs::kFurther, "clean", "mode=dense", 0.496, 1.73, 79.7, 16104},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 0.971, 4.45, 51.5, 120874},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.741, 2.83, 61.7, 0},
    {Pairs::kFurther, "clean", "mode=full", 0.942, 5.69, 100.0, 28385},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.313, 0.56, 64.8, 8666},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.317, 0.61, 65.8, 8147},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.319, 0.63, 65.6, 7738},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.323, 0.58, 65.0, 9335},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.446, 0.84, 46.9, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.515, 0.99, 34.3, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.467, 0.80, 50.5, 18482},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.604, 1.41, 35.8, 45489},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.548, 1.32, 28.5, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.416, 1.03, 40.1, 136144},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.503, 1.58, 66.4, 11140},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.627, 2.28, 66.1, 13468},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.313, 0.61, 64.1, 37784},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.569, 1.30, 53.8, 5015},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.357, 0.57, 51.4, 17095},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.249, 1.35, 74.4, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.352, 2.52, 89.4, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.252, 1.35, 74.4, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.257, 1.33, 74.5, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.400, 2.02, 68.8, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.386, 1.56, 59.3, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.484, 1.75, 60.5, 6439},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.588, 3.39, 58.0, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.223, 0.98, 72.9, 9242},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.277, 1.11, 71.6, 13907},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.357, 2.48, 80.4, 0},
};

inline constexpr EqualErrorFigures kEqualErrorFigures[] = {
    {Pairs::kTen, "clean", 78.5},
    {Pairs::kTen, "jpeg=50", 69.0},
    {Pairs::kTen, "soft2x", 75.2},
    {Pairs::kTen, "cam", 65.2},
    {Pairs::kTen, "cam2x", 69.9},
    {Pairs::kFurther, "clean", 69.6},
    {Pairs::kFurther, "jpeg=50", 51.2},
    {Pairs::kFurther, "soft2x", 67.2},
    {Pairs::kFurther, "cam", 50.0},
    {Pairs::kFurther, "cam2x", 55.2},
};
// clang-format on

}  // namespace mtstereo::tests
