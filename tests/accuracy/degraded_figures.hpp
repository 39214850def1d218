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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.297, 0.40, 72.2, 13971},
    {Pairs::kTen, "clean", "mode=sparse", 0.229, 0.05, 44.8, 2873},
    {Pairs::kTen, "clean", "mode=dense", 0.478, 1.28, 83.1, 25321},
    {Pairs::kTen, "clean", "preset=fast", 0.323, 0.54, 67.6, 12257},
    {Pairs::kTen, "clean", "mode=full", 1.114, 4.62, 100.0, 61052},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.298, 0.40, 71.8, 12087},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.297, 0.40, 72.3, 13142},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.230, 0.05, 44.8, 2683},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.477, 1.27, 83.1, 24344},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.323, 0.53, 67.5, 11613},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.298, 0.40, 72.1, 12334},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.316, 0.41, 72.1, 12777},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.407, 0.65, 59.6, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.253, 0.11, 28.0, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.636, 1.80, 72.5, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.678, 7.95, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.409, 0.61, 50.3, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.494, 0.90, 46.3, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.446, 0.74, 64.2, 23265},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.558, 0.99, 48.6, 66039},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.381, 0.04, 14.3, 9969},
    {Pairs::kTen, "jpeg=20", "mode=dense", 0.825, 2.53, 63.0, 118990},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.070, 11.88, 100.0, 471036},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.632, 1.22, 46.6, 75315},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.522, 1.03, 39.1, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.281, 0.18, 7.2, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.014, 4.13, 58.4, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.475, 12.89, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.613, 1.39, 32.4, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.321, 0.55, 56.8, 143288},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.237, 0.05, 29.6, 29602},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.453, 1.24, 68.2, 255182},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.370, 0.89, 55.5, 182624},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.373, 0.69, 73.0, 21886},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.465, 1.15, 72.7, 20618},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.264, 0.40, 70.4, 58321},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.526, 1.09, 66.0, 2399},
    {Pairs::kTen, "cam", "mode=sparse", 0.302, 0.11, 32.1, 276},
    {Pairs::kTen, "cam", "mode=dense", 0.814, 2.70, 79.3, 4394},
    {Pairs::kTen, "cam", "mode=full", 1.624, 7.36, 100.0, 15790},
    {Pairs::kTen, "cam", "preset=fast", 0.555, 1.33, 63.3, 2371},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.323, 0.49, 63.2, 14483},
    {Pairs::kTen, "cam2x", "mode=dense", 0.534, 1.50, 75.2, 20348},
    {Pairs::kTen, "cam2x", "preset=fast", 0.343, 0.46, 61.8, 8796},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.382, 0.57, 64.0, 7526},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.457, 0.73, 61.9, 2260},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.626, 1.50, 65.6, 12087},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.312, 0.59, 65.4, 8538},
    {Pairs::kFurther, "clean", "mode=dense", 0.495, 1.68, 79.4, 16604},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 0.963, 4.39, 51.5, 119681},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.752, 2.87, 61.3, 0},
    {Pairs::kFurther, "clean", "mode=full", 0.937, 5.56, 100.0, 28390},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.311, 0.54, 64.5, 8336},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.313, 0.60, 65.3, 8373},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.315, 0.63, 65.1, 7945},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.324, 0.54, 64.9, 9426},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.444, 0.85, 45.9, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.511, 1.05, 33.1, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.461, 0.77, 49.3, 16044},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.592, 1.26, 33.8, 36945},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.489, 0.92, 25.6, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.411, 0.90, 40.0, 135356},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.475, 1.24, 64.6, 9849},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.582, 1.84, 63.7, 13713},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.304, 0.56, 62.5, 36060},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.564, 1.24, 52.5, 3735},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.367, 0.67, 49.5, 13857},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.242, 1.27, 74.3, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.349, 2.45, 88.4, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.246, 1.27, 74.3, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.252, 1.29, 74.4, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.398, 2.06, 67.6, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.398, 1.80, 58.8, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.490, 1.76, 59.6, 6166},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.577, 3.51, 53.2, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.221, 0.98, 72.3, 7069},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.277, 1.16, 70.7, 13203},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.337, 2.27, 77.8, 0},
};

inline constexpr EqualErrorFigures kEqualErrorFigures[] = {
    {Pairs::kTen, "clean", 78.4},
    {Pairs::kTen, "jpeg=50", 67.2},
    {Pairs::kTen, "soft2x", 75.0},
    {Pairs::kTen, "cam", 64.6},
    {Pairs::kTen, "cam2x", 67.7},
    {Pairs::kFurther, "clean", 69.1},
    {Pairs::kFurther, "jpeg=50", 50.4},
    {Pairs::kFurther, "soft2x", 65.9},
    {Pairs::kFurther, "cam", 49.0},
    {Pairs::kFurther, "cam2x", 51.7},
};
// clang-format on

}  // namespace mtstereo::tests
