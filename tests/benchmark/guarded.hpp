// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <opencv2/core.hpp>

namespace mtstereo::bench {

/// Runs the body of a benchmark program and returns its exit status; an exception is printed on the
/// standard error and makes it EXIT_FAILURE.
template <typename Body>
int guarded_main(Body&& body) {
  try {
    return body();
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
  } catch (...) {
    std::cerr << "error: an unknown exception was thrown\n";
  }
  return EXIT_FAILURE;
}

/// Runs the body of a benchmark; an exception becomes the benchmark's error, which fails the run.
template <typename Body>
void guarded(benchmark::State& state, Body&& body) {
  try {
    body();
  } catch (const std::exception& error) {
    state.SkipWithError(error.what());
  } catch (...) {
    state.SkipWithError("an unknown exception was thrown");
  }
}

/// Sets the number of OpenCV's threads for its own lifetime.
class OpenCvThreads {
 public:
  explicit OpenCvThreads(int threads) : before_(cv::getNumThreads()) { cv::setNumThreads(threads); }
  ~OpenCvThreads() { cv::setNumThreads(before_); }
  OpenCvThreads(const OpenCvThreads&) = delete;
  OpenCvThreads& operator=(const OpenCvThreads&) = delete;

 private:
  int before_;
};

}  // namespace mtstereo::bench
