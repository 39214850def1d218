// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace mtstereo {

/// A fixed number of threads that share the items of one loop after the other. The thread that
/// calls run() is one of them. One thread at a time may call run(). For some ten microseconds after
/// a loop the threads stay awake for the next one, unless they are more than the processors.
class ThreadPool {
 public:
  /// `threads` >= 1, the caller's included. Throws std::system_error where a thread cannot start.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls body(item, worker) once for each item in 0 .. items - 1, in any order and on any thread;
  /// `worker` in 0 .. threads() - 1 tells which, so that each can have scratch memory of its own.
  /// Returns when all are done. An exception of a body is thrown again here.
  template <typename Body>
  void run(int items, Body&& body) {
    using Plain = std::remove_reference_t<Body>;
    run_loop(
        items, const_cast<std::remove_const_t<Plain>*>(&body),
        [](void* context, int item, int worker) { (*static_cast<Plain*>(context))(item, worker); });
  }

 private:
  using Call = void (*)(void* context, int item, int worker);
  struct Loop {
    void* context = nullptr;
    Call call = nullptr;
    int items = 0;
  };

  void run_loop(int items, void* context, Call call);
  void work(int worker);
  void take_items(const Loop& loop, int worker);

  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  Loop loop_;                     // guarded by mutex_
  bool open_ = false;             // guarded by mutex_: the loop can still be joined
  bool stop_ = false;             // guarded by mutex_
  std::exception_ptr exception_;  // guarded by mutex_: the first one of the loop
  std::atomic<int> next_item_{0};
  // Written under mutex_, read without it while a thread has not given up and gone to sleep.
  std::atomic<long> generation_{0};  // counts the loops
  std::atomic<int> busy_{0};         // workers that have joined the loop and are not done
  const bool spins_;                 // a thread that waits takes no processor from one that works
};

}  // namespace mtstereo
