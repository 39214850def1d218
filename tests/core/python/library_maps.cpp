// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs the library on raw views in files, for the tests of the Python module: prints the offset of
// the map and writes its 32-bit values and the confidence of each pair.
//
// usage: library-maps VIEWS OUT WIDTH HEIGHT PAIRS [NAME=VALUE]...
// VIEWS has the left and the right view of each pair.
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "mtstereo/mtstereo.hpp"

namespace {

using namespace mtstereo;

std::vector<std::uint8_t> read(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

template <typename T>
void write(std::ofstream& out, ImageView<const T> view) {
  for (int y = 0; y < view.height; ++y) {
    out.write(reinterpret_cast<const char*>(view.row(y)), view.width * sizeof(T));
  }
}

void match(const std::vector<std::string>& words) {
  Parameters parameters;
  for (std::size_t i = 5; i < words.size(); ++i) {
    const std::size_t equals = words[i].find('=');
    const Status set = parameters.set(words[i].substr(0, equals), words[i].substr(equals + 1));
    if (!set) throw std::runtime_error(set.error().message);
  }
  auto matcher = Matcher::create(parameters);
  if (!matcher) throw std::runtime_error(matcher.error().message);
  const std::vector<std::uint8_t> views = read(words[0]);
  const int width = std::stoi(words[2]), height = std::stoi(words[3]), pairs = std::stoi(words[4]);
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  if (views.size() != 2 * pixels * pairs) throw std::runtime_error("the size of the file is wrong");
  std::ofstream out(words[1], std::ios::binary);
  for (int pair = 0; pair < pairs; ++pair) {
    const std::uint8_t* left = views.data() + 2 * pixels * pair;
    const auto result =
        matcher->compute({left, width, height, width}, {left + pixels, width, height, width});
    if (!result) throw std::runtime_error(result.error().message);
    write(out, result->disparity);
    write(out, result->confidence);
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + words[1]);
  std::printf("%d\n", parameters.disparity_offset());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 6) throw std::runtime_error("VIEWS OUT WIDTH HEIGHT PAIRS [NAME=VALUE]...");
    match({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "library-maps: %s\n", error.what());
    return 1;
  }
}
