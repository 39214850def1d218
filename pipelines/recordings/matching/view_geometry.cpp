// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/view_geometry.hpp"

#include <cmath>
#include <vector>

#include "lib/outputs/user_error.hpp"
#include "mtstereo/geometry/rig.hpp"
#include "recordings/matching/products.hpp"
#include "recordings/matching/work_facts.hpp"
#include "recordings/matching/work_options.hpp"

namespace mtstereo::run {
namespace {

// What is worth a sentence about a calibration and what it makes of the views.
void note(const StereoCalibration& calibration, const Rectification& views, bool rectifies,
          std::vector<std::string>& remarks) {
  remarks.insert(remarks.end(), calibration.remarks.begin(), calibration.remarks.end());
  if (!rectifies) return;
  const auto found = rectification_remarks(calibration, views);
  if (!found) return;
  for (const RectificationRemark& remark : *found) remarks.push_back(remark.text);
}

RectificationOptions options_of(const RectifiedShape& shape) {
  return {.alpha = shape.alpha, .width = shape.width, .height = shape.height};
}

Result<ViewGeometry> read_geometry(const Recording& recording, ViewSize size,
                                   std::vector<std::string>& remarks) {
  const Result<StereoCalibration> read =
      read_calibration(recording.calibration, size.width, size.height);
  if (!read) return read.error();
  const Result<StereoCalibration> scaled = scale_calibration(*read, size.width, size.height);
  if (!scaled) return scaled.error();
  const Result<Rectification> views = rectify(*scaled, options_of(recording.shape));
  if (!views) return views.error();
  note(*scaled, *views, !recording.rectified, remarks);
  ViewGeometry geometry{*views, read->format};
  geometry.views.left_rotation = {};
  geometry.views.right_rotation = {};
  return geometry;
}

// alpha and the size need views that are rectified here.
void check_shape(const Recording& recording) {
  if (recording.shape == RectifiedShape{} || !recording.rectified) return;
  throw UserError(recording.name +
                  ": the views are rectified already, so --alpha and --rectified-size have no "
                  "meaning; omit them, or state --rectified no");
}

bool needs_meters(const WorkOptions& options) {
  return makes(options, Product::kDepth) || makes(options, Product::kCloud);
}

// --far is not less than --near; the default of clouds may be.
void check_limits(const Work& work) {
  const Rectification& views = work.geometry->views;
  const double far = default_far(views.focal_length, views.baseline);
  if (!makes(work.options, Product::kCloud) || work.options.far || work.options.near < far) return;
  throw UserError(work.recording.name + ": clouds end at " + number_text(std::round(far)) +
                  " m, where the disparity is 4 px, and --near is " +
                  number_text(work.options.near) + " m: set --far, 0 for no limit");
}

}  // namespace

void find_geometry(Work& work) {
  const Recording& recording = work.recording;
  check_shape(recording);
  if (recording.calibration.empty()) return;
  const ViewSize size = view_size(work);
  Result<ViewGeometry> geometry = read_geometry(recording, size, work.remarks);
  if (geometry && recording.rectified &&
      (geometry->views.width != size.width || geometry->views.height != size.height)) {
    geometry = Error{ErrorCode::kInvalidCalibration,
                     recording.calibration + " describes rectified views of " +
                         std::to_string(geometry->views.width) + "x" +
                         std::to_string(geometry->views.height) + " px; the views have " +
                         std::to_string(size.width) + "x" + std::to_string(size.height) + " px"};
  }
  if (geometry) {
    work.geometry = std::move(*geometry);
    check_limits(work);
  } else if (!recording.rectified || needs_meters(work.options)) {
    throw UserError(recording.name + ": " + geometry.error().message);
  } else {
    work.remarks.push_back("Focal length and baseline are not known: " + geometry.error().message);
  }
}

double default_far(double focal_length, double baseline) {
  constexpr double kLeastDisparity = 4;  // [px]
  return focal_length * baseline / kLeastDisparity;
}

std::string measures_text(const Work& work) {
  if (!work.geometry) return {};
  const Parameters parameters = matcher_parameters(work.options);
  DisparityRange range;
  range.smallest = parameters.get(Parameter::kMinDisparity);
  range.largest = parameters.get(Parameter::kMaxDisparity) - 1;
  return rig_text(rig_figures(work.geometry->views, range));
}

}  // namespace mtstereo::run
