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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.290, 0.37, 73.5, 20320},
    {Pairs::kTen, "clean", "mode=sparse", 0.212, 0.04, 49.3, 5620},
    {Pairs::kTen, "clean", "mode=dense", 0.453, 1.18, 84.0, 25873},
    {Pairs::kTen, "clean", "preset=fast", 0.329, 0.61, 69.8, 13021},
    {Pairs::kTen, "clean", "mode=full", 1.016, 4.31, 100.0, 61172},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.294, 0.37, 73.0, 18543},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.290, 0.37, 73.4, 19514},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.212, 0.04, 49.1, 5305},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.454, 1.18, 84.0, 24729},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.328, 0.61, 69.8, 12411},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.290, 0.37, 73.3, 18537},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.312, 0.39, 73.6, 18625},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.412, 0.68, 62.8, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.254, 0.09, 33.4, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.617, 1.72, 74.8, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.553, 7.43, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.425, 0.68, 52.1, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.510, 0.96, 49.0, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.436, 0.67, 66.6, 31935},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.576, 1.02, 51.6, 85338},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.392, 0.02, 14.0, 12847},
    {Pairs::kTen, "jpeg=20", "mode=dense", 0.813, 2.49, 65.3, 125163},
    {Pairs::kTen, "jpeg=20", "mode=full", 1.935, 10.98, 100.0, 472742},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.639, 1.26, 47.6, 69377},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.560, 1.25, 43.7, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.287, 0.17, 8.7, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 0.963, 3.77, 59.7, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.537, 12.72, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.560, 1.17, 30.6, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.324, 0.54, 58.2, 167176},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.250, 0.07, 31.7, 41636},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.468, 1.26, 69.0, 254290},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.380, 0.78, 56.1, 177039},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.403, 0.93, 76.2, 25750},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.497, 1.48, 76.3, 21783},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.291, 0.54, 73.0, 75496},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.531, 1.20, 69.9, 3076},
    {Pairs::kTen, "cam", "mode=sparse", 0.304, 0.17, 38.5, 338},
    {Pairs::kTen, "cam", "mode=dense", 0.768, 2.67, 81.5, 4313},
    {Pairs::kTen, "cam", "mode=full", 1.535, 6.77, 100.0, 15953},
    {Pairs::kTen, "cam", "preset=fast", 0.576, 1.42, 68.4, 2625},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.334, 0.57, 66.9, 17197},
    {Pairs::kTen, "cam2x", "mode=dense", 0.529, 1.53, 78.0, 20997},
    {Pairs::kTen, "cam2x", "preset=fast", 0.356, 0.51, 66.1, 10923},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.404, 0.76, 67.9, 8088},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.467, 0.79, 65.6, 3129},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.598, 1.50, 69.7, 20276},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.309, 0.47, 67.7, 10012},
    {Pairs::kFurther, "clean", "mode=dense", 0.479, 1.47, 80.7, 15441},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 0.950, 4.19, 53.4, 124420},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.715, 2.50, 64.5, 0},
    {Pairs::kFurther, "clean", "mode=full", 0.883, 4.89, 100.0, 28410},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.308, 0.44, 66.6, 10194},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.310, 0.48, 67.7, 9853},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.311, 0.48, 67.5, 9489},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.317, 0.48, 66.7, 11107},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.449, 0.83, 49.5, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.519, 0.86, 36.2, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.455, 0.69, 52.7, 22001},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.621, 1.36, 37.3, 54852},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.550, 1.33, 29.1, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.422, 1.00, 42.2, 155275},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.503, 1.52, 69.0, 15951},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.667, 2.35, 69.7, 15283},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.317, 0.70, 65.4, 52379},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.586, 1.37, 57.7, 6000},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.387, 0.85, 55.0, 23002},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.226, 1.10, 74.9, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.337, 2.43, 89.6, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.230, 1.10, 74.9, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.229, 1.04, 74.6, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.384, 1.83, 69.1, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.381, 1.40, 59.2, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.486, 1.58, 58.4, 6515},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.580, 3.17, 57.9, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.194, 0.73, 71.6, 7457},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.276, 1.22, 71.7, 11984},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.355, 2.67, 81.0, 0},
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
