// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>
#include <mtstereo/mtstereo.hpp>

// Matches a pair with a textured square at 5 px disparity and prints the number of pixels found at
// that disparity.
int main() {
  static unsigned char left[60][160], right[60][160];
  for (int i = 0; i < 60 * 155; ++i) {
    const int x = i % 155, y = i / 155;
    left[y][x + 5] = right[y][x] =
        static_cast<unsigned char>((x / 5 * 7919 + y / 4 * 104729) % 251);
  }
  auto matcher = mtstereo::Matcher::create(mtstereo::Parameters());
  if (!matcher) return 1;
  const auto result = matcher->compute({left[0], 160, 60, 160}, {right[0], 160, 60, 160});
  if (!result) return std::fprintf(stderr, "%s\n", result.error().message.c_str()), 1;
  int found = 0;
  for (int i = 0; i < 60 * 160; ++i)
    found += (result->disparity.row(i / 160)[i % 160] + 128) / 256 == 5;
  return std::printf("%s %d\n", mtstereo::version(), found) < 0;
}
