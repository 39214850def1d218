// SPDX-License-Identifier: LGPL-2.1-or-later
// Numbered views for tests that run pipelines as processes.
//
// write COUNT LEFT RIGHT: writes the views as two files of raw GRAY8 frames of kNumberedWidth x
// kNumberedHeight.
//
// count MAPS: prints for each map of a file of raw GRAY16_LE frames the difference of the frame
// numbers of its pair, or "unknown".
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "support/numbered_views.hpp"

namespace {

using mtstereo::Side;
using mtstereo::test::kNumberedHeight;
using mtstereo::test::kNumberedWidth;

bool write_views(Side side, int count, const std::string& file) {
  std::ofstream output(file, std::ios::binary);
  for (int number = 0; number < count; ++number) {
    const auto image = mtstereo::test::numbered_image(side, number);
    output.write(reinterpret_cast<const char*>(image.pixels.data()),
                 static_cast<std::streamsize>(image.pixels.size()));
  }
  output.close();
  return output.good();
}

bool count_maps(const std::string& file) {
  std::ifstream input(file, std::ios::binary);
  if (!input) return false;
  const std::vector<char> bytes{std::istreambuf_iterator<char>(input), {}};
  constexpr std::size_t kPixels = std::size_t{kNumberedWidth} * kNumberedHeight;
  if (bytes.size() % (2 * kPixels) != 0) return false;
  for (std::size_t start = 0; start < bytes.size(); start += 2 * kPixels) {
    std::vector<std::uint16_t> map;
    map.reserve(kPixels);
    for (std::size_t i = start; i < start + 2 * kPixels; i += 2) {
      const auto low = static_cast<std::uint8_t>(bytes[i]);
      const auto high = static_cast<std::uint8_t>(bytes[i + 1]);
      map.push_back(static_cast<std::uint16_t>(high * 256 + low));
    }
    const auto difference = mtstereo::test::frame_difference(map);
    std::cout << (difference ? std::to_string(*difference) : "unknown") << '\n';
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  bool done = false;
  if (words.size() == 4 && words[0] == "write") {
    const int count = std::stoi(words[1]);
    done = write_views(Side::kLeft, count, words[2]) && write_views(Side::kRight, count, words[3]);
  } else if (words.size() == 2 && words[0] == "count") {
    done = count_maps(words[1]);
  }
  if (!done) std::cerr << "numbered-views: wrong arguments, or a file failed\n";
  return done ? 0 : 1;
}
