// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace mtstereo::eval {

/// One line of a table.
using TableRow = std::vector<std::string>;

/// A number with this many digits after the decimal point; "-" if it is not finite.
std::string fixed(double value, int digits);

/// Prints rows in columns as wide as their widest field, the first two aligned left, the others
/// right. All rows must have as many fields as the first.
void print_rows(std::ostream& out, const std::vector<TableRow>& rows);

}  // namespace mtstereo::eval
