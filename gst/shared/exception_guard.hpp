// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <glib-object.h>

#include <type_traits>
#include <utility>

namespace mtstereo::plugin {

/// Posts the exception that is being handled as an error message of `element`, a GstElement. Call
/// it in a catch block only, without the element's object lock.
void post_exception(gpointer element) noexcept;

/// The default of kOnException.
inline void do_nothing(gpointer) noexcept {}

template <auto kFunction, auto kFallback, auto kOnException>
struct Guard;

template <typename Result, typename Element, typename... Arguments,
          Result (*kFunction)(Element*, Arguments...), auto kFallback, auto kOnException>
struct Guard<kFunction, kFallback, kOnException> {
  static Result call(Element* element, Arguments... arguments) noexcept {
    try {
      return kFunction(element, arguments...);
    } catch (...) {
      post_exception(element);
      kOnException(element);
    }
    if constexpr (!std::is_void_v<Result>) return static_cast<Result>(kFallback);
  }
};

/// `kFunction` as a callback of C code, which no exception may reach: `vfunc = guarded<start,
/// FALSE>`. An exception becomes an error message of the element, which is the first argument;
/// kOnException is then called with the element, and the callback returns kFallback. Every virtual
/// function of an element is set in this way, or is noexcept because it calls C functions only.
template <auto kFunction, auto kFallback = nullptr, auto kOnException = do_nothing>
inline constexpr auto guarded = Guard<kFunction, kFallback, kOnException>::call;

/// The state of a new element, for its instance init. No error can be reported at that point: if
/// there is no memory the program ends, as it does where GLib allocates.
template <typename State, typename... Arguments>
State* new_state(Arguments&&... arguments) noexcept {
  return new State(std::forward<Arguments>(arguments)...);
}

}  // namespace mtstereo::plugin
