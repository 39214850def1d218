// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace mtstereo::test {

/// The bytes of a JPEG image, with an EXIF orientation.
inline std::string with_orientation(std::string jpeg, char orientation) {
  std::string exif(
      "\xff\xe1\0\x22"
      "Exif\0\0MM\0\x2a\0\0\0\x8\0\x1\x1\x12\0\x3\0\0\0\x1\0?\0\0\0\0\0\0",
      36);
  exif[exif.find('?')] = orientation;
  return jpeg.insert(2, exif);
}

}  // namespace mtstereo::test
