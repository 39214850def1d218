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
    {Pairs::kTen, "clean", "mode=semi-dense", 0.293, 0.43, 72.2, 9447},
    {Pairs::kTen, "clean", "mode=sparse", 0.225, 0.05, 16.3, 2232},
    {Pairs::kTen, "clean", "mode=dense", 0.514, 1.55, 82.7, 21475},
    {Pairs::kTen, "clean", "preset=fast", 0.315, 0.60, 65.5, 6068},
    {Pairs::kTen, "clean", "mode=full", 1.357, 5.54, 100.0, 62666},
    {Pairs::kTen, "lower-right=0.5", "mode=semi-dense", 0.299, 0.44, 71.7, 8195},
    {Pairs::kTen, "lower-right=1", "mode=semi-dense", 0.294, 0.43, 72.2, 8860},
    {Pairs::kTen, "lower-right=1", "mode=sparse", 0.226, 0.05, 16.0, 2100},
    {Pairs::kTen, "lower-right=1", "mode=dense", 0.515, 1.55, 82.7, 20743},
    {Pairs::kTen, "lower-right=1", "preset=fast", 0.315, 0.59, 65.4, 5651},
    {Pairs::kTen, "lower-right=2", "mode=semi-dense", 0.295, 0.43, 72.1, 8159},
    {Pairs::kTen, "roll-right=0.2", "mode=semi-dense", 0.314, 0.44, 71.7, 7687},
    {Pairs::kTen, "noise=5", "mode=semi-dense", 0.399, 0.61, 53.8, 0},
    {Pairs::kTen, "noise=5", "mode=sparse", 0.275, 0.07, 3.2, 0},
    {Pairs::kTen, "noise=5", "mode=dense", 0.649, 1.97, 71.7, 0},
    {Pairs::kTen, "noise=5", "mode=full", 1.745, 8.52, 100.0, 0},
    {Pairs::kTen, "noise=5", "preset=fast", 0.398, 0.65, 48.0, 0},
    {Pairs::kTen, "noise=10", "mode=semi-dense", 0.460, 0.81, 36.6, 0},
    {Pairs::kTen, "jpeg=50", "mode=semi-dense", 0.433, 0.62, 55.8, 12201},
    {Pairs::kTen, "jpeg=20", "mode=semi-dense", 0.554, 0.96, 35.4, 42155},
    {Pairs::kTen, "jpeg=20", "mode=sparse", 0.547, 0.52, 2.0, 4606},
    {Pairs::kTen, "jpeg=20", "mode=dense", 1.025, 4.66, 67.7, 158365},
    {Pairs::kTen, "jpeg=20", "mode=full", 2.145, 11.95, 100.0, 483100},
    {Pairs::kTen, "jpeg=20", "preset=fast", 0.616, 1.20, 41.4, 44958},
    {Pairs::kTen, "dark=0.15", "mode=semi-dense", 0.542, 1.17, 32.3, 0},
    {Pairs::kTen, "dark=0.15", "mode=sparse", 0.312, 0.51, 2.4, 0},
    {Pairs::kTen, "dark=0.15", "mode=dense", 1.013, 4.08, 56.6, 0},
    {Pairs::kTen, "dark=0.15", "mode=full", 2.607, 13.75, 100.0, 0},
    {Pairs::kTen, "dark=0.15", "preset=fast", 0.624, 1.68, 31.1, 0},
    {Pairs::kTen, "bright=1.8", "mode=semi-dense", 0.320, 0.55, 57.3, 122503},
    {Pairs::kTen, "bright=1.8", "mode=sparse", 0.283, 0.41, 10.1, 27470},
    {Pairs::kTen, "bright=1.8", "mode=dense", 0.490, 1.57, 68.3, 234097},
    {Pairs::kTen, "bright=1.8", "preset=fast", 0.360, 0.79, 51.8, 93274},
    {Pairs::kTen, "blur-right=1", "mode=semi-dense", 0.355, 0.64, 72.2, 9273},
    {Pairs::kTen, "blur-right=1.5", "mode=semi-dense", 0.430, 0.90, 69.7, 7482},
    {Pairs::kTen, "soft2x", "mode=semi-dense", 0.251, 0.37, 65.6, 25620},
    {Pairs::kTen, "cam", "mode=semi-dense", 0.513, 0.98, 52.2, 463},
    {Pairs::kTen, "cam", "mode=sparse", 0.306, 0.12, 5.1, 20},
    {Pairs::kTen, "cam", "mode=dense", 0.919, 3.10, 76.3, 3299},
    {Pairs::kTen, "cam", "mode=full", 1.974, 8.70, 100.0, 17679},
    {Pairs::kTen, "cam", "preset=fast", 0.509, 1.03, 56.5, 889},
    {Pairs::kTen, "cam2x", "mode=semi-dense", 0.295, 0.38, 43.5, 572},
    {Pairs::kTen, "cam2x", "mode=dense", 0.557, 1.53, 70.4, 12647},
    {Pairs::kTen, "cam2x", "preset=fast", 0.287, 0.24, 49.4, 1525},
    {Pairs::kTen, "cam1.5x", "mode=semi-dense", 0.367, 0.54, 47.4, 359},
    {Pairs::kTen, "rimcam", "mode=semi-dense", 0.472, 0.77, 50.3, 390},
    {Pairs::kTen, "camh264=28", "mode=semi-dense", 0.558, 1.23, 53.3, 3270},
    {Pairs::kFurther, "clean", "mode=semi-dense", 0.306, 0.55, 64.9, 4907},
    {Pairs::kFurther, "clean", "mode=dense", 0.493, 1.81, 78.4, 12444},
    {Pairs::kFurther, "jpeg=20", "mode=dense", 1.229, 7.67, 54.1, 151240},
    {Pairs::kFurther, "noise=5", "mode=dense", 0.727, 2.73, 59.3, 0},
    {Pairs::kFurther, "clean", "mode=full", 1.143, 7.36, 100.0, 28531},
    {Pairs::kFurther, "lower-right=0.5", "mode=semi-dense", 0.308, 0.58, 63.7, 5284},
    {Pairs::kFurther, "lower-right=1", "mode=semi-dense", 0.304, 0.54, 64.9, 4738},
    {Pairs::kFurther, "lower-right=2", "mode=semi-dense", 0.305, 0.55, 64.7, 4450},
    {Pairs::kFurther, "roll-right=0.2", "mode=semi-dense", 0.314, 0.53, 64.1, 5160},
    {Pairs::kFurther, "noise=5", "mode=semi-dense", 0.417, 0.60, 39.6, 0},
    {Pairs::kFurther, "noise=10", "mode=semi-dense", 0.474, 0.75, 24.7, 0},
    {Pairs::kFurther, "jpeg=50", "mode=semi-dense", 0.540, 1.67, 44.3, 14712},
    {Pairs::kFurther, "jpeg=20", "mode=semi-dense", 0.654, 2.24, 24.2, 26173},
    {Pairs::kFurther, "dark=0.15", "mode=semi-dense", 0.537, 1.01, 21.7, 0},
    {Pairs::kFurther, "bright=1.8", "mode=semi-dense", 0.377, 0.81, 39.8, 97587},
    {Pairs::kFurther, "blur-right=1", "mode=semi-dense", 0.450, 1.17, 62.2, 4441},
    {Pairs::kFurther, "blur-right=1.5", "mode=semi-dense", 0.522, 1.39, 58.6, 3420},
    {Pairs::kFurther, "soft2x", "mode=semi-dense", 0.274, 0.46, 55.3, 14782},
    {Pairs::kFurther, "cam", "mode=semi-dense", 0.548, 1.02, 40.1, 398},
    {Pairs::kFurther, "cam2x", "mode=semi-dense", 0.302, 0.35, 32.5, 1049},
    {Pairs::kRendered, "clean", "mode=semi-dense", 0.239, 1.13, 75.5, 0},
    {Pairs::kRendered, "clean", "mode=dense", 0.365, 2.70, 87.8, 0},
    {Pairs::kRendered, "lower-right=1", "mode=semi-dense", 0.243, 1.13, 75.4, 0},
    {Pairs::kRendered, "roll-right=0.2", "mode=semi-dense", 0.252, 1.15, 75.1, 0},
    {Pairs::kRendered, "noise=5", "mode=semi-dense", 0.370, 1.75, 63.8, 0},
    {Pairs::kRendered, "noise=5", "preset=fast", 0.409, 2.18, 57.2, 0},
    {Pairs::kRendered, "jpeg=20", "mode=semi-dense", 0.577, 1.93, 50.8, 7407},
    {Pairs::kRendered, "dark=0.15", "mode=semi-dense", 0.631, 3.91, 47.9, 0},
    {Pairs::kRendered, "bright=1.8", "mode=semi-dense", 0.213, 0.81, 73.1, 5115},
    {Pairs::kRendered, "bright=1.8", "preset=fast", 0.278, 1.48, 67.0, 2943},
    {Pairs::kRendered, "blur-right=1", "mode=semi-dense", 0.315, 1.96, 76.5, 0},
};

inline constexpr EqualErrorFigures kEqualErrorFigures[] = {
    {Pairs::kTen, "clean", 76.0},
    {Pairs::kTen, "soft2x", 70.7},
    {Pairs::kTen, "cam", 51.0},
    {Pairs::kTen, "cam2x", 51.4},
    {Pairs::kFurther, "clean", 68.3},
    {Pairs::kFurther, "soft2x", 60.2},
    {Pairs::kFurther, "cam", 38.4},
    {Pairs::kFurther, "cam2x", 38.9},
};
// clang-format on

}  // namespace mtstereo::tests
