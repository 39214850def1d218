// SPDX-License-Identifier: LGPL-2.1-or-later
// depth-of-center: gets each disparity map of two rectified videos from an appsink, and prints the
// distance of the object in the center of the left image.
#include <gst/app/gstappsink.h>
#include <gst/gst.h>
#include <gst/video/video.h>

#include <cstdint>

struct Camera {
  double focal, baseline;  // [px], [m]
};

// The disparity of the center [px]; 0 if it is unknown.
static double center_disparity(GstSample* sample) {
  // px = value / disparity-scale + disparity-offset; 0 is unknown.
  int scale = 256, offset = 0;
  const GstCaps* caps = gst_sample_get_caps(sample);
  const GstStructure* fields = gst_caps_get_structure(caps, 0);
  gst_structure_get_int(fields, "disparity-scale", &scale);
  gst_structure_get_int(fields, "disparity-offset", &offset);
  GstVideoInfo info;
  GstVideoFrame frame;
  if (!gst_video_info_from_caps(&info, caps) ||
      !gst_video_frame_map(&frame, &info, gst_sample_get_buffer(sample), GST_MAP_READ)) {
    return 0;
  }
  const auto* row = static_cast<const std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0)) +
                    info.height / 2 * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0);
  const int value = GST_READ_UINT16_LE(row + info.width / 2 * 2);  // GRAY16_LE
  gst_video_frame_unmap(&frame);
  return value == 0 ? 0 : static_cast<double>(value) / scale + offset;
}

// Called for each map, by the thread that computes them.
static GstFlowReturn print_distance(GstAppSink* sink, gpointer camera) {
  GstSample* sample = gst_app_sink_pull_sample(sink);
  if (sample == nullptr) return GST_FLOW_EOS;
  const auto* of = static_cast<const Camera*>(camera);
  const double disparity = center_disparity(sample);
  g_print("%8.3f s  ", static_cast<double>(GST_BUFFER_PTS(gst_sample_get_buffer(sample))) / 1e9);
  if (disparity > 0) {
    g_print("disparity %7.2f px  distance %7.3f m\n", disparity,
            of->focal * of->baseline / disparity);
  } else {
    g_print("no disparity at the center\n");
  }
  gst_sample_unref(sample);
  return GST_FLOW_OK;
}

// Plays to the end. The exit status.
static int play(GstElement* pipeline) {
  gst_element_set_state(pipeline, GST_STATE_PLAYING);
  GstMessage* message =
      gst_bus_timed_pop_filtered(GST_ELEMENT_BUS(pipeline), GST_CLOCK_TIME_NONE,
                                 static_cast<GstMessageType>(GST_MESSAGE_ERROR | GST_MESSAGE_EOS));
  const bool failed = GST_MESSAGE_TYPE(message) == GST_MESSAGE_ERROR;
  if (failed) {
    GError* error = nullptr;
    gchar* details = nullptr;
    gst_message_parse_error(message, &error, &details);
    g_printerr("depth-of-center: %s\n%s\n", error->message, details != nullptr ? details : "");
  }
  gst_element_set_state(pipeline, GST_STATE_NULL);
  return failed ? 1 : 0;
}

int main(int argc, char** argv) {
  gst_init(&argc, &argv);
  Camera camera{argc == 5 ? g_ascii_strtod(argv[3], nullptr) : 0,
                argc == 5 ? g_ascii_strtod(argv[4], nullptr) : 0};
  if (!(camera.focal > 0 && camera.baseline > 0)) {
    g_printerr("usage: depth-of-center LEFT RIGHT FOCAL-LENGTH-IN-PX BASELINE-IN-M\n");
    return 2;
  }
  GError* error = nullptr;
  GstElement* pipeline = gst_parse_launch(
      "filesrc name=left ! decodebin ! videoconvert ! queue ! m.sink_left "
      "filesrc name=right ! decodebin ! videoconvert ! queue ! m.sink_right "
      "mtstereo name=m ! appsink name=disparity sync=false emit-signals=true",
      &error);
  if (error != nullptr) {
    g_printerr("depth-of-center: %s\n", error->message);
    return 1;
  }
  // As properties, the file names may have any characters.
  gst_child_proxy_set(GST_CHILD_PROXY(pipeline), "left::location", argv[1], "right::location",
                      argv[2], nullptr);
  GstElement* sink = gst_bin_get_by_name(GST_BIN(pipeline), "disparity");
  g_signal_connect(sink, "new-sample", G_CALLBACK(print_distance), &camera);
  return play(pipeline);
}
