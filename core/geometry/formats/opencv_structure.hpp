// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "geometry/formats/opencv_names.hpp"

// Recognises the matrices of a pair that have unknown names: two camera matrices, two vectors of
// coefficients, one rotation, one vector.

namespace mtstereo::formats {

/// Adds what a pair lacks, where the structure of the entries leaves no choice.
void complete_by_structure(const std::vector<Entry>& entries, PairEntries& pair);

/// How many entries can be a camera matrix.
std::size_t count_camera_matrices(const std::vector<Entry>& entries);

/// The name of a camera matrix that is transposed, or empty.
std::string transposed_matrix(const std::vector<Entry>& entries);

/// The names and shapes of the matrices, for a message.
std::string matrices_text(const std::vector<Entry>& entries);

}  // namespace mtstereo::formats
