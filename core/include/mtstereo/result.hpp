// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace mtstereo {

/// What kind of thing went wrong. The sentence for the user is in Error::message.
enum class ErrorCode {
  /// A parameter's name is unknown, or its value is outside its range or of the wrong type.
  kInvalidParameter,
  /// Parameters that are fine one by one do not fit each other.
  kInvalidCombination,
  /// An image has no pixels, no data, or a stride that is shorter than its rows.
  kInvalidImage,
  /// The left image, the right image and the output do not have the same size.
  kSizeMismatch,
  /// The parameters do not fit the size of the images.
  kFrameDoesNotFit,
  /// The memory that the frame size and the search range need is not to be had.
  kOutOfMemory,
  /// The system refused something else that was needed, such as a thread.
  kSystem,
};

/// Why a call failed: a kind for programs and one sentence for people, which names what is wrong
/// (the parameter, the value, the range, the sizes) and what to do.
struct Error {
  ErrorCode code;
  std::string message;
};

/// A value, or the reason why there is none.
///
/// Functions of this library that return a Result or a Status are noexcept: where even the memory
/// for a message is missing, the Error has the code kOutOfMemory and an empty message. Functions
/// that return a std::string may throw std::bad_alloc, as copies of an Error may. All other
/// functions are noexcept.
template <typename T>
class [[nodiscard]] Result {
 public:
  // Implicit, so that a function can return either a value or an Error.
  Result(T value) : state_(std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  /// True where there is a value.
  bool ok() const { return std::holds_alternative<T>(state_); }
  explicit operator bool() const { return ok(); }

  /// The value; only where ok().
  T& value() { return std::get<T>(state_); }
  const T& value() const { return std::get<T>(state_); }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  /// The reason; only where not ok().
  const Error& error() const { return std::get<Error>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success, or the reason why not.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return !error_.has_value(); }
  explicit operator bool() const { return ok(); }

  /// The reason; only where not ok().
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace mtstereo
