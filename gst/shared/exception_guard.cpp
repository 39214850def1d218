// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/exception_guard.hpp"

#include <gst/gst.h>

#include <exception>

namespace mtstereo::plugin {
namespace {

void post(gpointer element, const char* reason) noexcept {
  GST_ELEMENT_ERROR(element, LIBRARY, FAILED,
                    ("The element stopped because of an internal error: %s.", reason),
                    ("a callback of the element ended with an exception"));
}

}  // namespace

void post_exception(gpointer element) noexcept {
  try {
    throw;
  } catch (const std::exception& error) {
    post(element, error.what());
  } catch (...) {
    post(element, "unknown exception");
  }
}

}  // namespace mtstereo::plugin
