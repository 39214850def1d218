// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace mtstereo::eval {

/// One line of a table.
using TableRow = std::vector<std::string>;

/// A number with so many digits behind the point, "-" where it is not finite.
std::string fixed(double value, int digits);

/// Prints rows in columns as wide as their widest field: the first two to the left, the others to
/// the right. All rows have as many fields as the first.
void print_rows(std::ostream& out, const std::vector<TableRow>& rows);

}  // namespace mtstereo::eval
