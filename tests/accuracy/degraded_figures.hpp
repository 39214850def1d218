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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.298, 0.43, 71.3, 11488},
    {Pairs::kTen, "clean", "mode=sparse", 0.222, 0.06, 18.3, 1788},
    {Pairs::kTen, "clean", "mode=dense", 0.515, 1.54, 82.9, 22282},
    {Pairs::kTen, "clean", "preset=fast", 0.315, 0.60, 65.5, 6068},
    {Pairs::kTen, "clean", "mode=full", 1.358, 5.54, 100.0, 62666},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.301, 0.43, 70.8, 10258},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.300, 0.43, 71.3, 10690},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.223, 0.06, 18.2, 1680},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.517, 1.54, 82.9, 21495},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.315, 0.59, 65.4, 5651},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.300, 0.44, 71.1, 10057},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.321, 0.46, 70.9, 9399},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.382, 0.60, 57.6, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.254, 0.07, 5.2, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.659, 2.02, 72.9, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.745, 8.53, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.398, 0.65, 48.0, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.449, 0.78, 42.7, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.415, 0.64, 60.4, 18903},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.553, 1.15, 44.3, 65909},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.541, 0.64, 2.9, 5541},
    {Pairs::kTen, "jpeg=20", "mode=dense", 1.040, 4.68, 69.3, 170489},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.143, 11.95, 100.0, 483073},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.616, 1.20, 41.4, 44958},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.549, 1.22, 38.6, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.369, 0.83, 4.0, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.082, 4.53, 60.7, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.605, 13.75, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.624, 1.68, 31.1, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.322, 0.58, 56.6, 140201},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.260, 0.25, 11.3, 23485},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.508, 1.65, 69.2, 255186},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.360, 0.79, 51.8, 93274},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.368, 0.74, 71.6, 12120},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.427, 0.98, 69.5, 10098},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.245, 0.33, 67.8, 38118},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.478, 0.85, 58.3, 1272},
    {Pairs::kTen, "cam", "mode=sparse", 0.305, 0.15, 6.0, 12},
    {Pairs::kTen, "cam", "mode=dense", 0.903, 3.05, 77.7, 4111},
    {Pairs::kTen, "cam", "mode=full", 1.974, 8.70, 100.0, 17679},
    {Pairs::kTen, "cam", "preset=fast", 0.509, 1.03, 56.5, 889},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.284, 0.32, 52.2, 1845},
    {Pairs::kTen, "cam2x", "mode=dense", 0.554, 1.47, 72.1, 15986},
    {Pairs::kTen, "cam2x", "preset=fast", 0.287, 0.24, 49.4, 1525},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.339, 0.42, 54.9, 1462},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.448, 0.77, 56.4, 980},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.548, 1.29, 59.0, 5091},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.298, 0.55, 63.2, 5375},
    {Pairs::kFurther, "clean", "mode=dense", 0.510, 1.93, 78.9, 13810},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 1.277, 8.28, 57.2, 174117},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.738, 2.86, 60.6, 0},
    {Pairs::kFurther, "clean", "mode=full", 1.143, 7.36, 100.0, 28531},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.299, 0.53, 62.3, 5398},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.299, 0.56, 63.2, 5268},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.301, 0.57, 63.0, 4882},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.311, 0.55, 62.8, 5681},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.399, 0.59, 42.7, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.454, 0.75, 28.5, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.527, 1.81, 48.3, 21469},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.692, 2.85, 30.2, 42979},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.518, 1.12, 25.6, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.371, 0.79, 38.3, 106586},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.457, 1.21, 62.5, 5097},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.520, 1.38, 59.3, 4603},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.270, 0.45, 58.6, 18166},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.538, 1.04, 46.3, 732},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.297, 0.33, 40.0, 2961},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.245, 1.33, 73.6, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.369, 2.78, 88.3, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.249, 1.33, 73.6, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.254, 1.32, 73.1, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.378, 1.99, 65.9, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.409, 2.18, 57.2, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.505, 1.77, 56.3, 7934},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.622, 4.22, 52.8, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.220, 0.96, 71.3, 6103},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.278, 1.48, 67.0, 2943},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.339, 2.30, 77.2, 0},
};

inline constexpr EqualErrorFigures kEqualErrorFigures[] = {
    {Pairs::kTen, "clean", 77.1},
    {Pairs::kTen, "soft2x", 74.8},
    {Pairs::kTen, "cam", 60.0},
    {Pairs::kTen, "cam2x", 64.6},
    {Pairs::kFurther, "clean", 67.9},
    {Pairs::kFurther, "soft2x", 64.4},
    {Pairs::kFurther, "cam", 44.4},
    {Pairs::kFurther, "cam2x", 48.4},
};
// clang-format on

}  // namespace mtstereo::tests
