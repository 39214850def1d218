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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.302, 0.41, 72.4, 13892},
    {Pairs::kTen, "clean", "mode=sparse", 0.231, 0.04, 45.9, 3591},
    {Pairs::kTen, "clean", "mode=dense", 0.480, 1.32, 83.1, 22241},
    {Pairs::kTen, "clean", "preset=fast", 0.326, 0.57, 68.4, 12477},
    {Pairs::kTen, "clean", "mode=full", 1.087, 4.57, 100.0, 61175},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.307, 0.45, 71.9, 11785},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.302, 0.41, 72.4, 13151},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.231, 0.04, 45.9, 3384},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.480, 1.31, 83.1, 24487},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.327, 0.57, 68.4, 11864},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.303, 0.41, 72.3, 12326},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.323, 0.45, 72.4, 13207},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.408, 0.65, 60.6, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.260, 0.09, 29.4, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.618, 1.73, 72.6, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.687, 8.06, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.407, 0.60, 51.0, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.490, 0.88, 47.5, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.450, 0.73, 65.7, 29867},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.567, 1.00, 51.0, 74653},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.383, 0.03, 13.3, 9359},
    {Pairs::kTen, "jpeg=20", "mode=dense", 0.808, 2.51, 63.2, 120668},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.059, 11.65, 100.0, 471784},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.617, 1.11, 45.0, 68809},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.532, 1.10, 42.2, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.296, 0.18, 7.9, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.000, 4.05, 59.8, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.593, 13.04, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.571, 1.15, 30.5, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.324, 0.55, 57.0, 145353},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.251, 0.07, 30.8, 33659},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.452, 1.24, 68.3, 257983},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.396, 1.06, 56.6, 194662},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.391, 0.73, 73.8, 22447},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.476, 1.22, 73.7, 19154},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.277, 0.45, 70.8, 57353},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.528, 1.12, 66.8, 2962},
    {Pairs::kTen, "cam", "mode=sparse", 0.308, 0.12, 32.7, 308},
    {Pairs::kTen, "cam", "mode=dense", 0.797, 2.74, 79.6, 4367},
    {Pairs::kTen, "cam", "mode=full", 1.586, 7.21, 100.0, 15686},
    {Pairs::kTen, "cam", "preset=fast", 0.546, 1.21, 63.8, 2356},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.319, 0.47, 64.4, 14554},
    {Pairs::kTen, "cam2x", "mode=dense", 0.520, 1.46, 75.6, 20081},
    {Pairs::kTen, "cam2x", "preset=fast", 0.352, 0.50, 62.8, 8580},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.386, 0.59, 65.0, 7743},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.484, 0.86, 64.1, 2877},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.602, 1.43, 67.0, 15669},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.315, 0.58, 65.7, 8145},
    {Pairs::kFurther, "clean", "mode=dense", 0.493, 1.70, 79.4, 15672},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 0.967, 4.43, 51.3, 120127},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.734, 2.78, 61.5, 0},
    {Pairs::kFurther, "clean", "mode=full", 0.933, 5.59, 100.0, 28381},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.311, 0.54, 64.8, 8684},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.316, 0.60, 65.8, 8146},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.319, 0.62, 65.6, 7733},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.322, 0.56, 65.0, 9408},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.445, 0.84, 46.9, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.516, 0.96, 34.3, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.466, 0.79, 50.5, 18474},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.603, 1.41, 35.8, 45340},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.544, 1.28, 28.4, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.412, 0.95, 40.1, 138295},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.500, 1.53, 66.2, 11124},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.628, 2.28, 66.2, 13487},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.312, 0.61, 64.1, 37776},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.574, 1.33, 53.8, 5016},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.354, 0.55, 51.3, 16948},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.248, 1.34, 74.4, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.351, 2.51, 89.1, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.252, 1.34, 74.4, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.257, 1.33, 74.4, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.400, 2.02, 68.8, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.386, 1.57, 59.0, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.484, 1.75, 60.5, 6428},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.586, 3.36, 57.9, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.223, 0.98, 72.9, 9241},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.275, 1.09, 71.5, 13916},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.358, 2.50, 80.3, 0},
};

inline constexpr EqualErrorFigures kEqualErrorFigures[] = {
    {Pairs::kTen, "clean", 78.5},
    {Pairs::kTen, "jpeg=50", 69.0},
    {Pairs::kTen, "soft2x", 75.2},
    {Pairs::kTen, "cam", 65.0},
    {Pairs::kTen, "cam2x", 69.8},
    {Pairs::kFurther, "clean", 69.4},
    {Pairs::kFurther, "jpeg=50", 51.2},
    {Pairs::kFurther, "soft2x", 67.1},
    {Pairs::kFurther, "cam", 49.9},
    {Pairs::kFurther, "cam2x", 55.2},
};
// clang-format on

}  // namespace mtstereo::tests
