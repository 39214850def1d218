// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/options/parse.hpp"

#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "lib/options/failure_message.hpp"
#include "lib/outputs/printable.hpp"

namespace mtstereo::options {
namespace {

// CLI11 reads [a,b] as a list of values: a path of that form is written as one of another form.
std::vector<std::string> with_paths_in_brackets(int count, const char* const* arguments) {
  std::vector<std::string> all(arguments, arguments + count);
  for (std::string& each : all) {
    std::error_code error;
    if (each.starts_with('[') && each.ends_with(']') && std::filesystem::exists(each, error)) {
      each.insert(0, "./");
    }
  }
  return all;
}

}  // namespace

std::optional<int> parse(CLI::App& app, int argc, const char* const* argv,
                         const std::function<void()>& check) {
  app.failure_message(failure_message);
  try {
    std::vector<const char*> arguments;
    const std::vector<std::string> texts = with_paths_in_brackets(argc, argv);
    for (const std::string& text : texts) arguments.push_back(text.c_str());
    app.parse(argc, arguments.data());
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
