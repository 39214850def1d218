// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recordings/media/source.hpp"

namespace mtstereo::run {

/// The size that a PNG or JPEG image states, such as "1242x375"; empty if there is none.
std::string stated_size(const std::filesystem::path& image);

/// The images of both views that have the same size.
struct ImagesOfSize {
  std::string size;  ///< such as "1242x375"; empty if all images have the same
  Source left, right;
};

/// Divides two lists of images whose sizes change, as in KITTI 2015 and in collections of photos.
/// Images whose size the other view does not have are left out. One part if there are not at least
/// two sizes that both views have.
std::vector<ImagesOfSize> by_size(const Source& left, const Source& right);

}  // namespace mtstereo::run
