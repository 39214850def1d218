// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <string_view>

struct _GstBuffer;

namespace mtstereo::run {

/// What the library for JPEG reports about the coded data of an image, such as "Corrupt JPEG data:
/// premature end of data segment"; empty if it reports nothing. Decodes the coefficients, but not
/// the pixels. Tables that a frame of Motion JPEG leaves out are the usual ones.
std::string damage_of_jpeg(std::string_view bytes);
/// The same for a buffer.
std::string damage_of_jpeg(_GstBuffer* buffer);

}  // namespace mtstereo::run
