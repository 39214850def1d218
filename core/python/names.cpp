// SPDX-License-Identifier: LGPL-2.1-or-later
#include "python/names.hpp"

#include <algorithm>
#include <string_view>

namespace mtstereo::python {

std::string keyword_of(const ParameterInfo& info) {
  std::string keyword = info.name;
  std::replace(keyword.begin(), keyword.end(), '-', '_');
  return keyword;
}

std::string with_keywords(std::string text) {
  for (const ParameterInfo& info : parameter_table()) {
    const std::string_view name = info.name;
    if (name.find('-') == name.npos) continue;
    for (std::size_t at = 0; (at = text.find(name, at)) != text.npos; at += name.size()) {
      text.replace(at, name.size(), keyword_of(info));
    }
  }
  return text;
}

}  // namespace mtstereo::python
