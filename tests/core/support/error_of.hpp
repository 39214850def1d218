// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace mtstereo::test {

/// The message of the exception that a call throws; "" if it throws none.
template <typename Exception = std::runtime_error, typename Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const Exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace mtstereo::test
