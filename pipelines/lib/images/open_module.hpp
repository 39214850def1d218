// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "lib/images/module.hpp"

namespace mtstereo::images {

/// Opens the module, for as long as the program runs. Throws a UserError that names the file, what
/// is wrong with it, and what to do.
const Codecs& open_module(const std::string& name);

}  // namespace mtstereo::images
