// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/bands.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace mtstereo::bands_test {
namespace {

/// Counts how often each item of a loop is visited.
class Visits {
 public:
  Visits(int items, int threads) : counts_(items), threads_(threads) {}

  void visit(int first, int end, int worker) {
    EXPECT_LT(first, end) << "empty band";
    EXPECT_TRUE(worker >= 0 && worker < threads_) << worker;
    for (int i = first; i < end; ++i) ++counts_[i];
  }

  void expect_each_once() const {
    for (std::size_t i = 0; i < counts_.size(); ++i) EXPECT_EQ(1, counts_[i]) << "item " << i;
  }

 private:
  std::vector<std::atomic<int>> counts_;
  int threads_;
};

constexpr int kThreads[] = {1, 2, 3, 7};
constexpr int kHeights[] = {1, 2, 31, 32, 33, 64, 100};

/// Numbers of rows.
struct Count {
  int rows = 0;
  void add(const Count& other) { rows += other.rows; }
};

TEST(Bands, AddWhatIsMeasuredInEachRow) {
  for (const int threads : kThreads) {
    ThreadPool pool(threads);
    for (const int height : kHeights) {
      const Count sum =
          Bands(pool, height).sum_of_rows(Count{5}, [](int y0, int y1) { return Count{y1 - y0}; });
      EXPECT_EQ(5 + height, sum.rows) << threads << " threads";
    }
  }
}

TEST(Bands, CoverEachRowOnceInBandsOfAFixedNumberOfRows) {
  for (const int threads : kThreads) {
    ThreadPool pool(threads);
    for (const int height : kHeights) {
      Visits visits(height, threads);
      Bands(pool, height).rows([&](int y0, int y1, int worker) {
        EXPECT_EQ(0, y0 % Bands::kRows);
        EXPECT_LE(y1 - y0, Bands::kRows);
        visits.visit(y0, y1, worker);
      });
      visits.expect_each_once();
    }
  }
}

TEST(Bands, CoverEachRowOfBothViewsOnce) {
  for (const int threads : kThreads) {
    ThreadPool pool(threads);
    for (const int height : kHeights) {
      Visits left(height, threads), right(height, threads);
      Bands(pool, height).rows_of_both_views([&](int side, int y0, int y1, int worker) {
        ASSERT_TRUE(side == 0 || side == 1);
        (side == 0 ? left : right).visit(y0, y1, worker);
      });
      left.expect_each_once();
      right.expect_each_once();
    }
  }
}

TEST(Bands, GiveEachThreadOneBandOfAboutTheSameHeight) {
  for (const int threads : kThreads) {
    ThreadPool pool(threads);
    for (const int height : kHeights) {
      Visits visits(height, threads);
      std::atomic<int> bands{0};
      Bands(pool, height).rows_per_thread([&](int y0, int y1, int worker) {
        ++bands;
        EXPECT_NEAR(1.0 * height / std::min(threads, height), y1 - y0, 1);
        visits.visit(y0, y1, worker);
      });
      EXPECT_EQ(std::min(threads, height), bands);
      visits.expect_each_once();
    }
  }
}

TEST(Bands, CoverEachRowOnceInBandsOfAboutEqualWork) {
  for (const int threads : kThreads) {
    ThreadPool pool(threads);
    for (const int height : kHeights) {
      // All work in the last tenth of the rows; then no work at all.
      for (const int busy : {1, 0}) {
        const auto work = [&](int y) { return y >= height - height / 10 - 1 ? 1000 * busy : 0; };
        Visits visits(height, threads);
        Bands(pool, height).rows_by_work(work, [&](int y0, int y1, int worker) {
          visits.visit(y0, y1, worker);
        });
        visits.expect_each_once();
      }
    }
  }
}

TEST(Bands, SplitRowsWithMoreWorkAmongThreads) {
  ThreadPool pool(2);
  std::atomic<int> largest{0};
  const auto work = [](int y) { return y >= 80 ? 100 : 1; };
  Bands(pool, 100).rows_by_work(work, [&](int y0, int y1, int) {
    int sum = 0;
    for (int y = y0; y < y1; ++y) sum += work(y);
    int before = largest;
    while (sum > before && !largest.compare_exchange_weak(before, sum)) {
    }
  });
  EXPECT_LE(largest, (80 + 20 * 100) / 4 + 100) << "more than a quarter of the work plus one row";
}

TEST(Bands, CoverEachColumnOnceInBlocksThatShareNoCacheLine) {
  ThreadPool pool(3);
  for (const int columns : {1, 63, 64, 65, 200}) {
    Visits visits(columns, 3);
    Bands(pool, 10).columns(columns, [&](int x0, int x1, int worker) {
      EXPECT_EQ(0, x0 % 64);
      visits.visit(x0, x1, worker);
    });
    visits.expect_each_once();
  }
}

TEST(Bands, CoverEachItemOnceInBlocksOfAnySize) {
  ThreadPool pool(2);
  for (const int size : {1, 5, 8, 100}) {
    Visits visits(37, 2);
    Bands(pool, 10).blocks(37, size, [&](int first, int end, int worker) {
      EXPECT_LE(end - first, size);
      visits.visit(first, end, worker);
    });
    visits.expect_each_once();
  }
}

}  // namespace
}  // namespace mtstereo::bands_test
