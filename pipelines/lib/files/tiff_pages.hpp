// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mtstereo::files {

/// What the directory of an image in a TIFF file states.
struct TiffPage {
  std::uint64_t width = 0, height = 0;  ///< [px]
  std::uint64_t orientation = 1;        ///< as in EXIF; 1: stored as it is shown
};

/// The first two images of a TIFF file, also of a BigTIFF; none of another file.
std::vector<TiffPage> first_tiff_pages(const std::filesystem::path& file);

}  // namespace mtstereo::files
