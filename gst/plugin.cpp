// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gst/gst.h>

#include "filters/mtcolor.hpp"
#include "filters/mtconfidence.hpp"
#include "matcher/mtstereo_element.hpp"
#include "mtstereo/mtstereo.hpp"
#include "shared/confidence_meta.hpp"

namespace {

gboolean plugin_init(GstPlugin* plugin) {
  return mtstereo::plugin::register_confidence_meta() &&
         gst_element_register(plugin, "mtstereo", GST_RANK_NONE, mtstereo_element_get_type()) &&
         gst_element_register(plugin, "mtcolor", GST_RANK_NONE, mtcolor_element_get_type()) &&
         gst_element_register(plugin, "mtconfidence", GST_RANK_NONE,
                              mtconfidence_element_get_type());
}

}  // namespace

#define PACKAGE "mtstereo"
GST_PLUGIN_DEFINE(
    GST_VERSION_MAJOR, GST_VERSION_MINOR, mtstereo,
    "Disparity of two rectified cameras (MTStereo 2.0), its confidence and pictures of it",
    plugin_init, MTSTEREO_VERSION, "LGPL", "mtstereo", "mtstereo")
