// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace mtstereo {

/// A fixed number of threads that share the items of one loop at a time. The thread that calls
/// run() is one of them. Only one thread at a time may call run(). After a loop the threads spin
/// for some tens of microseconds to start the next loop without delay, unless there are more
/// threads than processors.
///
/// Written by hand on std::thread: the matcher needs no library for it, run() allocates nothing
/// during a frame, and `worker` numbers the scratch memory of each thread.
class ThreadPool {
 public:
  /// `threads` >= 1, including the caller's. Throws std::system_error if a thread cannot start.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls body(item, worker) once for each item in 0 .. items - 1, in any order and on any thread;
  /// `worker` in 0 .. threads() - 1 is the number of the thread, so that each can use its own
  /// scratch memory. Returns when all items are done. Rethrows an exception of body().
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
  bool open_ = false;             // guarded by mutex_: workers can still join the loop
  bool stop_ = false;             // guarded by mutex_
  std::exception_ptr exception_;  // guarded by mutex_: the first one of the loop
  std::atomic<int> next_item_{0};
  // Written under mutex_; also read without it by threads that spin.
  std::atomic<long> generation_{0};  // counts the loops
  std::atomic<int> busy_{0};         // workers that have joined the loop and still run
  const bool spins_;                 // a spinning thread takes no processor from a working one
};

}  // namespace mtstereo
