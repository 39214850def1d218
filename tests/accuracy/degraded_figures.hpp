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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.302, 0.40, 72.4, 17006},
    {Pairs::kTen, "clean", "mode=sparse", 0.213, 0.04, 47.4, 4483},
    {Pairs::kTen, "clean", "mode=dense", 0.476, 1.29, 83.0, 24723},
    {Pairs::kTen, "clean", "preset=fast", 0.327, 0.59, 68.2, 12882},
    {Pairs::kTen, "clean", "mode=full", 1.081, 4.54, 100.0, 61185},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.307, 0.45, 71.9, 14801},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.303, 0.41, 72.4, 16359},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.214, 0.04, 47.4, 4283},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.475, 1.29, 83.0, 24681},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.328, 0.59, 68.2, 12183},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.303, 0.41, 72.3, 15524},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.323, 0.44, 72.5, 16780},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.411, 0.66, 60.6, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.252, 0.09, 30.9, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.617, 1.72, 72.4, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.680, 8.01, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.409, 0.61, 50.8, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.491, 0.86, 47.8, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.451, 0.70, 65.6, 32568},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.563, 0.97, 50.2, 78030},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.379, 0.04, 13.9, 9289},
    {Pairs::kTen, "jpeg=20", "mode=dense", 0.806, 2.50, 63.0, 119669},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.084, 11.75, 100.0, 472007},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.617, 1.09, 44.7, 69252},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.535, 1.11, 42.4, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.292, 0.19, 8.3, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 0.995, 4.02, 59.7, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.595, 13.03, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.565, 1.13, 30.5, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.327, 0.55, 57.6, 162440},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.249, 0.07, 31.1, 35611},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.451, 1.23, 68.2, 256798},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.397, 1.02, 56.3, 192767},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.403, 0.82, 74.4, 24011},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.480, 1.26, 73.8, 19490},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.277, 0.44, 70.7, 57295},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.526, 1.11, 66.7, 2957},
    {Pairs::kTen, "cam", "mode=sparse", 0.308, 0.12, 32.6, 302},
    {Pairs::kTen, "cam", "mode=dense", 0.795, 2.70, 79.5, 4360},
    {Pairs::kTen, "cam", "mode=full", 1.586, 7.21, 100.0, 15910},
    {Pairs::kTen, "cam", "preset=fast", 0.547, 1.22, 63.6, 2324},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.317, 0.45, 64.2, 14501},
    {Pairs::kTen, "cam2x", "mode=dense", 0.516, 1.41, 75.2, 20131},
    {Pairs::kTen, "cam2x", "preset=fast", 0.351, 0.50, 62.6, 8754},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.385, 0.58, 64.8, 7743},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.487, 0.86, 64.1, 3189},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.603, 1.43, 66.8, 15880},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.314, 0.57, 65.7, 9758},
    {Pairs::kFurther, "clean", "mode=dense", 0.493, 1.71, 79.4, 15900},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 0.957, 4.29, 50.9, 117706},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.731, 2.74, 61.2, 0},
    {Pairs::kFurther, "clean", "mode=full", 0.938, 5.65, 100.0, 28378},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.311, 0.54, 64.7, 9869},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.316, 0.60, 65.7, 9780},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.318, 0.61, 65.6, 9318},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.325, 0.60, 65.2, 9997},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.446, 0.84, 46.9, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.519, 1.01, 34.4, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.457, 0.73, 50.0, 19295},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.601, 1.43, 35.8, 50031},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.542, 1.25, 28.4, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.412, 0.95, 40.4, 146632},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.515, 1.68, 67.3, 12414},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.630, 2.30, 66.4, 13822},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.312, 0.61, 64.0, 37940},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.573, 1.33, 53.6, 5097},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.352, 0.55, 51.1, 16817},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.249, 1.36, 74.1, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.351, 2.51, 89.0, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.252, 1.36, 74.1, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.257, 1.32, 74.2, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.399, 2.01, 68.5, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.387, 1.55, 58.8, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.489, 1.81, 60.0, 6712},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.584, 3.33, 57.7, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.223, 0.98, 72.6, 9214},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.276, 1.07, 71.2, 13796},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.372, 2.71, 80.8, 0},
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
