// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "mtstereo/geometry/calibration.hpp"

namespace mtstereo {

/// The product of a matrix and a vector.
inline Vector3 rotate(const Matrix3& m, const Vector3& v) {
  return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
          m[6] * v[0] + m[7] * v[1] + m[8] * v[2]};
}

/// The product of the transposed matrix and a vector: the inverse rotation.
inline Vector3 rotate_back(const Matrix3& m, const Vector3& v) {
  return {m[0] * v[0] + m[3] * v[1] + m[6] * v[2], m[1] * v[0] + m[4] * v[1] + m[7] * v[2],
          m[2] * v[0] + m[5] * v[1] + m[8] * v[2]};
}

}  // namespace mtstereo
