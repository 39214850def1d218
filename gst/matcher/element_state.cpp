// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

GST_DEBUG_CATEGORY(mtstereo_debug);

namespace {

void post(const ElementState& state, GstMessageType type, GQuark domain, gint code,
          const std::string& text, const std::string& details) {
  // gst_element_message_full() frees both texts.
  gst_element_message_full(GST_ELEMENT_CAST(state.element), type, domain, code,
                           g_strdup(text.c_str()), g_strdup(details.c_str()), "mtstereo", "", 0);
}

}  // namespace

const char* pad_name(Side side) { return side == Side::kLeft ? "sink_left" : "sink_right"; }

void ElementState::complete_settings() {
  const ObjectLock lock(element);
  if (complete.revision != settings.revision) complete = settings;
}

std::string ElementState::streams_text() const {
  std::string text;
  for (const Side side : kSides) {
    if (!text.empty()) text += "; ";
    text += std::string(pad_name(side)) + ": ";
    const Input& stream = input(side);
    if (!stream.has_caps) {
      text += "no caps yet";
      continue;
    }
    text += std::string(gst_video_format_to_string(GST_VIDEO_INFO_FORMAT(&stream.info))) + " " +
            std::to_string(stream.info.width) + "x" + std::to_string(stream.info.height) + " at " +
            std::to_string(stream.info.fps_n) + "/" + std::to_string(stream.info.fps_d) + " fps";
  }
  return text;
}

void post_error(ElementState& state, GQuark domain, gint code, const std::string& text,
                const std::string& details) {
  {
    const ObjectLock lock(state.element);
    if (state.failed) return;
    state.failed = true;
  }
  post(state, GST_MESSAGE_ERROR, domain, code, text, details);
}

bool has_failed(const ElementState& state) {
  const ObjectLock lock(state.element);
  return state.failed;
}

void post_warning(ElementState& state, const std::string& text, const std::string& details) {
  post(state, GST_MESSAGE_WARNING, GST_STREAM_ERROR, GST_STREAM_ERROR_FAILED, text, details);
}

void post_settings_warning(ElementState& state, const std::string& text,
                           const std::string& details) {
  post(state, GST_MESSAGE_WARNING, GST_LIBRARY_ERROR, GST_LIBRARY_ERROR_SETTINGS, text, details);
}

}  // namespace mtstereo::plugin
