// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "tools/eval/pfm.hpp"

extern char** environ;

namespace mtstereo::eval::testing {
namespace fs = std::filesystem;

void write_file(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream << bytes;
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file.string());
}

std::string read_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_image(const fs::path& file, const cv::Mat& image) {
  fs::create_directories(file.parent_path());
  if (!cv::imwrite(file.string(), image)) throw std::runtime_error("cannot write " + file.string());
}

std::string float_bytes(const std::vector<float>& values, bool big_endian) {
  std::string bytes;
  for (const float value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int i = 0; i < 4; ++i)
      bytes += static_cast<char>(bits >> 8 * (big_endian ? 3 - i : i) & 0xff);
  }
  return bytes;
}

TestPair make_pair(int width, int height, int disparity) {
  TestPair pair;
  cv::RNG random(42);
  cv::Mat coarse(height / 4 + 1, (width + disparity) / 6 + 1, CV_8UC1), texture;
  random.fill(coarse, cv::RNG::UNIFORM, 0, 256);
  cv::resize(coarse, texture, cv::Size(width + disparity, height), 0, 0, cv::INTER_NEAREST);
  // The point at column x of the left image is at column x - disparity of the right one.
  pair.left = texture(cv::Rect(0, 0, width, height)).clone();
  pair.right = texture(cv::Rect(disparity, 0, width, height)).clone();
  pair.truth = cv::Mat(height, width, CV_32FC1, cv::Scalar(disparity));
  pair.truth.colRange(0, disparity).setTo(std::numeric_limits<float>::infinity());
  return pair;
}

void write_pair_folder(const fs::path& folder, const TestPair& pair, int ndisp) {
  write_image(folder / "im0.png", pair.left);
  write_image(folder / "im1.png", pair.right);
  write_pfm(folder / "disp0GT.pfm", pair.truth);
  if (ndisp > 0) write_file(folder / "calib.txt", "doffs=0\nndisp=" + std::to_string(ndisp) + "\n");
}

void write_kitti_truth(const fs::path& file, const cv::Mat& truth) {
  cv::Mat stored(truth.size(), CV_16UC1);
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      const float value = truth.at<float>(y, x);
      stored.at<std::uint16_t>(y, x) =
          std::isfinite(value) ? static_cast<std::uint16_t>(std::lround(value * 256)) : 0;
    }
  }
  write_image(file, stored);
}

namespace {

// Pointers to the texts and a final null pointer.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::string name_of(const std::string& variable) { return variable.substr(0, variable.find('=')); }

// The environment of this process with these variables added or replaced.
std::vector<std::string> environment_with(const std::vector<std::string>& variables) {
  std::vector<std::string> result = variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const auto replaces = [&](const std::string& own) {
      return name_of(own) == name_of(*variable);
    };
    if (std::none_of(variables.begin(), variables.end(), replaces)) result.emplace_back(*variable);
  }
  return result;
}

std::string program_of(const char* variable) {
  const char* program = getenv(variable);
  if (program == nullptr) throw std::runtime_error(std::string(variable) + " names no program");
  return program;
}

}  // namespace

Outcome run_eval(const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment) {
  return run_program(program_of("MTSTEREO_EVAL"), arguments, environment);
}

Outcome run_plot(const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment) {
  return run_program(program_of("MTSTEREO_PLOT"), arguments, environment);
}

Outcome run_program(const std::string& program, const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment) {
  const TemporaryFolder folder;
  const std::string out = folder / "out", err = folder / "err";

  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = environment_with(environment);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int kNew = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), kNew, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), kNew, 0600);
  pid_t pid = 0;
  const int failed = posix_spawn(&pid, program.c_str(), &actions, nullptr,
                                 pointers_to(words).data(), pointers_to(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("cannot start " + program);

  int status = 0;
  waitpid(pid, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
}

std::string without_matplotlib(const fs::path& folder) {
  write_file(folder / "matplotlib.py",
             "raise ModuleNotFoundError(\"No module named 'matplotlib'\")\n");
  return "PYTHONPATH=" + folder.string();
}

}  // namespace mtstereo::eval::testing
