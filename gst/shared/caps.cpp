// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/caps.hpp"

namespace mtstereo::plugin {

std::string caps_text(const GstCaps* caps) {
  if (caps == nullptr) return "none";
  return TextPointer(gst_caps_to_string(caps)).get();
}

void add_pad_template(GstElementClass* element_class, const char* name, GstPadDirection direction,
                      const char* caps, GType pad_type) {
  const CapsPointer parsed(gst_caps_from_string(caps));
  gst_element_class_add_pad_template(
      element_class,
      gst_pad_template_new_with_gtype(name, direction, GST_PAD_ALWAYS, parsed.get(), pad_type));
}

CapsPointer filtered_caps(CapsPointer caps, GstCaps* filter) {
  if (filter == nullptr) return caps;
  return CapsPointer(gst_caps_intersect_full(filter, caps.get(), GST_CAPS_INTERSECT_FIRST));
}

}  // namespace mtstereo::plugin
