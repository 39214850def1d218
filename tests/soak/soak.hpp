// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "support/numbered_views.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::soak {

/// Random choices; equal for equal seeds.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// least .. most, both possible.
  std::int64_t between(std::int64_t least, std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(least, most)(engine_);
  }
  bool chance(double probability) { return std::bernoulli_distribution(probability)(engine_); }
  template <typename Container>
  const auto& one_of(const Container& choices) {
    return *std::next(std::begin(choices),
                      between(0, static_cast<std::int64_t>(std::size(choices)) - 1));
  }
  std::uint64_t seed() { return engine_(); }

 private:
  std::mt19937_64 engine_;
};

/// What was counted in one kind of cases.
struct Counts {
  std::uint64_t cases = 0;
  std::uint64_t operations = 0;  ///< seeks, state changes, values set, frames, caps, ...
  std::uint64_t maps = 0;        ///< maps whose frame numbers were checked
  std::uint64_t wrong = 0;       ///< maps of a wrong pair without a warning or error before
  std::uint64_t warned = 0;      ///< maps of a wrong pair after a warning or error
  std::uint64_t unreadable = 0;  ///< maps that do not state the difference of the frame numbers
  std::uint64_t errors = 0;      ///< errors that were expected
  std::uint64_t failures = 0;    ///< what must not happen: each is printed
};

/// The counts, the watchdog and the memory of a run. Any thread may call count() and fail().
class Soak {
 public:
  explicit Soak(std::uint64_t seed);
  ~Soak();
  Soak(const Soak&) = delete;
  Soak& operator=(const Soak&) = delete;

  /// Changes the counts of a kind of cases.
  void count(const std::string& kind, const std::function<void(Counts&)>& change);
  /// Counts and prints a failure.
  void fail(const std::string& kind, const std::string& what);

  /// Runs something that must return within this time. If it does not, the table is printed with
  /// the hang, and the program ends.
  void within(double seconds, const std::string& kind, const std::string& what,
              const std::function<void()>& action);

  /// Counts a state change that only the bin did not complete.
  void bin_got_stuck() { ++stuck_bins_; }

  /// Reads the resident memory.
  void sample_memory();
  /// Prints the table in Markdown. Returns true if nothing failed.
  bool print(int leaks);

  Random random;

 private:
  void watch();
  bool memory_grew() const;

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::uint64_t seed_;
  std::mutex mutex_;  // guards all below
  std::map<std::string, Counts> counts_;
  std::chrono::steady_clock::time_point deadline_ = std::chrono::steady_clock::time_point::max();
  std::string operation_;
  int hangs_ = 0;
  struct MemorySample {
    double minutes;
    double resident;   ///< [MiB]
    double allocated;  ///< [MiB]; it does not contain what the allocator keeps for later
  };
  std::vector<MemorySample> memory_;
  std::atomic<int> stuck_bins_{0};
  std::atomic<bool> stop_{false};
  std::thread watchdog_;
};

/// A pipeline whose messages and maps are checked. The mtstereo is named m, if there is one.
class CheckedPipeline {
 public:
  /// `numbered`: the maps of m state the difference of the frame numbers.
  CheckedPipeline(Soak& soak, std::string kind, const std::string& launch, bool numbered);
  /// Stops the pipeline within 20 s, and counts what it did.
  ~CheckedPipeline();
  CheckedPipeline(const CheckedPipeline&) = delete;
  CheckedPipeline& operator=(const CheckedPipeline&) = delete;

  GstElement* element() const { return pipeline_->element(); }
  GstElement* named(const char* name) const { return pipeline_->named(name); }
  void set_state(GstState state);
  /// Waits until a state change or a seek is complete. False if GStreamer's bin never completes it
  /// although all of its elements have: a race in GstBin between set_state() and the end of a
  /// preroll, which pipelines without mtstereo show as often. The case should end then.
  [[nodiscard]] bool settle(const char* what);
  bool seek(double rate, GstSeekFlags flags, GstClockTime from, GstClockTime to);
  /// Forgets an end of the stream that was posted before.
  void forget_end();
  /// Waits for the end of the stream or of a segment, or an error.
  void wait_for_end(const char* what);
  /// Reads all messages. True if there was an error.
  bool failed();
  /// The text of the first error.
  std::string error();
  std::uint64_t maps() const { return maps_; }

 private:
  static GstPadProbeReturn check_map(GstPad* pad, GstPadProbeInfo* info, gpointer self);
  void take(GstMessage* message);

  Soak& soak_;
  std::string kind_;
  bool numbered_;
  std::string history_;  ///< states and seeks, for the report of a hang
  std::unique_ptr<test::Pipeline> pipeline_;
  std::atomic<std::uint64_t> maps_{0};
  std::atomic<std::uint64_t> wrong_{0};
  std::atomic<std::uint64_t> warned_maps_{0};
  std::atomic<std::uint64_t> unreadable_{0};
  std::atomic<bool> warned_{false};
  std::mutex mutex_;
  std::string error_;   ///< the first one of any element
  bool ended_ = false;  ///< the end of the stream or of a segment was posted
};

/// Whether an error or warning of an element states a cause: a sentence, and details.
bool states_cause(const std::string& text, const std::string& details);

// The kinds of cases. Each call runs one case, whose choices are random.

void seek_in_files(Soak& soak);
void change_states(Soak& soak);
void set_properties(Soak& soak);
void change_caps(Soak& soak);
void send_wrong_caps(Soak& soak);
void send_wrong_frames(Soak& soak);
void end_streams(Soak& soak);
void relink_pads(Soak& soak);
void lose_frames(Soak& soak);
void play_live(Soak& soak);

/// Encodes the files that seek_in_files() needs, in this folder.
void make_files(const std::string& folder);

}  // namespace mtstereo::soak
