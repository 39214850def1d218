// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs the library on raw frames in files, with their alignment corrected, and writes the expected
// output of the element: 16-bit disparities with rows padded to 4 bytes.
//
// usage: match-raw LEFT RIGHT OUT WIDTH HEIGHT FRAMES INTERVAL PARAMETER=VALUE...
// The views are inspected every INTERVAL frames.
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "mtstereo/mtstereo.hpp"

namespace {

using namespace mtstereo;

std::vector<std::uint8_t> read(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

int fail(const std::string& message) {
  std::fprintf(stderr, "match-raw: %s\n", message.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  constexpr std::size_t kSettings = 7;
  if (arguments.size() < kSettings) return fail("arguments are missing");
  const std::string &left_file = arguments[0], &right_file = arguments[1], &out_file = arguments[2];
  const int width = std::stoi(arguments[3]), height = std::stoi(arguments[4]);
  const int frames = std::stoi(arguments[5]), interval = std::stoi(arguments[6]);

  Parameters parameters;
  for (std::size_t i = kSettings; i < arguments.size(); ++i) {
    const std::string& setting = arguments[i];
    const auto equals = setting.find('=');
    const Status set = parameters.set(setting.substr(0, equals), setting.substr(equals + 1));
    if (!set) return fail(set.error().message);
  }
  auto matcher = Matcher::create(parameters);
  if (!matcher) return fail(matcher.error().message);
  auto tracker = AlignmentTracker::create();
  if (!tracker) return fail(tracker.error().message);

  const std::vector<std::uint8_t> left = read(left_file);
  const std::vector<std::uint8_t> right = read(right_file);
  const int stride = (width + 3) / 4 * 4;
  const std::size_t frame_bytes = left.size() / frames;
  if (left.size() != right.size() || left.size() % frames != 0 ||
      frame_bytes < static_cast<std::size_t>(stride) * height) {
    return fail("the files do not contain " + std::to_string(frames) + " frames each");
  }
  const int out_stride = (2 * width + 3) / 4 * 4;
  std::ofstream out(out_file, std::ios::binary);
  for (int frame = 0; frame < frames; ++frame) {
    const GrayView left_view{left.data() + frame * frame_bytes, width, height, stride};
    const GrayView right_view{right.data() + frame * frame_bytes, width, height, stride};
    Status aligned = tracker->watch(left_view, right_view);
    if (aligned && frame % interval == 0) {
      aligned =
          tracker->inspect(left_view, right_view, parameters.integer(Parameter::kMaxDisparity),
                           parameters.integer(Parameter::kMinDisparity));
      // The element would inspect other pairs then.
      if (!tracker->trusted()) return fail("frame " + std::to_string(frame) + " is not trusted");
    }
    if (aligned) aligned = matcher->set_correction(tracker->correction());
    if (!aligned) return fail(aligned.error().message);
    const auto result = matcher->compute(left_view, right_view);
    if (!result) return fail(result.error().message);
    std::vector<std::uint16_t> written(static_cast<std::size_t>(out_stride / 2) * height, 0);
    const Status status =
        write_disparity16(result->disparity, 256, {written.data(), width, height, out_stride});
    if (!status) return fail(status.error().message);
    out.write(reinterpret_cast<const char*>(written.data()), written.size() * 2);
  }
  return out.good() ? 0 : fail("cannot write " + out_file);
}
