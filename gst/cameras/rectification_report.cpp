// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cameras/rectification_report.hpp"

#include <algorithm>
#include <utility>

#include "mtstereo/geometry/rig.hpp"

namespace mtstereo::plugin {

void report_rectification(GstElement* element, GstDebugCategory* category,
                          const RectificationPlan& plan, std::vector<std::string>& posted) {
  const bool left = plan.settings.side == Rectifier::Side::kLeft;
  GST_CAT_INFO_OBJECT(category, element, "rectified as %s camera: %s", left ? "left" : "right",
                      rig_text(rig_figures(plan.rectification)).c_str());
  std::vector<std::string> warnings;
  // Both elements of a pair read the same calibration: one speaks for it.
  if (left) warnings = plan.calibration.remarks;
  const auto remarks = rectification_remarks(plan.calibration, plan.rectification);
  if (!remarks) return;
  for (const RectificationRemark& remark : *remarks) {
    if (remark.side != plan.settings.side) continue;
    if (remark.warning) {
      warnings.push_back(remark.text);
    } else {
      GST_CAT_INFO_OBJECT(category, element, "%s", remark.text.c_str());
    }
  }
  for (const std::string& warning : warnings) {
    if (std::find(posted.begin(), posted.end(), warning) != posted.end()) continue;
    GST_ELEMENT_WARNING(element, LIBRARY, SETTINGS, ("%s", warning.c_str()),
                        ("calibration=%s", plan.settings.calibration.c_str()));
  }
  posted = std::move(warnings);
}

}  // namespace mtstereo::plugin
