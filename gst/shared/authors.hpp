// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::plugin {

/// The author field of all elements. GStreamer wants an address in it, "Name <name@example.org>";
/// the project has none that it could publish.
inline constexpr const char* kAuthors = "The mtstereo authors";

}  // namespace mtstereo::plugin
