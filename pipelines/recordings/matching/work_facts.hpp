// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "recordings/matching/piece.hpp"

// What a work uses, for run.json and for the tags of Matroska files.

namespace mtstereo::run {

using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// The shortest text that is read as the same number.
std::string number_text(double number);

/// Every parameter of the matcher with the value in effect, after the defaults of preset and mode,
/// and the properties disparity-scale and sharpness of mtstereo. The number of threads is
/// not among them: it changes no result.
NamedTexts effective_parameters(const WorkOptions& options);

/// The units of the values of a disparity map.
struct MapUnits {
  int scale = 256;  ///< steps per px
  int offset = 0;   ///< to add to a disparity [px]
};
MapUnits map_units(const WorkOptions& options);

/// The pairs in a second.
double frame_rate(const Work& work);

/// The tags of the Matroska file of a product. They depend on the work only, so that pieces can be
/// joined. Names are those of docs/recordings.md; texts are UTF-8.
NamedTexts matroska_tags(const Work& work, Product product);

}  // namespace mtstereo::run
