// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/settings_in_use.hpp"

#include <vector>

#include "matcher/output/output_caps.hpp"
#include "shared/caps.hpp"

namespace mtstereo::plugin {
namespace {

void refuse_start(ElementState& state, const MatchSettings& settings, const Status& status) {
  state.messages.error(GST_LIBRARY_ERROR, GST_LIBRARY_ERROR_SETTINGS, status.error().message,
                       "settings:" + settings.text());
}

/// Downstream may require a scale or a range, as a capsfilter does. It is only asked if the caps
/// would change while maps flow.
Status check_downstream(const ElementState& state, const MatchSettings& settings) {
  if (!gst_pad_has_current_caps(state.output.pad())) return {};
  if (settings.unit() == state.engine.settings().unit()) return {};
  const CapsPointer offered = output_caps(state.formats[Side::kLeft], settings.unit());
  const CapsPointer accepted(gst_pad_peer_query_caps(state.output.pad(), nullptr));
  if (!accepted || gst_caps_can_intersect(offered.get(), accepted.get())) return {};
  return Error{ErrorCode::kInvalidCombination,
               "downstream does not accept a disparity map with max-disparity = " +
                   settings.parameters.text(Parameter::kMaxDisparity) +
                   ", min-disparity = " + settings.parameters.text(Parameter::kMinDisparity) +
                   " and disparity-scale = " + std::to_string(settings.disparity_scale) +
                   ": it accepts " + caps_text(accepted.get())};
}

/// Checks that the settings fit each other and the streams.
Status check(const ElementState& state, const MatchSettings& settings) {
  if (!settings.problem.empty()) return Error{ErrorCode::kInvalidParameter, settings.problem};
  if (Status status = settings.parameters.check_scale16(settings.disparity_scale); !status) {
    return status;
  }
  const StreamFormat& left = state.formats[Side::kLeft];
  if (!left.has_caps) return {};
  Status status = settings.parameters.check_frame(left.video.width, left.video.height);
  return status ? check_downstream(state, settings) : status;
}

Status activate(ElementState& state, const MatchSettings& settings) {
  Status status = check(state, settings);
  if (status) status = state.engine.fit(settings);
  return status;
}

/// The names and values of what differs: " max-disparity=300 ...".
struct Differences {
  std::vector<const char*> names;
  std::string refused;
  std::string kept;
};

Differences differences(const MatchSettings& refused, const MatchSettings& kept) {
  Differences found;
  for (const ParameterInfo& info : parameter_table()) {
    const std::string value = refused.parameters.text(info.id);
    const std::string before = kept.parameters.text(info.id);
    if (value == before) continue;
    found.names.push_back(info.name);
    found.refused += std::string(" ") + info.name + "=" + value;
    found.kept += std::string(" ") + info.name + "=" + before;
  }
  if (refused.disparity_scale != kept.disparity_scale) {
    found.names.push_back("disparity-scale");
    found.refused += " disparity-scale=" + std::to_string(refused.disparity_scale);
    found.kept += " disparity-scale=" + std::to_string(kept.disparity_scale);
  }
  return found;
}

/// Returns the properties that must fit each other to their last values, unless they were changed
/// again in the meantime: the next pair judges those values then. The other properties keep theirs.
void restore(ElementState& state, const MatchSettings& refused, const Status& status) {
  const auto restored = state.properties.restore(refused, state.engine.settings());
  if (!restored) return;
  state.engine.use(*restored);
  const Differences changes = differences(refused, *restored);
  for (const char* name : changes.names) g_object_notify(G_OBJECT(state.element), name);
  state.messages.settings_warning(
      "The new settings were rejected; previous values kept: " + status.error().message + ".",
      "refused:" + changes.refused + "; in use:" + changes.kept);
}

}  // namespace

bool apply_settings(ElementState& state) {
  const StreamFormat& left = state.formats[Side::kLeft];
  const int width = left.has_caps ? left.video.width : 0;
  const int height = left.has_caps ? left.video.height : 0;
  if (state.engine.has_revision(state.properties.committed_revision()) &&
      state.checked_width == width && state.checked_height == height) {
    return true;
  }
  const MatchSettings next = state.properties.committed();
  const Status status = activate(state, next);
  if (status) {
    state.engine.use(next);
  } else if (state.properties.started() &&
             activate(state, MatchSettings(state.engine.settings()))) {
    restore(state, next, status);
  } else {
    refuse_start(state, next, status);
    return false;
  }
  state.checked_width = width;
  state.checked_height = height;
  return true;
}

}  // namespace mtstereo::plugin
