// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/thread_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <stdexcept>
#include <string>
#include <thread>

namespace mtstereo::thread_pool_test {
namespace {

constexpr int kThreadCounts[] = {1, 2, 3, 4, 7};

/// Runs one loop and counts the calls for each item; fails if the number of a worker is out of
/// range.
std::vector<int> calls_of_a_loop(ThreadPool& pool, int items) {
  std::vector<std::atomic<int>> calls(items);
  std::atomic<int> wrong_workers{0};
  pool.run(items, [&](int item, int worker) {
    ++calls[item];
    if (worker < 0 || worker >= pool.threads()) ++wrong_workers;
  });
  EXPECT_EQ(0, wrong_workers);
  return {calls.begin(), calls.end()};
}

TEST(ThreadPool, HasTheRequestedNumberOfThreads) {
  for (const int threads : kThreadCounts) EXPECT_EQ(threads, ThreadPool(threads).threads());
}

TEST(ThreadPool, CallsEveryItemOnce) {
  for (const int threads : kThreadCounts) {
    ThreadPool pool(threads);
    for (const int items : {0, 1, 2, threads, threads + 1, 1000}) {
      EXPECT_EQ(std::vector<int>(items, 1), calls_of_a_loop(pool, items)) << threads << " threads";
    }
  }
}

TEST(ThreadPool, RunsManyShortLoops) {
  ThreadPool pool(4);
  for (int loop = 0; loop < 3000; ++loop) {
    const int items = loop % 6;
    ASSERT_EQ(std::vector<int>(items, 1), calls_of_a_loop(pool, items)) << "loop " << loop;
  }
}

TEST(ThreadPool, RunsLoopsAfterPauses) {
  for (const int threads : kThreadCounts) {
    ThreadPool pool(threads);
    for (int loop = 0; loop < 20; ++loop) {
      std::this_thread::sleep_for(std::chrono::microseconds(100 * (loop % 4)));
      ASSERT_EQ(std::vector<int>(9, 1), calls_of_a_loop(pool, 9)) << threads << " threads";
    }
  }
}

TEST(ThreadPool, RunsLongItemsInParallel) {
  // Two items that wait for each other: a single thread would never finish them.
  ThreadPool pool(2);
  for (int loop = 0; loop < 50; ++loop) {
    if (loop % 10 == 9) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::atomic<int> started{0};
    std::atomic<int> alone{0};
    pool.run(2, [&](int, int) {
      ++started;
      const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
      while (started < 2 && std::chrono::steady_clock::now() < limit) std::this_thread::yield();
      if (started < 2) ++alone;
    });
    ASSERT_EQ(0, alone) << "loop " << loop;
  }
}

TEST(ThreadPool, UsesNoProcessorTimeWhileIdle) {
  ThreadPool pool(std::max(static_cast<int>(std::thread::hardware_concurrency()), 2));
  calls_of_a_loop(pool, 100);
  const std::clock_t before = std::clock();  // of all threads
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const double used = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  EXPECT_LT(used, 0.1) << "s of processor time in 0.3 s";
}

TEST(ThreadPool, GivesConcurrentThreadsDifferentWorkerNumbers) {
  // The counters are not atomic: two threads with the same worker number would race and lose
  // counts.
  ThreadPool pool(4);
  std::vector<long> scratch(4);
  for (int loop = 0; loop < 50; ++loop) {
    pool.run(200, [&](int, int worker) { ++scratch[worker]; });
  }
  EXPECT_EQ(50 * 200, scratch[0] + scratch[1] + scratch[2] + scratch[3]);
}

TEST(ThreadPool, MakesTheWritesOfTheItemsVisibleToTheCaller) {
  ThreadPool pool(3);
  std::vector<int> values(500);
  for (int loop = 1; loop <= 20; ++loop) {
    pool.run(500, [&](int item, int) { values[item] += item; });
    for (int i = 0; i < 500; ++i) ASSERT_EQ(loop * i, values[i]) << "after loop " << loop;
  }
}

TEST(ThreadPool, RunsItemsOnTheCallersThread) {
  ThreadPool pool(1);
  const std::thread::id caller = std::this_thread::get_id();
  pool.run(5, [&](int, int worker) {
    EXPECT_EQ(caller, std::this_thread::get_id());
    EXPECT_EQ(0, worker);
  });
}

TEST(ThreadPool, RethrowsAnExceptionAndStaysUsable) {
  for (const int threads : kThreadCounts) {
    ThreadPool pool(threads);
    for (const int items : {1, 2, 100}) {
      for (const int bad : {0, items / 2, items - 1}) {
        try {
          pool.run(items, [&](int item, int) {
            if (item == bad) throw std::runtime_error("item " + std::to_string(item));
          });
          ADD_FAILURE() << "nothing was thrown";
        } catch (const std::runtime_error& error) {
          EXPECT_EQ("item " + std::to_string(bad), error.what());
        }
        EXPECT_EQ(std::vector<int>(50, 1), calls_of_a_loop(pool, 50)) << threads << " threads";
      }
    }
  }
}

TEST(ThreadPool, RethrowsOneOfManyExceptions) {
  ThreadPool pool(4);
  for (int loop = 0; loop < 100; ++loop) {
    EXPECT_THROW(pool.run(100, [](int, int) { throw std::runtime_error("all"); }),
                 std::runtime_error);
  }
  EXPECT_EQ(std::vector<int>(50, 1), calls_of_a_loop(pool, 50));
}

TEST(ThreadPool, CanBeDestroyedBeforeItRanALoop) {
  for (int n = 0; n < 200; ++n) ThreadPool pool(1 + n % 8);
}

TEST(ThreadPool, RunsAConstBody) {
  ThreadPool pool(2);
  std::atomic<int> sum{0};
  const auto body = [&sum](int item, int) { sum += item; };
  pool.run(10, body);
  EXPECT_EQ(45, sum);
}

}  // namespace
}  // namespace mtstereo::thread_pool_test
