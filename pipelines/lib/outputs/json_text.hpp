// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "lib/outputs/printable.hpp"

namespace mtstereo::outputs {

/// Makes all texts in JSON valid UTF-8, by printable(). Names that were written by escaped() do not
/// change.
template <typename Json>
void make_printable(Json& json) {
  if (json.is_string()) {
    auto& text = json.template get_ref<typename Json::string_t&>();
    text = printable(text);
  } else if (json.is_structured()) {
    for (Json& each : json) make_printable(each);
  }
}

/// The text of JSON. `indent`: -1 for one line.
template <typename Json>
std::string text_of(Json json, int indent = -1) {
  make_printable(json);
  return json.dump(indent);
}

}  // namespace mtstereo::outputs
