// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/orientation.hpp"

#include "shared/ownership.hpp"

namespace mtstereo::plugin {

std::string turning_on(GstPad* pad) {
  std::string turning;
  for (guint i = 0;; ++i) {
    g_autoptr(GstEvent) event = gst_pad_get_sticky_event(pad, GST_EVENT_TAG, i);
    if (event == nullptr) break;
    GstTagList* tags = nullptr;
    gst_event_parse_tag(event, &tags);
    gchar* text = nullptr;
    if (gst_tag_list_get_string(tags, GST_TAG_IMAGE_ORIENTATION, &text) == FALSE) continue;
    turning = TextPointer(text).get();
  }
  return turning == "rotate-0" ? "" : turning;
}

std::string turning_problem(const std::string& turning) {
  return "players turn its frames (" + turning +
         " in its metadata), which are stored without that: turn those of both views before they "
         "are calibrated and matched (ffmpeg -i FILE -c:v ffv1 view.mkv)";
}

}  // namespace mtstereo::plugin
