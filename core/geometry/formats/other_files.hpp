// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

// What people take for a calibration file. The messages say how to get one.

namespace mtstereo::formats {

/// Fails for a folder. That of the arrays of a Python program has a remedy.
[[noreturn]] void refuse_folder(const std::string& folder);

/// Fails for archives, and the files of programs in Python and MATLAB.
void refuse_containers(const std::string& text, const std::string& file);

/// Fails for texts that calibration programs write beside the calibration.
void refuse_reports(std::string_view start, const std::string& file);

}  // namespace mtstereo::formats
