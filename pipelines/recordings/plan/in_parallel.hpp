// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <functional>

namespace mtstereo::run {

/// Calls `work` for 0 to count - 1, in this order, from `jobs` threads at the same time. After an
/// exception no further call starts, and the first exception is thrown.
void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& work);

}  // namespace mtstereo::run
