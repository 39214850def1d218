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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.300, 0.44, 64.8, 27392},
    {Pairs::kTen, "clean", "mode=sparse", 0.240, 0.06, 13.9, 2565},
    {Pairs::kTen, "clean", "mode=dense", 0.601, 2.12, 80.0, 36891},
    {Pairs::kTen, "clean", "preset=fast", 0.345, 0.65, 65.1, 28683},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.371, 0.46, 57.0, 25923},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.580, 1.11, 34.5, 25769},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.474, 0.17, 2.6, 1898},
    {Pairs::kTen, "lower-right=1", "mode=dense", 1.299, 4.57, 62.1, 35392},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.600, 1.07, 51.1, 29017},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 1.430, 9.65, 9.0, 24085},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.615, 1.01, 50.4, 25922},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.323, 0.36, 26.3, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.205, 0.00, 0.2, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.701, 2.25, 55.3, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.440, 0.73, 45.6, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.332, 0.47, 6.9, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.537, 1.14, 42.5, 43368},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.964, 4.44, 25.5, 104077},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 1.286, 6.61, 2.6, 27432},
    {Pairs::kTen, "jpeg=20", "mode=dense", 1.330, 6.82, 58.7, 218517},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.721, 1.92, 42.0, 107384},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.516, 1.51, 10.4, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.233, 0.21, 0.6, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.647, 8.52, 42.7, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.731, 2.02, 26.9, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.593, 2.66, 57.7, 280777},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.335, 0.84, 8.9, 36038},
    {Pairs::kTen, "bright=1.8", "mode=dense", 1.036, 5.19, 74.3, 413016},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.657, 3.10, 60.5, 350413},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.332, 0.29, 54.7, 21255},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.372, 0.20, 33.4, 20224},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.307, 0.65, 59.1, 17605},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.391, 0.86, 50.5, 16264},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.699, 3.31, 25.3, 15632},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 2.722, 15.92, 6.9, 12074},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.564, 1.09, 48.4, 12966},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.311, 0.29, 19.2, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.312, 0.19, 6.7, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.901, 5.49, 36.6, 48431},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 1.702, 11.24, 22.5, 103527},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.618, 2.28, 7.0, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 2.269, 14.26, 47.4, 476856},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.356, 0.54, 48.7, 7715},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.453, 0.82, 28.4, 4799},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.224, 0.83, 63.0, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.300, 0.67, 24.6, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.484, 0.67, 57.9, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.309, 0.89, 37.7, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.398, 1.98, 55.7, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.639, 2.10, 39.7, 16763},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.580, 4.10, 11.3, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.220, 0.73, 66.8, 15947},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.274, 1.35, 69.9, 19077},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.256, 0.53, 57.9, 0},
};
// clang-format on

}  // namespace mtstereo::tests
