// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>

namespace mtstereo::run {

/// Breaks the lines of a text that are longer than `width` characters at spaces.
std::string wrapped(const std::string& text, std::size_t width);

/// Help whose lines fit a terminal, with a usage line that shows what is required.
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::string usage);

  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_footer(const CLI::App* app) const override;
  std::string make_option_desc(const CLI::Option* option) const override;

 private:
  std::string usage_;
};

}  // namespace mtstereo::run
