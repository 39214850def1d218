// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// "disparity", the name of a product on the command line, in files and of its sink.
const char* product_name(Product product);
/// Whether a product is asked for.
bool makes(const WorkOptions& options, Product product);

}  // namespace mtstereo::run
