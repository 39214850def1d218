// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/options/failure_message.hpp"

#include <vector>

#include "lib/options/nearest_name.hpp"

namespace mtstereo::options {
namespace {

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  }
  return names;
}

// A line for each option that does not exist and is similar to one that does.
std::string suggestions(const CLI::App& app) {
  const std::vector<std::string> names = option_names(app);
  std::string lines;
  for (const std::string& argument : app.remaining()) {
    if (!argument.starts_with("--")) continue;
    const std::string word = argument.substr(2, argument.find('=') - 2);
    const std::string nearest = nearest_name(word, names);
    if (!nearest.empty()) lines += "Did you mean --" + nearest + " by --" + word + "?\n";
  }
  return lines;
}

}  // namespace

std::string failure_message(const CLI::App* app, const CLI::Error& error) {
  // The value of an option that does not exist may be one input too many.
  return std::string(error.what()) + "\n" + suggestions(*app) +
         "Run with --help for more information.\n";
}

}  // namespace mtstereo::options
