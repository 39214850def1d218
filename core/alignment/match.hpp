// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo {

/// One point of the scene in both views.
struct Match {
  float x_left;    ///< [px]
  float y_left;    ///< [px]
  float x_right;   ///< [px]
  float rows;      ///< row in the right view minus row in the left view [px]
  float variance;  ///< of `rows`, as predicted from the patches [px^2]

  float disparity() const { return x_left - x_right; }
};

}  // namespace mtstereo
