// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::run {

/// estimate_clocks(): the images do not decide how the clocks differ.
class UndecidedClocks : public UserError {
 public:
  UndecidedClocks(const std::string& message, std::string reason)
      : UserError(message), reason_(std::move(reason)) {}
  /// As in "both recordings are static, nothing moves in them"; the message has it too.
  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

}  // namespace mtstereo::run
