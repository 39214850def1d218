// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "geometry/formats/opencv_entries.hpp"

// Recognises the matrices of a pair that have unknown names: two camera matrices, two vectors of
// coefficients, one rotation, one vector.

namespace mtstereo::formats {

/// Names of R and T; also the last part of a longer name.
inline constexpr Names kRotationNames = "r rotation rotationmatrix stereor rstereo rlr rmat";
inline constexpr Names kTranslationNames =
    "t translation translationvector translationmatrix stereot tstereo tlr trans tvec";

/// Adds what a pair lacks, where the structure of the entries leaves no choice.
void complete_by_structure(const std::vector<Entry>& entries, PairEntries& pair);

/// Whether an entry can be a camera matrix.
bool has_camera_matrix(const std::vector<Entry>& entries);

/// The names and shapes of the matrices, for a message.
std::string matrices_text(const std::vector<Entry>& entries);

}  // namespace mtstereo::formats
