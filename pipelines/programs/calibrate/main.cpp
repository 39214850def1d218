// SPDX-License-Identifier: LGPL-2.1-or-later

// mtcalibrate: calibrates two cameras from views of a printed board.

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <opencv2/core/utils/logger.hpp>

#include "lib/outputs/standard_output.hpp"
#include "programs/calibrate/page.hpp"
#include "programs/calibrate/session.hpp"

namespace mtstereo::calibrate {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

// The first Ctrl-C finishes with the views that there are, the second one ends the program.
void request_stop(int number) {
  stop_requested = true;
  std::signal(number, SIG_DFL);
}

int write_board(const Options& options) {
  write_page(make_page(options.board, options.paper), options.board_file);
  std::cout << options.board_file.string() << ": " << describe(options.board) << " on "
            << options.paper
            << ". Print it without scaling, check that its line is 100 mm long, mount it flat, and "
               "measure a square for --square.\n";
  return kWritten;
}

int run(const Options& options) {
  if (!options.board_file.empty()) return write_board(options);
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  std::ostream* status = isatty(STDERR_FILENO) == 1 ? &std::cerr : nullptr;
  return Session(options, std::cout, status, stop_requested).run();
}

}  // namespace
}  // namespace mtstereo::calibrate

int main(int argc, char** argv) {
  using namespace mtstereo::calibrate;
  try {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    const ParsedOptions parsed = parse_options(argc, argv);
    const int status = parsed.options ? run(*parsed.options) : parsed.exit_status;
    mtstereo::outputs::finish_standard_output();
    return status;
  } catch (const std::bad_alloc&) {
    std::cerr << "mtcalibrate: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "mtcalibrate: " << error.what() << '\n';
  } catch (...) {
    std::cerr << "mtcalibrate: unknown error\n";
  }
  return kNothingWritten;
}
