// SPDX-License-Identifier: LGPL-2.1-or-later
#include "soak.hpp"

#include <malloc.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "mtstereo/matcher.hpp"

namespace mtstereo::soak {
namespace {

using Clock = std::chrono::steady_clock;

/// What the program has allocated, with what the allocator needs for it.
double allocated_mebibytes() {
  const struct mallinfo2 information = mallinfo2();
  return static_cast<double>(information.uordblks + information.hblkhd) / (1 << 20);
}

double resident_mebibytes() {
  malloc_trim(0);
  std::ifstream statistics("/proc/self/statm");
  double total = 0;
  double resident = 0;
  statistics >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// With MTSTEREO_SOAK_STACKS=1 and gdb: where all threads are.
void print_stacks() {
  if (std::getenv("MTSTEREO_SOAK_STACKS") == nullptr) return;
  const std::string command = "gdb -p " + std::to_string(getpid()) +
                              " -batch -ex 'set pagination off' -ex 'thread apply all bt' >&2";
  if (std::system(command.c_str()) != 0) std::fprintf(stderr, "gdb cannot print the stacks\n");
}

void print_row(const char* name, const Counts& counts) {
  std::printf("| %s | %llu | %llu | %llu | %llu | %llu | %llu | %llu | %llu |\n", name,
              static_cast<unsigned long long>(counts.cases),
              static_cast<unsigned long long>(counts.operations),
              static_cast<unsigned long long>(counts.maps),
              static_cast<unsigned long long>(counts.wrong),
              static_cast<unsigned long long>(counts.warned),
              static_cast<unsigned long long>(counts.unreadable),
              static_cast<unsigned long long>(counts.errors),
              static_cast<unsigned long long>(counts.failures));
}

}  // namespace

Soak::Soak(std::uint64_t seed) : random(seed), seed_(seed), watchdog_([this] { watch(); }) {}

Soak::~Soak() {
  stop_ = true;
  watchdog_.join();
}

void Soak::count(const std::string& kind, const std::function<void(Counts&)>& change) {
  const std::scoped_lock lock(mutex_);
  change(counts_[kind]);
}

void Soak::fail(const std::string& kind, const std::string& what) {
  std::fprintf(stderr, "failure: %s: %s\n", kind.c_str(), what.c_str());
  count(kind, [](Counts& counts) { ++counts.failures; });
}

void Soak::within(double seconds, const std::string& kind, const std::string& what,
                  const std::function<void()>& action) {
  {
    const std::scoped_lock lock(mutex_);
    deadline_ = Clock::now() +
                std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    operation_ = kind + ": " + what;
  }
  action();
  const std::scoped_lock lock(mutex_);
  deadline_ = Clock::time_point::max();
}

void Soak::watch() {
  while (!stop_) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    {
      const std::scoped_lock lock(mutex_);
      if (Clock::now() < deadline_) continue;
      ++hangs_;
      std::fprintf(stderr, "hang: %s\n", operation_.c_str());
    }
    print_stacks();
    // The thread that hangs cannot be stopped.
    print(0);
    std::fflush(stdout);
    _exit(1);
  }
}

void Soak::sample_memory() {
  const double minutes = std::chrono::duration<double>(Clock::now() - start_).count() / 60;
  const double resident = resident_mebibytes();
  const double allocated = allocated_mebibytes();
  const std::scoped_lock lock(mutex_);
  memory_.push_back({minutes, resident, allocated});
}

/// Compares the last quarter of the run with its second one: caches have been filled by then.
bool Soak::memory_grew() const {
  if (memory_.size() < 8 || memory_.back().minutes < 5) return false;
  const auto mean = [&](std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += memory_[i].allocated;
    return sum / static_cast<double>(last - first);
  };
  const std::size_t quarter = memory_.size() / 4;
  const double early = mean(quarter, 2 * quarter);
  return mean(3 * quarter, memory_.size()) > early * 1.1 + 8;
}

bool Soak::print(int leaks) {
  const std::scoped_lock lock(mutex_);
  const double minutes = std::chrono::duration<double>(Clock::now() - start_).count() / 60;
  std::printf("Version %s, %.1f minutes, %u processors, seed %llu.\n\n", version(), minutes,
              std::thread::hardware_concurrency(), static_cast<unsigned long long>(seed_));
  std::printf(
      "| cases | runs | operations | maps checked | wrong pairs | wrong after a warning | not "
      "readable | expected errors | failures |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  Counts all;
  for (const auto& [name, counts] : counts_) {
    print_row(name.c_str(), counts);
    all.cases += counts.cases;
    all.operations += counts.operations;
    all.maps += counts.maps;
    all.wrong += counts.wrong;
    all.warned += counts.warned;
    all.unreadable += counts.unreadable;
    all.errors += counts.errors;
    all.failures += counts.failures;
  }
  print_row("all", all);
  const bool grew = memory_grew();
  std::printf("\nHangs: %d. Leaked objects: %d. Memory [MiB], resident / allocated, at minutes:",
              hangs_, leaks);
  const std::size_t step = memory_.size() / 10 + 1;
  for (std::size_t i = 0; i < memory_.size(); i += step) {
    std::printf(" %.0f / %.1f (%.1f)", memory_[i].resident, memory_[i].allocated,
                memory_[i].minutes);
  }
  std::printf("%s.\n", grew ? " -- it grows" : "");
  std::printf(
      "State changes that GStreamer's bin did not complete although its elements did: %d.\n",
      stuck_bins_.load());
  // The maps of frames that are far apart are not readable either.
  const bool readable = all.unreadable * 200 <= all.maps;
  return all.wrong == 0 && readable && all.failures == 0 && hangs_ == 0 && leaks == 0 && !grew;
}

}  // namespace mtstereo::soak
