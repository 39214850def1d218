// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::bench {

/// Registers rendered streets of growing size and with growing numbers of disparities, matched with
/// the defaults and one thread, to show how the time grows with either.
void register_scaling(bool quick);

}  // namespace mtstereo::bench
