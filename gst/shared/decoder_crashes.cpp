// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/decoder_crashes.hpp"

#include <string_view>

namespace mtstereo::plugin {

void keep_from_crashing(GstElement* element) {
  const GstElementFactory* factory = gst_element_get_factory(element);
  if (factory == nullptr || std::string_view(GST_OBJECT_NAME(factory)) != "avdec_ffv1") return;
  g_object_set(element, "direct-rendering", FALSE, nullptr);
}

}  // namespace mtstereo::plugin
