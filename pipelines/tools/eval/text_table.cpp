// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "lib/outputs/texts.hpp"

namespace mtstereo::eval {

std::string fixed(double value, int digits) {
  return std::isfinite(value) ? outputs::decimal(value, digits) : "-";
}

void print_rows(std::ostream& out, const std::vector<TableRow>& rows) {
  if (rows.empty()) return;
  std::vector<std::size_t> widths(rows.front().size());
  for (const TableRow& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const TableRow& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - row[i].size(), ' ');
      line += (i == 0 ? "" : "  ") + (i < 2 ? row[i] + space : space + row[i]);
    }
    out << line << '\n';
  }
}

}  // namespace mtstereo::eval
