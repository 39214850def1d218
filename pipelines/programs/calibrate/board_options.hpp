// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace mtstereo::calibrate {

enum class BoardKind {
  kCharuco,       ///< a checkerboard with a marker in each white square; may be partly visible
  kCheckerboard,  ///< without markers; must be visible as a whole
};

/// What a board looks like.
struct BoardOptions {
  BoardKind kind = BoardKind::kCharuco;
  int columns = 9;                     ///< squares
  int rows = 6;                        ///< squares
  double square = 0.028;               ///< side of a square [m]
  double marker = 0;                   ///< side of a marker [m]; 0 = 3/4 of a square
  std::string dictionary = "4x4_100";  ///< of the markers

  /// The side of a marker [m].
  double marker_side() const { return marker > 0 ? marker : square * 3 / 4; }
};

}  // namespace mtstereo::calibrate
