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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.297, 0.42, 71.2, 11539},
    {Pairs::kTen, "clean", "mode=sparse", 0.230, 0.05, 45.1, 3013},
    {Pairs::kTen, "clean", "mode=dense", 0.515, 1.55, 82.9, 22282},
    {Pairs::kTen, "clean", "preset=fast", 0.316, 0.60, 65.6, 6068},
    {Pairs::kTen, "clean", "mode=full", 1.358, 5.54, 100.0, 62666},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.299, 0.43, 70.8, 10402},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.298, 0.42, 71.2, 10737},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.230, 0.05, 45.1, 2824},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.517, 1.55, 82.9, 21495},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.315, 0.59, 65.5, 5651},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.299, 0.42, 71.1, 10094},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.319, 0.45, 71.0, 10233},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.386, 0.62, 58.0, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.267, 0.06, 22.8, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.659, 2.02, 72.9, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.745, 8.53, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.398, 0.65, 48.1, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.454, 0.80, 43.3, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.417, 0.63, 60.9, 20025},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.560, 1.19, 45.2, 70433},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.385, 0.10, 12.7, 19079},
    {Pairs::kTen, "jpeg=20", "mode=dense", 1.040, 4.68, 69.3, 170489},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.143, 11.95, 100.0, 483073},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.616, 1.21, 41.5, 44958},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.544, 1.19, 38.4, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.314, 0.26, 9.1, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.082, 4.53, 60.7, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.605, 13.75, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.624, 1.68, 31.1, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.324, 0.59, 56.7, 142294},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.241, 0.05, 30.7, 33661},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.508, 1.65, 69.2, 255186},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.361, 0.80, 51.9, 93305},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.383, 0.80, 72.8, 15081},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.453, 1.17, 71.4, 10637},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.265, 0.44, 70.1, 43003},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.513, 1.05, 62.0, 1737},
    {Pairs::kTen, "cam", "mode=sparse", 0.310, 0.12, 25.8, 136},
    {Pairs::kTen, "cam", "mode=dense", 0.904, 3.06, 77.7, 4111},
    {Pairs::kTen, "cam", "mode=full", 1.974, 8.70, 100.0, 17679},
    {Pairs::kTen, "cam", "preset=fast", 0.510, 1.04, 56.6, 889},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.312, 0.47, 57.1, 3427},
    {Pairs::kTen, "cam2x", "mode=dense", 0.554, 1.47, 72.1, 15986},
    {Pairs::kTen, "cam2x", "preset=fast", 0.288, 0.25, 49.4, 1525},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.379, 0.60, 59.0, 2711},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.458, 0.81, 57.1, 1136},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.606, 1.62, 63.0, 7198},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.292, 0.51, 62.8, 5538},
    {Pairs::kFurther, "clean", "mode=dense", 0.510, 1.93, 78.9, 13810},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 1.277, 8.28, 57.2, 174117},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.738, 2.86, 60.6, 0},
    {Pairs::kFurther, "clean", "mode=full", 1.143, 7.36, 100.0, 28531},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.294, 0.50, 61.9, 5642},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.294, 0.52, 62.8, 5442},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.297, 0.54, 62.8, 5022},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.310, 0.55, 62.6, 6356},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.400, 0.60, 42.8, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.453, 0.76, 28.6, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.529, 1.84, 48.2, 21613},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.715, 3.04, 30.7, 43639},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.512, 1.08, 25.4, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.374, 0.78, 38.0, 106254},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.483, 1.37, 64.3, 5789},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.567, 1.79, 62.1, 6430},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.296, 0.59, 61.4, 25235},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.571, 1.24, 49.3, 1083},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.356, 0.65, 45.3, 5712},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.243, 1.30, 73.5, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.369, 2.78, 88.3, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.247, 1.30, 73.5, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.253, 1.30, 73.0, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.378, 2.01, 65.8, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.409, 2.18, 57.2, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.509, 1.82, 56.8, 8191},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.615, 4.12, 52.2, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.216, 0.92, 70.9, 5561},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.278, 1.48, 67.0, 2943},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.353, 2.50, 78.5, 0},
};

inline constexpr EqualErrorFigures kEqualErrorFigures[] = {
    {Pairs::kTen, "clean", 77.1},
    {Pairs::kTen, "soft2x", 75.0},
    {Pairs::kTen, "cam", 60.8},
    {Pairs::kTen, "cam2x", 64.8},
    {Pairs::kFurther, "clean", 67.9},
    {Pairs::kFurther, "soft2x", 64.9},
    {Pairs::kFurther, "cam", 44.9},
    {Pairs::kFurther, "cam2x", 48.1},
};
// clang-format on

}  // namespace mtstereo::tests
