// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <new>

#include "mtstereo/result.hpp"

namespace mtstereo {

/// Calls body(), which returns a Status or a Result, at the boundary of the library. No exception
/// leaves it: an exception becomes an Error without a message, since there may be no memory for
/// one. The code is kOutOfMemory for std::bad_alloc and kSystem for every other exception.
template <typename Body>
auto guarded(Body&& body) noexcept -> decltype(body()) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, {}};
  } catch (...) {
    return Error{ErrorCode::kSystem, {}};
  }
}

}  // namespace mtstereo
