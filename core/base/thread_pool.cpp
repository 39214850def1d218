// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/thread_pool.hpp"

#include <exception>
#include <utility>

namespace mtstereo {

ThreadPool::ThreadPool(int threads) {
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
    ++generation_;
    busy_ = static_cast<int>(workers_.size());
  }
  if (share) wake_.notify_all();
  take_items(loop, 0);
  std::unique_lock lock(mutex_);
  if (share) done_.wait(lock, [this] { return busy_ == 0; });
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
    Loop loop;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stop_ || generation_ != seen; });
      if (stop_) return;
      seen = generation_;
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
