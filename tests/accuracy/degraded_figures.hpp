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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.297, 0.40, 72.2, 14001},
    {Pairs::kTen, "clean", "mode=sparse", 0.229, 0.05, 44.8, 2873},
    {Pairs::kTen, "clean", "mode=dense", 0.478, 1.28, 83.1, 25321},
    {Pairs::kTen, "clean", "preset=fast", 0.323, 0.54, 67.6, 12257},
    {Pairs::kTen, "clean", "mode=full", 1.114, 4.62, 100.0, 61052},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.297, 0.40, 71.8, 12203},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.297, 0.40, 72.3, 13173},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.230, 0.05, 44.8, 2683},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.477, 1.27, 83.1, 24344},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.323, 0.53, 67.5, 11613},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.298, 0.40, 72.1, 12361},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.316, 0.41, 72.1, 12941},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.407, 0.65, 59.7, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.253, 0.11, 28.0, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.636, 1.80, 72.5, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.678, 7.95, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.409, 0.61, 50.3, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.494, 0.90, 46.3, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.453, 0.76, 63.4, 21213},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.561, 0.98, 47.7, 66343},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.382, 0.03, 12.9, 7989},
    {Pairs::kTen, "jpeg=20", "mode=dense", 0.883, 2.93, 63.1, 129920},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.108, 12.09, 100.0, 472187},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.630, 1.22, 46.5, 74724},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.567, 1.25, 41.3, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.306, 0.28, 8.7, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.072, 4.53, 58.9, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.572, 13.39, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.668, 1.75, 34.5, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.319, 0.53, 56.8, 143374},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.237, 0.05, 29.6, 29602},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.453, 1.24, 68.2, 255182},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.370, 0.89, 55.5, 182624},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.377, 0.70, 73.1, 21778},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.472, 1.18, 72.9, 20716},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.276, 0.46, 71.1, 60069},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.537, 1.06, 64.3, 2558},
    {Pairs::kTen, "cam", "mode=sparse", 0.310, 0.12, 29.8, 156},
    {Pairs::kTen, "cam", "mode=dense", 0.861, 2.77, 77.6, 4681},
    {Pairs::kTen, "cam", "mode=full", 1.669, 7.44, 100.0, 16291},
    {Pairs::kTen, "cam", "preset=fast", 0.555, 1.33, 63.3, 2378},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.322, 0.46, 60.0, 9666},
    {Pairs::kTen, "cam2x", "mode=dense", 0.517, 1.28, 71.4, 18597},
    {Pairs::kTen, "cam2x", "preset=fast", 0.343, 0.46, 61.7, 8773},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.406, 0.65, 62.2, 5950},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.475, 0.82, 59.9, 1959},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.628, 1.56, 65.4, 11219},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.312, 0.59, 65.4, 8538},
    {Pairs::kFurther, "clean", "mode=dense", 0.495, 1.68, 79.4, 16604},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 0.981, 4.57, 49.1, 115777},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.752, 2.87, 61.3, 0},
    {Pairs::kFurther, "clean", "mode=full", 0.937, 5.56, 100.0, 28390},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.311, 0.54, 64.5, 8337},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.312, 0.59, 65.3, 8374},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.315, 0.62, 65.1, 7946},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.324, 0.54, 64.9, 9431},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.444, 0.85, 45.9, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.512, 1.06, 33.1, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.465, 0.78, 48.7, 15908},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.588, 1.28, 32.7, 35154},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.565, 1.45, 27.9, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.408, 0.88, 40.0, 135135},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.483, 1.31, 65.0, 10074},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.585, 1.89, 63.9, 13897},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.306, 0.58, 62.8, 38452},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.587, 1.36, 51.4, 2792},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.371, 0.69, 48.2, 11575},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.242, 1.27, 74.3, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.349, 2.45, 88.4, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.246, 1.27, 74.3, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.253, 1.29, 74.4, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.398, 2.07, 67.6, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.398, 1.80, 58.8, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.499, 1.76, 58.1, 5386},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.622, 3.87, 56.3, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.221, 0.98, 72.3, 7084},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.277, 1.16, 70.7, 13203},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.342, 2.34, 78.3, 0},
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
