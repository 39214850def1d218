// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/outputs/standard_output.hpp"

#include <cerrno>
#include <iostream>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::outputs {

void finish_standard_output() {
  errno = 0;  // an earlier one may have failed, whose cause is no longer known
  if (!std::cout.flush()) throw write_error("standard output");
}

}  // namespace mtstereo::outputs
