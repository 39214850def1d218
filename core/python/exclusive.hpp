// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <mutex>
#include <utility>

namespace mtstereo::python {

/// An object of the library that one thread may use at a time. The GIL is released while a thread
/// waits for the object or uses it.
template <typename T>
class Exclusive {
 public:
  explicit Exclusive(T object) : object_(std::move(object)) {}

  /// Calls `use` with the object. `use` must not access objects of Python.
  template <typename Use>
  auto with(Use use) {
    const pybind11::gil_scoped_release released;
    const std::lock_guard lock(mutex_);
    return use(object_);
  }

 private:
  std::mutex mutex_;
  T object_;
};

}  // namespace mtstereo::python
