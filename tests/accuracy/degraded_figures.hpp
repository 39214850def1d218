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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.294, 0.43, 71.7, 9821},
    {Pairs::kTen, "clean", "mode=sparse", 0.225, 0.05, 16.3, 2232},
    {Pairs::kTen, "clean", "mode=dense", 0.514, 1.55, 82.7, 21475},
    {Pairs::kTen, "clean", "preset=fast", 0.315, 0.60, 65.5, 6068},
    {Pairs::kTen, "clean", "mode=full", 1.360, 5.54, 100.0, 62666},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.299, 0.45, 71.1, 8397},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.294, 0.44, 71.7, 9258},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.226, 0.05, 16.0, 2100},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.515, 1.55, 82.7, 20743},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.315, 0.59, 65.4, 5651},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.295, 0.44, 71.5, 8565},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.314, 0.45, 71.3, 7986},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.398, 0.61, 52.6, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.275, 0.07, 3.2, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.649, 1.97, 71.7, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.839, 8.64, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.398, 0.65, 48.0, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.469, 0.86, 35.4, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.436, 0.66, 54.3, 11920},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.565, 1.05, 34.4, 43637},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.547, 0.52, 2.0, 4606},
    {Pairs::kTen, "jpeg=20", "mode=dense", 1.025, 4.66, 67.7, 158365},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.255, 12.10, 100.0, 483373},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.616, 1.20, 41.4, 44958},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.565, 1.35, 32.2, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.312, 0.51, 2.4, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.013, 4.08, 56.6, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.729, 13.96, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.624, 1.68, 31.1, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.319, 0.59, 56.3, 114633},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.283, 0.41, 10.1, 27470},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.490, 1.57, 68.3, 234097},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.360, 0.79, 51.8, 93274},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.357, 0.66, 71.7, 10575},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.430, 0.95, 68.8, 7352},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.307, 0.56, 64.6, 5080},
    {Pairs::kFurther, "clean", "mode=dense", 0.493, 1.81, 78.4, 12444},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 1.229, 7.67, 54.1, 151240},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.727, 2.73, 59.3, 0},
    {Pairs::kFurther, "clean", "mode=full", 1.246, 7.41, 100.0, 28531},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.313, 0.59, 63.5, 5429},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.307, 0.56, 64.6, 4793},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.307, 0.57, 64.4, 4472},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.317, 0.54, 63.9, 5252},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.418, 0.62, 38.8, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.492, 0.84, 24.3, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.539, 1.66, 43.1, 15268},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.697, 2.67, 23.2, 27747},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.556, 1.13, 21.9, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.370, 0.79, 39.2, 96616},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.444, 1.10, 61.4, 4179},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.517, 1.35, 57.5, 3387},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.230, 1.04, 74.4, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.365, 2.70, 87.8, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.233, 1.04, 74.2, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.243, 1.05, 73.9, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.375, 1.85, 63.0, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.409, 2.18, 57.2, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.598, 2.24, 49.7, 7986},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.667, 4.54, 47.6, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.212, 0.83, 73.1, 6168},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.278, 1.48, 67.0, 2943},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.319, 2.09, 76.0, 0},
};
// clang-format on

}  // namespace mtstereo::tests
