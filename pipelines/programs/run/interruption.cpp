// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/run/interruption.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>

#include "lib/outputs/folder_lock.hpp"

namespace mtstereo::run {
namespace {

// A busy machine takes seconds to finish a pair and to remove files; schedulers kill after 30 s.
constexpr unsigned kPatience = 20;  // [s]

std::atomic<const char*> end_message{""};
std::atomic<int> end_status{1};
std::atomic<bool> on_terminal{false};
std::atomic<int> orderly{0};  // objects of OrderlyStop
std::atomic<int> first_signal{0};
static_assert(std::atomic<const char*>::is_always_lock_free &&
                  std::atomic<int>::is_always_lock_free,
              "signal handlers use them");

void print(const char* text) {
  const ssize_t written = write(STDERR_FILENO, text, std::strlen(text));
  static_cast<void>(written);
}

void end_now(int /*number*/) {
  if (on_terminal) print("\r\033[K");
  print(end_message);
  outputs::remove_empty_folders();
  _exit(end_status);
}

void on_signal(int number) {
  int none = 0;
  if (orderly == 0) end_now(number);
  if (first_signal.compare_exchange_strong(none, number)) {
    alarm(kPatience);
  } else if (none == number) {
    end_now(number);
  }
}

}  // namespace

void end_at_signals(const char* message, int status) {
  end_message = message;
  end_status = status;
  on_terminal = isatty(STDERR_FILENO) == 1;
  std::signal(SIGALRM, end_now);
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

OrderlyStop::OrderlyStop() noexcept { ++orderly; }

OrderlyStop::~OrderlyStop() { --orderly; }

bool stop_requested() noexcept { return first_signal != 0; }

}  // namespace mtstereo::run
