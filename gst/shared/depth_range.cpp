// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/depth_range.hpp"

#include <limits>

#include "shared/ownership.hpp"

namespace mtstereo::plugin {

double DepthRange::end() const { return far == 0 ? std::numeric_limits<double>::infinity() : far; }

bool check_range_at_start(gpointer element, const DepthRange& range) {
  if (range.valid()) return true;
  GST_ELEMENT_ERROR(element, RESOURCE, SETTINGS,
                    ("near=%g and far=%g are not a valid range: near must be less than far.",
                     range.near, range.far),
                    (nullptr));
  return false;
}

DepthRange settle_range(gpointer element, DepthRange& set, DepthRange& last) {
  DepthRange refused;
  {
    const ObjectLock lock(element);
    if (set.valid()) {
      last = set;
      return last;
    }
    refused = set;
    set = last;
  }
  GST_ELEMENT_WARNING(element, RESOURCE, SETTINGS,
                      ("near=%g and far=%g are not a valid range: near must be less than far. "
                       "near=%g and far=%g remain in effect.",
                       refused.near, refused.far, last.near, last.far),
                      (nullptr));
  g_object_notify(G_OBJECT(element), "near");
  g_object_notify(G_OBJECT(element), "far");
  return last;
}

}  // namespace mtstereo::plugin
