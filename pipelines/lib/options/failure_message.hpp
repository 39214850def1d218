// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace mtstereo::options {

/// Why a command line is invalid, with the option that is nearest to one that does not exist. For
/// CLI::App::failure_message().
std::string failure_message(const CLI::App* app, const CLI::Error& error);

}  // namespace mtstereo::options
