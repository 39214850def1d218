// SPDX-License-Identifier: LGPL-2.1-or-later
// Matches a pair three times on one thread. Prints the names of the steps, and calls
// mtstereo_step_ends() where the last frame begins and where each of its steps ends, for
// qemu_plugin.cpp.
// Usage: mtstereo-count-steps WIDTH HEIGHT LEFT RIGHT [PARAMETER=VALUE]...; the views are files of
// gray values, without a header.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "matcher/frame_matcher.hpp"
#include "mtstereo/matcher.hpp"

extern "C" [[gnu::noinline]] void mtstereo_step_ends() {
  asm volatile("");  // so that the compiler keeps all calls
}

namespace mtstereo {
namespace {

template <typename Checked>
void require(const Checked& checked) {
  if (!checked) throw std::runtime_error(checked.error().message);
}

std::vector<char> read_view(const std::string& file, std::size_t size) {
  std::vector<char> view(size);
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(view.data(), static_cast<std::streamsize>(size))) {
    throw std::runtime_error(file + " cannot be read, or has too few gray values");
  }
  return view;
}

Parameters parameters_of(int count, char** values) {
  Parameters parameters;
  for (int i = 0; i < count; ++i) {
    const std::string text = values[i];
    const std::size_t end = text.find('=');
    if (end == std::string::npos) throw std::runtime_error(text + " is not PARAMETER=VALUE");
    require(parameters.set(text.substr(0, end), text.substr(end + 1)));
  }
  require(parameters.set(Parameter::kThreads, 1));
  return parameters;
}

void run(int argc, char** argv) {
  if (argc < 5) throw std::runtime_error("give WIDTH HEIGHT LEFT RIGHT [PARAMETER=VALUE]...");
  const int width = std::max(std::atoi(argv[1]), 0), height = std::max(std::atoi(argv[2]), 0);
  const std::size_t size = static_cast<std::size_t>(width) * height;
  const std::vector<char> left = read_view(argv[3], size), right = read_view(argv[4], size);
  const auto view_of = [&](const std::vector<char>& view) {
    return GrayView{reinterpret_cast<const std::uint8_t*>(view.data()), width, height, width};
  };
  const Parameters parameters = parameters_of(argc - 5, argv + 5);
  Result<Matcher> checked = Matcher::create(parameters);
  require(checked);
  require(checked->compute(view_of(left), view_of(right)));

  FrameMatcher matcher{Settings(parameters)};
  (void)matcher.compute(view_of(left), view_of(right), [](const Step& step, const FrameMemory&) {
    std::puts(std::string(step.name).c_str());
  });
  mtstereo_step_ends();
  (void)matcher.compute(view_of(left), view_of(right),
                        [](const Step&, const FrameMemory&) { mtstereo_step_ends(); });
}

}  // namespace
}  // namespace mtstereo

int main(int argc, char** argv) {
  try {
    mtstereo::run(argc, argv);
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
