// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// What processes a piece and joins pieces; both also write its report, kPieceFile. The tests of
/// plans replace it.
struct PieceFunctions {
  std::function<PieceReport(const Work&, Range, const std::filesystem::path&, const Progress&)>
      process;
  std::function<PieceReport(const Work&, const std::vector<Range>&,
                            const std::vector<std::filesystem::path>&,
                            const std::filesystem::path&)>
      join;
};

/// process() and join() of piece.hpp.
PieceFunctions piece_functions();

}  // namespace mtstereo::run
