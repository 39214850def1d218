// SPDX-License-Identifier: LGPL-2.1-or-later
// stub TEMPLATE STUB: writes the typed stub of the module. The keywords of Matcher come from the
// parameter table. It is a program of the build machine, so a cross build needs no emulator.
#include <fstream>
#include <iostream>
#include <string>
#include <string_view>

#include "python/names.hpp"

namespace {

using mtstereo::ParameterType;

/// 'a|b' as Literal["a", "b"].
std::string literal_of(std::string_view words) {
  std::string text = "Literal[\"";
  for (const char letter : words) text += letter == '|' ? "\", \"" : std::string(1, letter);
  return text + "\"]";
}

std::string type_of(const mtstereo::ParameterInfo& info) {
  switch (info.type) {
    case ParameterType::kBoolean:
      return "bool";
    case ParameterType::kInteger:
      return "int";
    case ParameterType::kNumber:
      return "float";
    case ParameterType::kChoice:
      return literal_of(info.choices);
    case ParameterType::kLevels:
      break;
  }
  return "str | Sequence[int]";
}

void write_keywords(std::ostream& out) {
  for (const mtstereo::ParameterInfo& info : mtstereo::parameter_table()) {
    out << "        " << mtstereo::python::keyword_of(info) << ": " << type_of(info)
        << " | None = ...,\n";
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::cerr << "usage: stub TEMPLATE STUB\n";
    return 2;
  }
  std::ifstream in(arguments[1]);
  std::ofstream out(arguments[2]);
  for (std::string line; std::getline(in, line);) {
    if (line == "        # @KEYWORDS@") {
      write_keywords(out);
    } else {
      out << line << '\n';
    }
  }
  if (in.eof() && out.flush()) return 0;
  std::cerr << "stub: cannot write " << arguments[2] << " from " << arguments[1] << '\n';
  return 1;
}
