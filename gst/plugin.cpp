// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gst/gst.h>

#include "cameras/mtrectify.hpp"
#include "cameras/mtsplit.hpp"
#include "cloud/mtcloud.hpp"
#include "filters/mtcolor.hpp"
#include "filters/mtconfidence.hpp"
#include "filters/mtdepth.hpp"
#include "matcher/mtstereo.hpp"
#include "network/mtwhole.hpp"
#include "shared/confidence_meta.hpp"
#include "shared/disparity_meta.hpp"
#include "shared/valid_columns_meta.hpp"

namespace mtstereo::plugin {
namespace {

struct Element {
  const char* name;
  GType (*type)();
};

/// The elements of the plugin. A new one needs its row here and its header above.
constexpr Element kElements[] = {
    {"mtstereo", gst_mtstereo_get_type},
    {"mtcolor", gst_mtstereo_color_get_type},
    {"mtconfidence", gst_mtstereo_confidence_get_type},
    {"mtdepth", gst_mtstereo_depth_get_type},
    {"mtcloud", gst_mtstereo_cloud_get_type},
    {"mtrectify", gst_mtstereo_rectify_get_type},
    {"mtsplit", gst_mtstereo_split_get_type},
    {"mtwhole", gst_mtstereo_whole_get_type},
};

gboolean plugin_init(GstPlugin* plugin) noexcept {
  if (!register_confidence_meta() || !register_disparity_meta() || !register_valid_columns_meta()) {
    return FALSE;
  }
  for (const Element& element : kElements) {
    if (!gst_element_register(plugin, element.name, GST_RANK_NONE, element.type())) return FALSE;
  }
  return TRUE;
}

}  // namespace
}  // namespace mtstereo::plugin

#define PACKAGE "mtstereo"
// The origin is a required field; this is GStreamer's own text where there is no address.
GST_PLUGIN_DEFINE(GST_VERSION_MAJOR, GST_VERSION_MINOR, mtstereo,
                  "Depth from two cameras: rectification, stereo matching (MTStereo 2.0), depths "
                  "and point clouds",
                  mtstereo::plugin::plugin_init, MTSTEREO_VERSION, "LGPL", "mtstereo",
                  "Unknown package origin")
