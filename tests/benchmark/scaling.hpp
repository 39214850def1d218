// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::bench {

/// Registers rendered streets of growing size, and of growing numbers of disparities, matched by
/// the defaults with one thread: what it takes to see how the time grows with either.
void register_scaling(bool quick);

}  // namespace mtstereo::bench
