// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mtstereo::options {

/// How many letters must be inserted, removed, replaced, or exchanged with their neighbor to make
/// one word of the other one.
std::size_t typing_errors(std::string_view first, std::string_view second);

/// The name that was most likely meant by a word that is not among them; empty if none is similar:
/// a third of the letters may differ.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

}  // namespace mtstereo::options
