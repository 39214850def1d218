// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// SIGINT and SIGTERM end the program in every phase. What is stored is whole or can be continued at
// any time, so the program ends at once, unless it can stop in order within 20 seconds.

namespace mtstereo::run {

/// From now on, signals end the program with an exit status, after a message on the standard error.
/// `message` must stay valid.
void end_at_signals(const char* message, int status);

/// While it exists, the first signal only sets stop_requested(); the program ends if it is still
/// running 20 seconds later, or at the second signal of the same number.
class OrderlyStop {
 public:
  OrderlyStop() noexcept;
  ~OrderlyStop();
  OrderlyStop(const OrderlyStop&) = delete;
  OrderlyStop& operator=(const OrderlyStop&) = delete;
};

/// Whether a signal came while there was an OrderlyStop.
bool stop_requested() noexcept;

}  // namespace mtstereo::run
