// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>

#include "mtstereo/geometry/calibration.hpp"

// The checks that readers do per entry, and check_calibration() does for a whole calibration. All
// return what is wrong, or an empty text.

namespace mtstereo {

/// Whether a lens model can have so many coefficients.
bool is_coefficient_count(LensModel lens, std::size_t count) noexcept;
/// The numbers of coefficients of a lens model, for a message: "4, 5, 8, 12 or 14".
const char* coefficient_counts(LensModel lens) noexcept;

/// "is not a rotation ..." if rows are not orthonormal to 1e-3, or the matrix mirrors.
std::string rotation_problem(const Matrix3& matrix);

/// "a baseline of ..." if it is zero, vertical or too long.
std::string translation_problem(const Vector3& translation);

}  // namespace mtstereo
