// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/options/parse.hpp"

#include <iostream>
#include <sstream>

#include "lib/options/failure_message.hpp"
#include "lib/outputs/printable.hpp"

namespace mtstereo::options {

std::optional<int> parse(CLI::App& app, int argc, const char* const* argv,
                         const std::function<void()>& check) {
  app.failure_message(failure_message);
  try {
    app.parse(argc, argv);
    check();
  } catch (const CLI::ParseError& error) {
    std::ostringstream errors;
    const int status = app.exit(error, std::cout, errors);
    std::cerr << outputs::printable_lines(errors.str());
    return status == 0 ? 0 : 2;
  }
  return std::nullopt;
}

}  // namespace mtstereo::options
