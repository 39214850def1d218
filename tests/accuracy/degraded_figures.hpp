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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.295, 0.40, 65.7, 27909},
    {Pairs::kTen, "clean", "mode=sparse", 0.235, 0.04, 14.2, 2570},
    {Pairs::kTen, "clean", "mode=dense", 0.592, 2.05, 80.4, 37037},
    {Pairs::kTen, "clean", "preset=fast", 0.337, 0.61, 65.5, 28591},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.291, 0.36, 64.5, 26197},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.295, 0.40, 65.7, 27333},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.235, 0.04, 14.2, 2442},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.586, 2.02, 80.4, 36180},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.337, 0.60, 65.4, 28065},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.295, 0.40, 65.5, 26650},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.312, 0.39, 64.8, 24896},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.317, 0.39, 27.7, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.245, 0.16, 0.2, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.695, 2.25, 56.4, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.427, 0.68, 46.3, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.322, 0.42, 7.3, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.522, 1.09, 43.6, 42594},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.923, 3.92, 25.6, 102447},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 1.246, 6.31, 2.5, 26954},
    {Pairs::kTen, "jpeg=20", "mode=dense", 1.297, 6.29, 59.1, 215238},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.712, 1.87, 42.3, 107762},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.507, 1.47, 10.8, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.236, 0.16, 0.6, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.610, 7.96, 44.2, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.721, 1.94, 27.2, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.599, 2.75, 57.8, 265238},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.340, 0.83, 9.0, 35559},
    {Pairs::kTen, "bright=1.8", "mode=dense", 1.021, 5.13, 73.8, 393687},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.656, 3.16, 60.5, 342433},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.375, 0.65, 67.7, 25437},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.457, 0.95, 65.9, 23957},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.300, 0.61, 59.7, 17955},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.306, 0.61, 57.8, 16930},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.301, 0.61, 59.6, 17652},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.302, 0.61, 59.4, 17323},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.309, 0.57, 58.3, 15609},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.305, 0.31, 20.1, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.306, 0.23, 7.0, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.896, 5.46, 37.3, 48865},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 1.685, 11.17, 22.7, 102280},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.613, 2.31, 7.3, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 2.280, 14.31, 47.5, 463282},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.428, 1.17, 58.6, 15607},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.551, 1.77, 55.5, 12729},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.224, 0.83, 63.0, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.228, 0.83, 63.0, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.234, 0.82, 63.4, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.309, 0.89, 37.7, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.398, 1.98, 55.7, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.639, 2.10, 39.7, 16763},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.580, 4.10, 11.3, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.220, 0.73, 66.8, 15947},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.274, 1.35, 69.9, 19077},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.305, 1.60, 70.6, 0},
};
// clang-format on

}  // namespace mtstereo::tests
