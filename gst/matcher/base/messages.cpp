// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/base/messages.hpp"

namespace mtstereo::plugin {

GST_DEBUG_CATEGORY(mtstereo_debug);

std::string how_to_link(Side side) {
  return std::string("Link the other stream to it, by \"! NAME.") + pad_name(side) +
         "\" on a command line.";
}

void Messages::post(GstMessageType type, GQuark domain, gint code, const std::string& text,
                    const std::string& details) const {
  // gst_element_message_full() frees both texts.
  gst_element_message_full(element_, type, domain, code, g_strdup(text.c_str()),
                           g_strdup(details.c_str()), "mtstereo", "", 0);
}

void Messages::post_error(GQuark domain, gint code, const std::string& text,
                          const std::string& details) {
  if (!failed_.exchange(true)) post(GST_MESSAGE_ERROR, domain, code, text, details);
}

std::string Messages::with_formats(const std::string& facts) const {
  return facts.empty() ? formats_.text() : facts + "; " + formats_.text();
}

void Messages::error(GQuark domain, gint code, const std::string& text, const std::string& facts) {
  post_error(domain, code, text, with_formats(facts));
}

void Messages::warning(const std::string& text, const std::string& facts) {
  warning_of_pad(text, with_formats(facts));
}

void Messages::settings_warning(const std::string& text, const std::string& facts) {
  warning_of_property(text, with_formats(facts));
}

void Messages::error_of_pad(const std::string& text, const std::string& details) {
  post_error(GST_CORE_ERROR, GST_CORE_ERROR_PAD, text, details);
}

void Messages::warning_of_pad(const std::string& text, const std::string& details) {
  post(GST_MESSAGE_WARNING, GST_STREAM_ERROR, GST_STREAM_ERROR_FAILED, text, details);
}

void Messages::warning_of_property(const std::string& text, const std::string& details) {
  post(GST_MESSAGE_WARNING, GST_LIBRARY_ERROR, GST_LIBRARY_ERROR_SETTINGS, text, details);
}

}  // namespace mtstereo::plugin
