// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <string_view>

// Names of files and texts of foreign files may have any bytes. In messages and in JSON, each byte
// that is not valid UTF-8 or belongs to a control character is written as \xHH.

namespace mtstereo::outputs {

/// A text for a message. A text that is printable already does not change.
std::string printable(std::string_view text);
/// The same for a text of several lines.
std::string printable_lines(std::string_view text);

/// A name for JSON, from which unescaped() makes the name again: a backslash is written as \x5c.
std::string escaped(std::string_view name);
std::string unescaped(std::string_view text);

}  // namespace mtstereo::outputs
