// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <utility>

#include "mtstereo/result.hpp"

// From the errors of the library to exceptions of Python.

namespace mtstereo::python {

/// Throws the exception of an error: MemoryError, OSError, or ValueError for all others. Parameters
/// in the message have the names of their keywords.
[[noreturn]] void raise(const Error& error);

/// Throws unless the call succeeded.
inline void require(const Status& status) {
  if (!status) raise(status.error());
}

/// The value of a call; throws if it failed.
template <typename T>
T value_of(Result<T> result) {
  if (!result) raise(result.error());
  return std::move(result.value());
}

}  // namespace mtstereo::python
