// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <string>

#include "mtstereo/parameters.hpp"
#include "shared/ownership.hpp"

/// Size and framerate in the caps of all pads. The library accepts no larger images.
#define MTSTEREO_SIZE_CAPS                                    \
  "width = (int) [ 1, 16384 ], height = (int) [ 1, 16384 ], " \
  "framerate = (fraction) [ 0/1, max ]"

namespace mtstereo::plugin {

static_assert(kLargestImageSide == 16384, "MTSTEREO_SIZE_CAPS has another size");

/// Caps as text for a message; "none" for NULL.
std::string caps_text(const GstCaps* caps);

/// Adds the template of an always pad with these caps and this type of pad.
void add_pad_template(GstElementClass* element_class, const char* name, GstPadDirection direction,
                      const char* caps, GType pad_type = GST_TYPE_PAD);

/// The part of `caps` that the filter of a caps query allows, in the order of the filter; all of
/// `caps` where `filter` is NULL.
CapsPointer filtered_caps(CapsPointer caps, GstCaps* filter);

}  // namespace mtstereo::plugin
