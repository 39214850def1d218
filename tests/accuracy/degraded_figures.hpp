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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.301, 0.46, 67.7, 7621},
    {Pairs::kTen, "clean", "mode=sparse", 0.225, 0.05, 16.3, 2232},
    {Pairs::kTen, "clean", "mode=dense", 0.533, 1.57, 82.1, 14221},
    {Pairs::kTen, "clean", "preset=fast", 0.315, 0.60, 65.5, 6068},
    {Pairs::kTen, "clean", "mode=full", 1.378, 5.59, 100.0, 62975},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.309, 0.50, 67.4, 6269},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.301, 0.46, 67.6, 7043},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.226, 0.05, 16.0, 2100},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.534, 1.58, 82.2, 13193},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.315, 0.59, 65.4, 5651},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.301, 0.47, 67.3, 6363},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.322, 0.48, 67.4, 5665},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.370, 0.55, 50.5, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.275, 0.07, 3.2, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.627, 1.81, 72.0, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.823, 8.55, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.398, 0.65, 48.0, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.413, 0.65, 32.9, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.390, 0.60, 56.0, 8827},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.530, 1.05, 38.9, 29798},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.547, 0.52, 2.0, 4606},
    {Pairs::kTen, "jpeg=20", "mode=dense", 1.005, 4.18, 66.1, 125635},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.255, 12.11, 100.0, 482939},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.616, 1.20, 41.4, 44958},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.508, 1.20, 31.3, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.312, 0.51, 2.4, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.033, 3.91, 56.3, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.717, 13.95, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.624, 1.68, 31.1, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.341, 0.70, 54.3, 101086},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.283, 0.41, 10.1, 27470},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.498, 1.61, 66.1, 162632},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.360, 0.79, 51.8, 93274},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.367, 0.70, 65.9, 5568},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.422, 0.95, 63.8, 4337},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.343, 0.73, 59.8, 3908},
    {Pairs::kFurther, "clean", "mode=dense", 0.510, 1.99, 78.9, 9067},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 1.255, 7.72, 54.4, 120094},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.831, 3.84, 60.1, 0},
    {Pairs::kFurther, "clean", "mode=full", 1.211, 7.42, 100.0, 28528},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.345, 0.78, 59.1, 3974},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.343, 0.73, 59.7, 3803},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.343, 0.74, 59.4, 3428},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.345, 0.73, 59.2, 3764},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.400, 0.78, 37.9, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.422, 0.57, 22.9, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.518, 1.74, 45.6, 13187},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.726, 3.10, 29.6, 27565},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.524, 1.19, 21.1, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.425, 1.20, 39.1, 96350},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.439, 1.02, 55.6, 2549},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.507, 1.34, 52.8, 2350},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.269, 1.72, 72.9, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.369, 2.86, 88.6, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.273, 1.72, 72.9, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.269, 1.57, 72.6, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.356, 1.81, 60.1, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.409, 2.18, 57.2, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.531, 2.44, 54.2, 4487},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.621, 4.57, 43.8, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.260, 1.52, 71.9, 4675},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.278, 1.48, 67.0, 2943},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.360, 2.51, 72.8, 0},
};
// clang-format on

}  // namespace mtstereo::tests
