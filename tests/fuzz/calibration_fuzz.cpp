// SPDX-License-Identifier: LGPL-2.1-or-later
// The readers of calibration files. The first byte selects the size of the video, the second what
// follows '#' in the path, the rest is the file; a byte of 1 separates two files. What is accepted
// must be equal after it was written and read again.
#include <array>
#include <string>

#include "fuzz_folder.hpp"
#include "fuzz_input.hpp"
#include "mtstereo/geometry/calibration.hpp"

namespace mtstereo::fuzz {
namespace {

struct Size {
  int width, height;
};
constexpr std::array<Size, 5> kSizes = {{{0, 0}, {640, 480}, {1280, 720}, {1242, 375}, {-1, 7}}};
constexpr std::array<const char*, 8> kSelections = {"",    "#gray",      "#color", "#HD",
                                                    "#2K", "#cam1-cam0", "#1-2",   "#2-0"};

void check_scaled(const StereoCalibration& calibration) {
  for (const Size& size : kSizes) {
    const Result<StereoCalibration> scaled =
        scale_calibration(calibration, size.width, size.height);
    if (!scaled) {
      require(!scaled.error().message.empty(), "an error has a message");
      continue;
    }
    require(scaled->left.width == size.width && scaled->right.height == size.height,
            "a scaled calibration has the size");
  }
}

void check_accepted(const StereoCalibration& calibration) {
  require(check_calibration(calibration).ok(), "what is read is valid");
  require(!calibration.format.empty(), "the format is named");
  require(calibration.baseline() > 0 && calibration.baseline() <= kLongestBaseline,
          "a baseline is in range");
  check_scaled(calibration);
  const std::string file = folder().path() / "written.yml";
  require(write_calibration(calibration, file).ok(), "what is read can be written");
  const Result<StereoCalibration> again = read_calibration(file);
  require(again.ok(), "what is written can be read");
  require(again->left == calibration.left && again->right == calibration.right &&
              again->rotation == calibration.rotation &&
              again->translation == calibration.translation &&
              again->rectification == calibration.rectification,
          "a calibration is equal after it was written and read");
}

}  // namespace
}  // namespace mtstereo::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  mtstereo::fuzz::folder();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mtstereo;
  using namespace mtstereo::fuzz;
  FuzzInput input(data, size);
  const Size video = input.one_of(kSizes);
  const std::string selection = input.one_of(kSelections);
  const std::string_view bytes = input.rest();
  const std::size_t end = bytes.find_first_of("\1\2");
  std::string path = folder().write("first", bytes.substr(0, end));
  if (end != std::string_view::npos) {
    const std::string second = folder().write("second", bytes.substr(end + 1));
    if (bytes[end] == '\1') path += "," + second;
  }
  const Result<StereoCalibration> result =
      read_calibration(path + selection, video.width, video.height);
  if (result) {
    check_accepted(*result);
  } else {
    require(!result.error().message.empty(), "an error has a message");
  }
  return 0;
}
