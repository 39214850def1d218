// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace mtstereo {

/// The kind of an error. Error::message is the sentence for the user.
enum class ErrorCode {
  /// The name of a parameter is unknown, or its value has the wrong type or is out of range.
  kInvalidParameter,
  /// Each parameter is valid, but their combination is not.
  kInvalidCombination,
  /// An image has no pixels, no data, or a stride shorter than a row.
  kInvalidImage,
  /// The left image, the right image and the output do not have the same size.
  kSizeMismatch,
  /// The parameters and the size of the images do not fit.
  kFrameDoesNotFit,
  /// There is not enough memory for this image size and search range.
  kOutOfMemory,
  /// The operating system refused another resource, such as a thread, or failed to write a file.
  kSystem,
  /// A calibration file cannot be read, or a calibration makes no sense.
  kInvalidCalibration,
};

/// Why a call failed.
struct Error {
  ErrorCode code;  ///< the kind, for programs
  /// One sentence for the user: what is wrong (parameter, value, range, sizes) and what to do.
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
  /// Success with a value.
  Result(T value) : state_(std::move(value)) {}  // NOLINT(google-explicit-constructor)
  /// Failure.
  Result(Error error) : state_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  /// True if there is a value.
  bool ok() const { return std::holds_alternative<T>(state_); }
  /// The same as ok().
  explicit operator bool() const { return ok(); }

  ///@{
  /// The value. Requires ok().
  T& value() { return std::get<T>(state_); }
  const T& value() const { return std::get<T>(state_); }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  ///@}

  /// The reason of the failure. Requires !ok().
  const Error& error() const { return std::get<Error>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success, or the reason of a failure.
class [[nodiscard]] Status {
 public:
  /// Success.
  Status() = default;
  /// Failure. Implicit, so that a function can return an Error.
  Status(Error error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  /// True on success.
  bool ok() const { return !error_.has_value(); }
  /// The same as ok().
  explicit operator bool() const { return ok(); }

  /// The reason of the failure. Requires !ok().
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace mtstereo
