// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>

#include "base/thread_pool.hpp"

namespace mtstereo {

/// The parallel loops of the steps: splits the rows or the columns of an image into bands and runs
/// them on a thread pool. Each loop returns when all its bands are done. `worker` is the number of
/// the thread, 0 .. threads() - 1, so that each thread can use its own scratch memory.
///
/// Stages give the same result for any division into bands, so the result does not depend on the
/// number of threads.
class Bands {
 public:
  static constexpr int kRows = 32;     ///< rows of a band
  static constexpr int kColumns = 64;  ///< columns of a block; blocks share no cache line

  /// For images with this many rows. The pool must outlive the object.
  Bands(ThreadPool& pool, int height) : pool_(pool), height_(height) {}

  /// The same for images with another number of rows.
  Bands of_height(int rows) const { return {pool_, rows}; }

  int threads() const { return pool_.threads(); }
  int height() const { return height_; }

  /// Calls body(y0, y1, worker) for bands of kRows rows.
  template <typename Body>
  void rows(Body&& body) const {
    pool_.run(row_bands(), [&](int band, int worker) {
      const int y0 = band * kRows;
      body(y0, std::min(y0 + kRows, height_), worker);
    });
  }

  /// Adds what measure(y0, y1) returns for bands of kRows rows to `sum`, by its add(), in any
  /// order.
  template <typename Sum, typename Measure>
  Sum sum_of_rows(Sum sum, Measure&& measure) const {
    std::mutex mutex;
    rows([&](int y0, int y1, int) {
      const Sum in_band = measure(y0, y1);
      const std::lock_guard lock(mutex);
      sum.add(in_band);
    });
    return sum;
  }

  /// Calls body(side, y0, y1, worker) for bands of kRows rows of both views, side 0 and 1.
  template <typename Body>
  void rows_of_both_views(Body&& body) const {
    const int bands = row_bands();
    pool_.run(2 * bands, [&](int item, int worker) {
      const int y0 = item % bands * kRows;
      body(item / bands, y0, std::min(y0 + kRows, height_), worker);
    });
  }

  /// Calls body(y0, y1, worker) for one band per thread, for stages that carry intermediate results
  /// from row to row.
  template <typename Body>
  void rows_per_thread(Body&& body) const {
    const int bands = std::min(pool_.threads(), height_);
    pool_.run(bands, [&](int band, int worker) {
      const int y0 = static_cast<int>(std::int64_t{height_} * band / bands);
      const int y1 = static_cast<int>(std::int64_t{height_} * (band + 1) / bands);
      body(y0, y1, worker);
    });
  }

  /// Like rows_per_thread(), for rows that differ in work: work(y) estimates the work of row y.
  /// Several threads get two bands each, all of about equal work.
  template <typename Work, typename Body>
  void rows_by_work(Work&& work, Body&& body) const {
    const int bands = pool_.threads() == 1 ? 1 : std::min(2 * pool_.threads(), height_);
    std::int64_t total = 0;
    for (int y = 0; y < height_; ++y) total += work(y);
    const auto first_row = [&](int band) {
      int y = 0;
      for (std::int64_t done = 0; y < height_ && done * bands < total * band; ++y) done += work(y);
      return y;
    };
    pool_.run(bands, [&](int band, int worker) {
      const int y0 = first_row(band);
      const int y1 = band + 1 == bands ? height_ : first_row(band + 1);
      if (y0 < y1) body(y0, y1, worker);
    });
  }

  /// Calls body(x0, x1, worker) for blocks of kColumns of the columns 0 .. columns - 1.
  template <typename Body>
  void columns(int columns, Body&& body) const {
    blocks(columns, kColumns, body);
  }

  /// Calls body(i0, i1, worker) for blocks of `size` of the items 0 .. items - 1.
  template <typename Body>
  void blocks(int items, int size, Body&& body) const {
    pool_.run((items + size - 1) / size, [&](int block, int worker) {
      const int i0 = block * size;
      body(i0, std::min(i0 + size, items), worker);
    });
  }

 private:
  int row_bands() const { return (height_ + kRows - 1) / kRows; }

  ThreadPool& pool_;
  int height_;
};

}  // namespace mtstereo
