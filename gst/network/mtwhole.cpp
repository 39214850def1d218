// SPDX-License-Identifier: LGPL-2.1-or-later
#include "network/mtwhole.hpp"

#include <gst/base/gstbasetransform.h>

#include "shared/authors.hpp"

namespace mtstereo::plugin {

GST_DEBUG_CATEGORY_STATIC(mtwhole_debug);
#define GST_CAT_DEFAULT mtwhole_debug

namespace {

struct GstMtWhole {
  GstBaseTransform parent;
};

struct GstMtWholeClass {
  GstBaseTransformClass parent_class;
};

constexpr const char* kCaps = "video/x-h264, alignment = au, parsed = true";

}  // namespace

G_DEFINE_TYPE(GstMtWhole, gst_mtstereo_whole, GST_TYPE_BASE_TRANSFORM)

namespace {

/// h264parse sets the marker on a picture when the start of the next one follows it. Upstream of a
/// gap, and at the end of the stream, it outputs what it has without the marker.
GstFlowReturn transform_ip(GstBaseTransform* transform, GstBuffer* picture) noexcept {
  if (GST_BUFFER_FLAG_IS_SET(picture, GST_BUFFER_FLAG_MARKER)) return GST_FLOW_OK;
  GST_DEBUG_OBJECT(transform, "no end, dropping %" GST_PTR_FORMAT, static_cast<void*>(picture));
  return GST_BASE_TRANSFORM_FLOW_DROPPED;
}

GstStaticPadTemplate sink_template =
    GST_STATIC_PAD_TEMPLATE("sink", GST_PAD_SINK, GST_PAD_ALWAYS, GST_STATIC_CAPS(kCaps));
GstStaticPadTemplate src_template =
    GST_STATIC_PAD_TEMPLATE("src", GST_PAD_SRC, GST_PAD_ALWAYS, GST_STATIC_CAPS(kCaps));

}  // namespace

static void gst_mtstereo_whole_init(GstMtWhole*) {}

static void gst_mtstereo_whole_class_init(GstMtWholeClass* element_class) {
  GST_DEBUG_CATEGORY_INIT(mtwhole_debug, "mtwhole", 0, "whole pictures");
  auto* element = reinterpret_cast<GstElementClass*>(element_class);
  gst_element_class_set_static_metadata(
      element, "Whole pictures", "Filter/Video/Network",
      "Drops truncated H.264 pictures: those whose end h264parse has not seen", kAuthors);
  gst_element_class_add_static_pad_template(element, &sink_template);
  gst_element_class_add_static_pad_template(element, &src_template);
  auto* transform = reinterpret_cast<GstBaseTransformClass*>(element_class);
  transform->transform_ip = transform_ip;
}

}  // namespace mtstereo::plugin
