// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string_view>
#include <utility>

namespace mtstereo::options {

/// The numbers of a text such as "640x480", each of one to five digits; none of another text.
std::optional<std::pair<int, int>> two_numbers(std::string_view text);

}  // namespace mtstereo::options
