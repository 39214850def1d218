// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/thread_pool.hpp"

#include <chrono>
#include <exception>
#include <utility>

namespace mtstereo {
namespace {

/// Time that a thread spins before it sleeps. Waking it up takes about as long, and the next loop
/// of a frame rarely starts later.
constexpr std::chrono::microseconds kSpinTime{50};

/// Waits until done() is true, at most for kSpinTime; yields the processor between the checks.
template <typename Done>
void spin_until(Done&& done) {
  const auto limit = std::chrono::steady_clock::now() + kSpinTime;
  while (!done() && std::chrono::steady_clock::now() < limit) std::this_thread::yield();
}

}  // namespace

ThreadPool::ThreadPool(int threads)
    : spins_(threads <= static_cast<int>(std::thread::hardware_concurrency())) {
  workers_.reserve(threads - 1);
  try {
    for (int worker = 1; worker < threads; ++worker) {
      workers_.emplace_back([this, worker] { work(worker); });
    }
  } catch (...) {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : workers_) thread.join();
    throw;
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : workers_) thread.join();
}

void ThreadPool::run_loop(int items, void* context, Call call) {
  const Loop loop{context, call, items};
  next_item_.store(0, std::memory_order_relaxed);
  const bool share = !workers_.empty() && items > 1;
  if (share) {
    const std::lock_guard lock(mutex_);
    loop_ = loop;
    open_ = true;
    ++generation_;
  }
  if (share) wake_.notify_all();
  take_items(loop, 0);
  std::unique_lock lock(mutex_);
  open_ = false;
  if (busy_ > 0 && spins_) {
    lock.unlock();
    spin_until([this] { return busy_ == 0; });
    lock.lock();
  }
  done_.wait(lock, [this] { return busy_ == 0; });
  if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
}

void ThreadPool::take_items(const Loop& loop, int worker) {
  try {
    for (int item; (item = next_item_.fetch_add(1, std::memory_order_relaxed)) < loop.items;) {
      loop.call(loop.context, item, worker);
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!exception_) exception_ = std::current_exception();
  }
}

void ThreadPool::work(int worker) {
  for (long seen = 0;;) {
    if (spins_) spin_until([&] { return generation_ != seen; });
    Loop loop;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stop_ || generation_ != seen; });
      if (stop_) return;
      seen = generation_;
      if (!open_) continue;  // the other threads have finished the loop
      ++busy_;
      loop = loop_;
    }
    take_items(loop, worker);
    {
      const std::lock_guard lock(mutex_);
      if (--busy_ == 0) done_.notify_one();
    }
  }
}

}  // namespace mtstereo
