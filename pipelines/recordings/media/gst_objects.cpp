// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/gst_objects.hpp"

#include "lib/outputs/user_error.hpp"

namespace mtstereo::run {

namespace {

gboolean has_running_task(GstElement*, GstPad* pad, gpointer found) {
  if (gst_pad_get_task_state(pad) != GST_TASK_STARTED) return TRUE;
  *static_cast<bool*>(found) = true;
  return FALSE;
}

}  // namespace

void start_gstreamer() {
  g_autoptr(GError) error = nullptr;
  if (gst_init_check(nullptr, nullptr, &error) != FALSE) return;
  throw UserError(std::string("GStreamer cannot be initialized: ") +
                  (error != nullptr ? error->message : "unknown error"));
}

void StopElement::operator()(GstElement* element) const {
  gst_element_set_state(element, GST_STATE_NULL);
  gst_object_unref(element);
}

Pipeline parse_pipeline(const std::string& line) {
  start_gstreamer();
  g_autoptr(GError) error = nullptr;
  Pipeline pipeline(
      gst_parse_launch_full(line.c_str(), nullptr, GST_PARSE_FLAG_FATAL_ERRORS, &error));
  if (!pipeline) {
    throw UserError(std::string("GStreamer: ") + error->message +
                    " (GST_PLUGIN_PATH must have the folder of libgstmtstereo.so unless it is "
                    "installed; pipelines/install-packages.sh installs the other plugins)");
  }
  gst_object_ref_sink(pipeline.get());
  return pipeline;
}

ElementPointer element_of(const Pipeline& pipeline, const std::string& name) {
  return ElementPointer(gst_bin_get_by_name(GST_BIN(pipeline.get()), name.c_str()));
}

std::string posted_error(const Pipeline& pipeline) {
  g_autoptr(GstBus) bus = gst_element_get_bus(pipeline.get());
  g_autoptr(GstMessage) message = gst_bus_pop_filtered(bus, GST_MESSAGE_ERROR);
  if (message == nullptr) return {};
  g_autoptr(GError) error = nullptr;
  gst_message_parse_error(message, &error, nullptr);
  return error->message;
}

bool is_running(GstElement* pipeline) {
  bool found = false;
  GstIterator* elements = gst_bin_iterate_recurse(GST_BIN(pipeline));
  GValue value = G_VALUE_INIT;
  GstIteratorResult result = GST_ITERATOR_OK;
  while (!found && result != GST_ITERATOR_DONE && result != GST_ITERATOR_ERROR) {
    result = gst_iterator_next(elements, &value);
    if (result == GST_ITERATOR_RESYNC) gst_iterator_resync(elements);
    if (result != GST_ITERATOR_OK) continue;
    gst_element_foreach_pad(GST_ELEMENT(g_value_get_object(&value)), has_running_task, &found);
    g_value_reset(&value);
  }
  g_value_unset(&value);
  gst_iterator_free(elements);
  return found;
}

Taken take_sample(GstElement* sink, SamplePointer& sample) {
  constexpr GstClockTime kSlice = 100 * GST_MSECOND;
  GstAppSink* const app_sink = GST_APP_SINK(sink);
  sample.reset(gst_app_sink_try_pull_sample(app_sink, kSlice));
  if (sample) return Taken::kFrame;
  return gst_app_sink_is_eos(app_sink) != FALSE ? Taken::kEnd : Taken::kNothingYet;
}

}  // namespace mtstereo::run
