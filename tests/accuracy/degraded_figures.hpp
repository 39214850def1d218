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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.301, 0.40, 72.2, 13915},
    {Pairs::kTen, "clean", "mode=sparse", 0.232, 0.04, 45.4, 3536},
    {Pairs::kTen, "clean", "mode=dense", 0.476, 1.29, 83.0, 24723},
    {Pairs::kTen, "clean", "preset=fast", 0.327, 0.59, 68.2, 12882},
    {Pairs::kTen, "clean", "mode=full", 1.081, 4.54, 100.0, 61185},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.306, 0.44, 71.7, 12023},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.302, 0.40, 72.2, 13173},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.232, 0.04, 45.5, 3359},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.475, 1.29, 83.0, 24681},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.328, 0.59, 68.2, 12183},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.302, 0.41, 72.1, 12353},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.322, 0.44, 72.2, 13122},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.406, 0.64, 60.3, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.261, 0.09, 29.0, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.617, 1.72, 72.4, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.680, 8.01, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.409, 0.61, 50.8, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.485, 0.84, 47.2, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.449, 0.73, 65.5, 29762},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.562, 0.97, 50.6, 73993},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.382, 0.04, 13.0, 9109},
    {Pairs::kTen, "jpeg=20", "mode=dense", 0.806, 2.50, 63.0, 119669},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.084, 11.75, 100.0, 472007},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.617, 1.09, 44.7, 69252},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.530, 1.09, 42.0, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.298, 0.19, 7.8, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 0.995, 4.02, 59.7, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.595, 13.03, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.565, 1.13, 30.5, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.324, 0.54, 56.8, 144434},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.252, 0.07, 30.4, 32967},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.451, 1.23, 68.2, 256798},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.397, 1.02, 56.3, 192767},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.389, 0.72, 73.6, 22379},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.474, 1.20, 73.5, 19126},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.276, 0.44, 70.7, 58526},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.525, 1.10, 66.6, 2955},
    {Pairs::kTen, "cam", "mode=sparse", 0.308, 0.11, 32.4, 302},
    {Pairs::kTen, "cam", "mode=dense", 0.795, 2.70, 79.5, 4360},
    {Pairs::kTen, "cam", "mode=full", 1.586, 7.21, 100.0, 15910},
    {Pairs::kTen, "cam", "preset=fast", 0.547, 1.22, 63.6, 2324},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.317, 0.45, 64.2, 14501},
    {Pairs::kTen, "cam2x", "mode=dense", 0.516, 1.41, 75.2, 20131},
    {Pairs::kTen, "cam2x", "preset=fast", 0.351, 0.50, 62.6, 8754},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.385, 0.58, 64.8, 7743},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.483, 0.85, 63.9, 2879},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.602, 1.42, 66.8, 15875},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.313, 0.57, 65.5, 8115},
    {Pairs::kFurther, "clean", "mode=dense", 0.493, 1.71, 79.4, 15900},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 0.957, 4.29, 50.9, 117706},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.731, 2.74, 61.2, 0},
    {Pairs::kFurther, "clean", "mode=full", 0.938, 5.65, 100.0, 28378},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.310, 0.54, 64.6, 8588},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.314, 0.59, 65.5, 8134},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.316, 0.60, 65.4, 7689},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.321, 0.55, 64.8, 9265},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.443, 0.83, 46.7, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.516, 1.02, 34.0, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.463, 0.78, 50.2, 18023},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.601, 1.39, 35.5, 44445},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.542, 1.24, 28.2, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.412, 0.95, 40.0, 137915},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.498, 1.53, 66.0, 11275},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.624, 2.26, 66.1, 13525},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.311, 0.60, 63.9, 37622},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.571, 1.31, 53.6, 5088},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.352, 0.55, 51.1, 16817},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.249, 1.36, 74.1, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.351, 2.51, 89.0, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.252, 1.36, 74.1, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.257, 1.32, 74.2, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.399, 2.01, 68.5, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.387, 1.55, 58.8, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.483, 1.73, 60.0, 6225},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.584, 3.33, 57.7, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.223, 0.98, 72.6, 9214},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.276, 1.07, 71.2, 13796},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.355, 2.46, 80.2, 0},
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
