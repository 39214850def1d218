// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::outputs {

/// Writes out what a program has printed. Throws WriteError if a part of it is lost, as on a full
/// disk.
void finish_standard_output();

}  // namespace mtstereo::outputs
