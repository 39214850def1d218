// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/outputs/texts.hpp"

#include <glib.h>

#include <cstdarg>

namespace mtstereo::outputs {

std::string format(const char* pattern, ...) {
  va_list arguments;
  va_start(arguments, pattern);
  g_autofree gchar* text = g_strdup_vprintf(pattern, arguments);
  va_end(arguments);
  return text;
}

std::string decimal(double value, int decimals) { return format("%.*f", decimals, value); }

std::string percent(double fraction, int decimals) {
  return format("%.*f %%", decimals, 100 * fraction);
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace mtstereo::outputs
