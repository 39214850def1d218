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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.297, 0.42, 71.3, 11705},
    {Pairs::kTen, "clean", "mode=sparse", 0.228, 0.05, 45.3, 3265},
    {Pairs::kTen, "clean", "mode=dense", 0.511, 1.52, 82.7, 22554},
    {Pairs::kTen, "clean", "preset=fast", 0.316, 0.60, 65.6, 6068},
    {Pairs::kTen, "clean", "mode=full", 1.358, 5.54, 100.0, 62666},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.300, 0.43, 70.9, 10690},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.299, 0.42, 71.3, 11000},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.229, 0.05, 45.4, 3063},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.513, 1.52, 82.7, 21734},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.315, 0.59, 65.5, 5651},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.299, 0.43, 71.2, 10316},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.320, 0.46, 71.1, 10422},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.387, 0.62, 58.2, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.267, 0.06, 23.0, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.651, 1.96, 72.4, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.745, 8.53, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.398, 0.65, 48.1, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.456, 0.82, 43.5, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.424, 0.65, 61.0, 20066},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.553, 1.02, 45.8, 65316},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.371, 0.07, 13.4, 16533},
    {Pairs::kTen, "jpeg=20", "mode=dense", 0.972, 3.82, 65.0, 139463},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.142, 11.95, 100.0, 483058},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.616, 1.21, 41.5, 44958},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.544, 1.19, 38.5, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.313, 0.27, 9.2, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.064, 4.39, 59.9, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.605, 13.75, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.624, 1.68, 31.1, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.326, 0.60, 57.0, 148566},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.241, 0.05, 30.9, 34500},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.504, 1.63, 69.0, 255041},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.361, 0.80, 51.9, 93305},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.385, 0.81, 73.0, 15524},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.453, 1.17, 71.4, 10876},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.268, 0.45, 70.3, 45396},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.513, 1.04, 62.0, 1816},
    {Pairs::kTen, "cam", "mode=sparse", 0.309, 0.12, 26.0, 142},
    {Pairs::kTen, "cam", "mode=dense", 0.885, 2.95, 77.1, 3911},
    {Pairs::kTen, "cam", "mode=full", 1.974, 8.70, 100.0, 17679},
    {Pairs::kTen, "cam", "preset=fast", 0.510, 1.04, 56.6, 889},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.312, 0.47, 57.0, 3724},
    {Pairs::kTen, "cam2x", "mode=dense", 0.559, 1.49, 71.9, 15772},
    {Pairs::kTen, "cam2x", "preset=fast", 0.288, 0.25, 49.4, 1525},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.387, 0.63, 59.4, 3010},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.458, 0.81, 57.1, 1167},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.624, 1.70, 63.6, 8163},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.293, 0.51, 62.9, 5990},
    {Pairs::kFurther, "clean", "mode=dense", 0.505, 1.90, 78.7, 13935},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 1.105, 5.99, 51.9, 131502},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.725, 2.73, 60.0, 0},
    {Pairs::kFurther, "clean", "mode=full", 1.143, 7.36, 100.0, 28531},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.295, 0.51, 62.1, 6324},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.295, 0.53, 62.9, 5858},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.298, 0.55, 62.9, 5469},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.311, 0.56, 62.8, 7142},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.400, 0.60, 42.8, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.454, 0.76, 28.7, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.501, 1.31, 48.4, 18783},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.647, 2.13, 31.9, 38349},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.512, 1.08, 25.4, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.383, 0.82, 38.2, 110154},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.488, 1.42, 64.6, 6412},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.576, 1.83, 62.4, 6585},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.298, 0.60, 61.7, 26281},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.563, 1.18, 48.9, 1091},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.355, 0.64, 45.4, 5983},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.242, 1.29, 73.4, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.367, 2.75, 87.9, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.246, 1.30, 73.4, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.252, 1.29, 72.9, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.377, 2.01, 65.7, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.409, 2.18, 57.2, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.485, 1.62, 56.4, 6401},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.613, 4.11, 52.0, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.216, 0.92, 71.0, 5807},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.278, 1.48, 67.0, 2943},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.354, 2.52, 78.6, 0},
};

inline constexpr EqualErrorFigures kEqualErrorFigures[] = {
    {Pairs::kTen, "clean", 77.1},
    {Pairs::kTen, "jpeg=50", 65.2},
    {Pairs::kTen, "soft2x", 74.9},
    {Pairs::kTen, "cam", 60.8},
    {Pairs::kTen, "cam2x", 64.8},
    {Pairs::kFurther, "clean", 68.0},
    {Pairs::kFurther, "jpeg=50", 42.0},
    {Pairs::kFurther, "soft2x", 65.0},
    {Pairs::kFurther, "cam", 44.9},
    {Pairs::kFurther, "cam2x", 48.1},
};
// clang-format on

}  // namespace mtstereo::tests
