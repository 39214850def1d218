// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace mtstereo::eval {

/// The reason why plot.py cannot draw on this machine, and what to install; none if it can.
std::optional<std::string> plot_obstacle();

/// Runs plot.py to plot the curves of a report, {"curve": curves_json()}, as PNG. Throws UserError
/// naming the picture if plot.py fails; plot.py prints the reason on the standard error.
void plot_curves(const std::filesystem::path& picture, const nlohmann::json& report);

}  // namespace mtstereo::eval
