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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.300, 0.41, 72.2, 13538},
    {Pairs::kTen, "clean", "mode=sparse", 0.228, 0.05, 45.2, 3295},
    {Pairs::kTen, "clean", "mode=dense", 0.477, 1.27, 83.0, 25738},
    {Pairs::kTen, "clean", "preset=fast", 0.323, 0.58, 67.9, 12410},
    {Pairs::kTen, "clean", "mode=full", 1.109, 4.62, 100.0, 61128},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.302, 0.42, 71.8, 12932},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.301, 0.41, 72.3, 13339},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.229, 0.05, 45.2, 3096},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.477, 1.26, 82.9, 25683},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.323, 0.57, 67.8, 11767},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.302, 0.42, 72.1, 12581},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.319, 0.42, 72.1, 12613},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.385, 0.59, 57.8, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.267, 0.07, 23.0, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.622, 1.76, 71.0, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.689, 8.08, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.417, 0.63, 50.9, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.452, 0.77, 42.9, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.428, 0.65, 61.8, 20627},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.546, 0.93, 45.5, 63487},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.379, 0.07, 13.5, 16491},
    {Pairs::kTen, "jpeg=20", "mode=dense", 0.923, 3.38, 63.1, 130701},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.130, 12.19, 100.0, 472239},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.637, 1.18, 44.5, 78570},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.553, 1.17, 40.9, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.304, 0.26, 9.1, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.069, 4.45, 59.5, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.566, 13.32, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.689, 1.86, 35.7, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.330, 0.60, 58.0, 167154},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.241, 0.05, 30.9, 34380},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.470, 1.37, 69.0, 280094},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.380, 0.94, 55.8, 188513},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.382, 0.76, 73.5, 19256},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.451, 1.09, 72.0, 16696},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.266, 0.43, 70.6, 52446},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.531, 1.05, 64.1, 2380},
    {Pairs::kTen, "cam", "mode=sparse", 0.310, 0.12, 26.0, 143},
    {Pairs::kTen, "cam", "mode=dense", 0.862, 2.83, 77.6, 4634},
    {Pairs::kTen, "cam", "mode=full", 1.634, 7.24, 100.0, 16129},
    {Pairs::kTen, "cam", "preset=fast", 0.557, 1.26, 62.4, 2263},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.314, 0.44, 58.9, 5890},
    {Pairs::kTen, "cam2x", "mode=dense", 0.519, 1.28, 71.0, 17520},
    {Pairs::kTen, "cam2x", "preset=fast", 0.322, 0.37, 57.8, 6317},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.390, 0.62, 61.2, 4985},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.467, 0.76, 59.4, 1885},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.606, 1.50, 64.8, 8647},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.313, 0.59, 64.8, 8617},
    {Pairs::kFurther, "clean", "mode=dense", 0.497, 1.69, 79.3, 17918},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 1.048, 5.34, 49.9, 119020},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.689, 2.39, 58.2, 0},
    {Pairs::kFurther, "clean", "mode=full", 0.937, 5.54, 100.0, 28407},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.311, 0.55, 63.9, 9604},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.312, 0.60, 64.6, 8385},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.315, 0.61, 64.6, 8043},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.329, 0.60, 64.6, 9998},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.397, 0.57, 42.3, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.450, 0.71, 28.3, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.492, 1.21, 48.2, 19067},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.627, 1.82, 31.6, 36501},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.534, 1.16, 27.1, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.380, 0.81, 39.4, 128223},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.486, 1.31, 65.2, 9531},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.563, 1.69, 62.2, 11434},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.302, 0.57, 62.3, 33961},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.573, 1.28, 50.2, 1893},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.367, 0.67, 46.9, 8619},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.241, 1.26, 73.8, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.354, 2.56, 88.3, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.244, 1.26, 73.8, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.253, 1.31, 73.9, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.371, 1.94, 65.5, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.414, 1.89, 59.4, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.481, 1.58, 56.1, 6267},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.612, 3.90, 54.2, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.214, 0.90, 71.4, 7153},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.267, 1.10, 70.7, 13398},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.350, 2.45, 78.9, 0},
};

inline constexpr EqualErrorFigures kEqualErrorFigures[] = {
    {Pairs::kTen, "clean", 77.1},
    {Pairs::kTen, "jpeg=50", 65.3},
    {Pairs::kTen, "soft2x", 74.8},
    {Pairs::kTen, "cam", 60.3},
    {Pairs::kTen, "cam2x", 64.8},
    {Pairs::kFurther, "clean", 67.8},
    {Pairs::kFurther, "jpeg=50", 41.9},
    {Pairs::kFurther, "soft2x", 65.0},
    {Pairs::kFurther, "cam", 44.8},
    {Pairs::kFurther, "cam2x", 48.3},
};
// clang-format on

}  // namespace mtstereo::tests
