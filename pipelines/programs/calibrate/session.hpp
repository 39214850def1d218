// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <ostream>

#include "programs/calibrate/options.hpp"
#include "programs/calibrate/output_folder.hpp"
#include "programs/calibrate/report.hpp"

namespace mtstereo::calibrate {

/// From sources to the files of a calibration.
class Session {
 public:
  /// Messages go to `out`, and a line that is rewritten to `status` if it is not null. `stop`: the
  /// user wants to finish with the views that there are.
  Session(const Options& options, std::ostream& out, std::ostream* status,
          const std::atomic<bool>& stop);

  /// Returns an ExitStatus. Throws UserError if there is no calibration.
  int run();

 private:
  using Clock = std::chrono::steady_clock;

  void collect(PairSource& source);
  void take(const ImagePair& images, bool video);
  void check_sizes(const ImagePair& images);
  bool enough(const PairSource& source) const;
  void show_status(Verdict verdict) const;
  void give_hint();
  int finish(bool video);

  const Options& options_;
  std::ostream& out_;
  std::ostream* status_;
  const std::atomic<bool>& stop_;
  BoardFinder finder_;
  OutputFolder folder_;
  cv::Size left_size_, right_size_;
  std::optional<ViewChoice> choice_;
  std::vector<BoardView> views_;
  std::vector<std::string> names_;
  Track track_;
  PairCounts counts_;
  Clock::time_point last_view_ = Clock::now();
  Clock::time_point last_hint_ = Clock::now();
};

}  // namespace mtstereo::calibrate
