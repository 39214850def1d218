// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fuzz_gst.hpp"

#include <cstdlib>
#include <cstring>

#include "fuzz_input.hpp"

namespace mtstereo::fuzz {
namespace {

constexpr int kMostPixels = 1 << 16;

/// Whether GStreamer parses caps: its parser may find text wrong in its own way.
bool is_parsing = false;

/// Aborts at a critical message, which means a bug in an element or in a target. Warnings about
/// wrong inputs are expected, as is GObject's message about a value that is out of range.
void handle_message(const gchar* domain, GLogLevelFlags level, const gchar* message, gpointer) {
  if (is_parsing) return;
  if ((level & (G_LOG_LEVEL_CRITICAL | G_LOG_LEVEL_ERROR)) == 0) return;
  if (std::strstr(message, "out of range for property") != nullptr) return;
  std::fprintf(stderr, "%s: %s\n", domain, message);
  require(false, "there is no critical message");
}

/// Initializes GStreamer with the plugin of this build only. A critical message ends the program.
void init_gstreamer() {
  // No other plugin, and no file of the user.
  setenv("GST_REGISTRY_DISABLE", "yes", 1);
  setenv("GST_PLUGIN_SYSTEM_PATH_1_0", "/nonexistent", 1);
  setenv("GST_DEBUG", "0", 1);
  gst_init(nullptr, nullptr);
  g_log_set_default_handler(handle_message, nullptr);
  GError* error = nullptr;
  GstPlugin* plugin = gst_plugin_load_file(MTSTEREO_PLUGIN_FILE, &error);
  if (plugin == nullptr) std::fprintf(stderr, "%s\n", error->message);
  require(plugin != nullptr, "the plugin can be loaded");
  gst_object_unref(plugin);
}

}  // namespace

TestedElement::TestedElement(const char* factory)
    : element_(gst_element_factory_make(factory, nullptr)), bus_(gst_bus_new()) {
  require(element_ != nullptr, "the element exists");
  gst_object_ref_sink(element_);
  gst_element_set_bus(element_, bus_);
}

TestedElement::~TestedElement() {
  has_failed();
  gst_element_set_state(element_, GST_STATE_NULL);
  gst_element_set_bus(element_, nullptr);
  gst_bus_set_flushing(bus_, TRUE);
  gst_object_unref(bus_);
  require(GST_OBJECT_REFCOUNT_VALUE(element_) == 1, "nothing else holds the element");
  gst_object_unref(element_);
}

bool TestedElement::has_failed() {
  while (const MessagePointer message{gst_bus_pop(bus_)}) {
    if (GST_MESSAGE_TYPE(message.get()) != GST_MESSAGE_ERROR) continue;
    failed_ = true;
    GError* error = nullptr;
    gchar* details = nullptr;
    gst_message_parse_error(message.get(), &error, &details);
    require(error->message[0] != '\0', "an error states its cause");
    require(details != nullptr && details[0] != '\0', "an error has details");
    g_error_free(error);
    g_free(details);
  }
  return failed_;
}

CapsPointer parsed_caps(const std::string& text) {
  is_parsing = true;
  CapsPointer caps(gst_caps_from_string(text.c_str()));
  is_parsing = false;
  return caps;
}

CapsPointer fixed_caps(const std::string& text) {
  CapsPointer caps = parsed_caps(text);
  if (!caps || gst_caps_is_empty(caps.get()) || gst_caps_is_any(caps.get())) return nullptr;
  caps.reset(gst_caps_fixate(caps.release()));
  if (!gst_caps_is_fixed(caps.get())) return nullptr;
  int width = 0;
  int height = 0;
  const GstStructure* structure = gst_caps_get_structure(caps.get(), 0);
  gst_structure_get_int(structure, "width", &width);
  gst_structure_get_int(structure, "height", &height);
  const std::int64_t pixels = static_cast<std::int64_t>(width) * height;
  if (pixels > kMostPixels || width > kMostPixels || height > kMostPixels) return nullptr;
  return caps;
}

GstBuffer* pattern_buffer(std::size_t size, unsigned seed) {
  GstBuffer* buffer = gst_buffer_new_allocate(nullptr, size, nullptr);
  GstMapInfo map;
  if (size == 0 || !gst_buffer_map(buffer, &map, GST_MAP_WRITE)) return buffer;
  unsigned state = seed;
  for (gsize i = 0; i < map.size; ++i) {
    state = state * 1664525U + 1013904223U;
    map.data[i] = static_cast<guint8>(state >> 24);
  }
  gst_buffer_unmap(buffer, &map);
  return buffer;
}

}  // namespace mtstereo::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  mtstereo::fuzz::init_gstreamer();
  return 0;
}
