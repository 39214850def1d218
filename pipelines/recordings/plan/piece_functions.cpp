// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/piece_functions.hpp"

namespace mtstereo::run {

PieceFunctions piece_functions() {
  return {[](const Work& work, Range range, const std::filesystem::path& folder,
             const Progress& progress) { return process(work, range, folder, progress); },
          join};
}

}  // namespace mtstereo::run
