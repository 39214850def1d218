// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "geometry/formats/value.hpp"

// The matrices of a pair of cameras in files of OpenCV, and their names.

namespace mtstereo::formats {

/// Names of one entry with blanks between them: without upper case, '_', '-' and '.'.
using Names = std::string_view;

/// Names of R and T; also the last part of a longer name.
inline constexpr Names kRotationNames =
    "r rotation rotationmatrix stereor rstereo rlr rmat rot rotmat rotate";
inline constexpr Names kTranslationNames =
    "t translation translationvector translationmatrix stereot tstereo tlr trans transvec tvec";

/// The name without upper case and the characters that programs put between words.
inline std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char letter : name) {
    if (letter == '_' || letter == '-' || letter == '.') continue;
    plain += letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  }
  return plain;
}

/// What a pair of cameras needs, as far as it is there.
struct PairEntries {
  std::optional<Entry> left_matrix, right_matrix;  ///< K
  std::optional<Entry> left_lens, right_lens;      ///< distortion coefficients
  std::optional<Entry> left_xi, right_xi;          ///< only of cv::omnidir
  std::optional<Entry> rotation, translation;      ///< from the left to the right camera
};

}  // namespace mtstereo::formats
