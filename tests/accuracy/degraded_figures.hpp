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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.302, 0.42, 72.4, 13799},
    {Pairs::kTen, "clean", "mode=sparse", 0.231, 0.04, 46.0, 3594},
    {Pairs::kTen, "clean", "mode=dense", 0.480, 1.31, 83.2, 24272},
    {Pairs::kTen, "clean", "preset=fast", 0.326, 0.58, 68.4, 12339},
    {Pairs::kTen, "clean", "mode=full", 1.086, 4.56, 100.0, 61166},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.308, 0.46, 71.8, 11486},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.303, 0.42, 72.4, 13051},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.231, 0.04, 46.1, 3386},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.481, 1.32, 83.2, 23026},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.327, 0.58, 68.4, 11768},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.303, 0.42, 72.3, 12200},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.324, 0.47, 72.4, 13343},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.408, 0.66, 60.7, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.261, 0.09, 29.4, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.625, 1.77, 72.8, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.674, 8.10, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.409, 0.61, 51.0, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.494, 0.92, 47.6, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.450, 0.74, 65.7, 29752},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.566, 0.99, 50.9, 74438},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.380, 0.03, 13.3, 9297},
    {Pairs::kTen, "jpeg=20", "mode=dense", 0.812, 2.54, 63.5, 122253},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.082, 11.69, 100.0, 471324},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.618, 1.12, 45.1, 69193},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.532, 1.09, 42.2, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.293, 0.18, 7.9, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.004, 4.10, 60.3, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.542, 13.06, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.574, 1.18, 30.7, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.322, 0.52, 57.0, 144559},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.251, 0.07, 30.7, 33885},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.456, 1.29, 68.3, 250213},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.394, 1.06, 56.6, 194923},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.399, 0.78, 73.8, 22197},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.477, 1.19, 73.7, 19962},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.272, 0.42, 70.8, 57430},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.528, 1.11, 66.8, 3064},
    {Pairs::kTen, "cam", "mode=sparse", 0.309, 0.12, 32.8, 308},
    {Pairs::kTen, "cam", "mode=dense", 0.799, 2.73, 79.7, 4904},
    {Pairs::kTen, "cam", "mode=full", 1.586, 7.21, 100.0, 15658},
    {Pairs::kTen, "cam", "preset=fast", 0.544, 1.20, 63.8, 2333},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.324, 0.51, 64.5, 14523},
    {Pairs::kTen, "cam2x", "mode=dense", 0.527, 1.50, 75.8, 20641},
    {Pairs::kTen, "cam2x", "preset=fast", 0.354, 0.50, 62.9, 8741},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.389, 0.61, 65.1, 7814},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.484, 0.86, 64.0, 2764},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.593, 1.33, 66.7, 15990},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.314, 0.58, 65.7, 8149},
    {Pairs::kFurther, "clean", "mode=dense", 0.491, 1.69, 79.7, 17135},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 0.965, 4.45, 51.5, 121922},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.746, 2.93, 61.8, 0},
    {Pairs::kFurther, "clean", "mode=full", 0.945, 5.62, 100.0, 28364},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.312, 0.53, 64.9, 8668},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.315, 0.60, 65.8, 8153},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.316, 0.59, 65.6, 7739},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.322, 0.56, 65.0, 9334},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.441, 0.80, 46.9, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.519, 1.05, 34.4, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.468, 0.82, 50.5, 18072},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.605, 1.39, 36.0, 45718},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.547, 1.31, 28.5, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.405, 0.89, 40.2, 137103},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.499, 1.50, 66.4, 11175},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.615, 2.08, 65.9, 13481},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.312, 0.61, 64.1, 37768},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.565, 1.20, 53.7, 5058},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.357, 0.56, 51.3, 17039},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.248, 1.35, 74.4, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.351, 2.52, 89.4, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.252, 1.35, 74.4, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.257, 1.33, 74.5, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.401, 2.03, 68.9, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.387, 1.57, 59.3, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.485, 1.75, 60.6, 6510},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.590, 3.42, 58.1, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.223, 0.98, 72.9, 9261},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.277, 1.12, 71.6, 13907},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.357, 2.48, 80.4, 0},
};

inline constexpr EqualErrorFigures kEqualErrorFigures[] = {
    {Pairs::kTen, "clean", 78.3},
    {Pairs::kTen, "jpeg=50", 69.1},
    {Pairs::kTen, "soft2x", 75.5},
    {Pairs::kTen, "cam", 65.0},
    {Pairs::kTen, "cam2x", 69.7},
    {Pairs::kFurther, "clean", 69.7},
    {Pairs::kFurther, "jpeg=50", 51.1},
    {Pairs::kFurther, "soft2x", 67.3},
    {Pairs::kFurther, "cam", 50.8},
    {Pairs::kFurther, "cam2x", 55.2},
};
// clang-format on

}  // namespace mtstereo::tests
