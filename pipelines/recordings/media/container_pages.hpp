// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "recordings/media/container_bytes.hpp"

namespace mtstereo::run {

/// What the pages of Ogg, or the tags of FLV, state about a file.
struct PagesCheck {
  std::string missing;  ///< missing_end()
  DamagedParts damage;  ///< damaged_parts()
};

/// The pages of Ogg have checksums and numbers.
PagesCheck check_ogg(Bytes& bytes);
/// The tags of FLV state their lengths twice.
PagesCheck check_flv(Bytes& bytes);

}  // namespace mtstereo::run
