// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/settings.hpp"

#include <vector>

#include "matcher/negotiation.hpp"
#include "shared/caps.hpp"
#include "shared/ownership.hpp"

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {
namespace {

constexpr int kDefaultScale = 256;  // [steps per px]

std::string scale_text(const Settings& settings) {
  return " disparity-scale=" + std::to_string(settings.disparity_scale);
}

/// All settings that must fit each other: " preset=default mode=dense ...".
std::string settings_text(const Settings& settings) {
  std::string text;
  for (const ParameterInfo& info : parameter_table()) {
    text += std::string(" ") + info.name + "=" + settings.parameters.text(info.id);
  }
  return text + scale_text(settings);
}

void refuse_start(ElementState& state, const Settings& settings, const Status& status) {
  post_error(state, GST_LIBRARY_ERROR, GST_LIBRARY_ERROR_SETTINGS, status.error().message,
             state.streams_text() + "; settings:" + settings_text(settings));
}

/// Downstream may require a scale or a range, as a capsfilter does. It is only asked if the caps
/// would change while maps flow.
Status check_downstream(const ElementState& state, const Settings& settings) {
  if (!gst_pad_has_current_caps(state.source_pad())) return {};
  if (unit_of(settings) == unit_of(state.active)) return {};
  const CapsPointer offered = output_caps(state, settings);
  const CapsPointer accepted(gst_pad_peer_query_caps(state.source_pad(), nullptr));
  if (!accepted || gst_caps_can_intersect(offered.get(), accepted.get())) return {};
  return Error{ErrorCode::kInvalidCombination,
               "downstream does not accept a disparity map with max-disparity = " +
                   settings.parameters.text(Parameter::kMaxDisparity) +
                   ", min-disparity = " + settings.parameters.text(Parameter::kMinDisparity) +
                   " and disparity-scale = " + std::to_string(settings.disparity_scale) +
                   ": it accepts " + caps_text(accepted.get())};
}

/// Checks that the settings fit each other and the streams.
Status check(const ElementState& state, const Settings& settings) {
  if (!settings.problem.empty()) return Error{ErrorCode::kInvalidParameter, settings.problem};
  if (Status status = settings.parameters.check_scale16(settings.disparity_scale); !status) {
    return status;
  }
  const Input& left = state.input(Side::kLeft);
  if (!left.has_caps) return {};
  Status status = settings.parameters.check_frame(left.info.width, left.info.height);
  return status ? check_downstream(state, settings) : status;
}

/// Creates the matcher, or sets its parameters.
Status fit_matcher(ElementState& state, const Settings& settings) {
  if (state.matcher && state.matcher_revision == settings.revision) return {};
  if (state.matcher) {
    Status status = state.matcher->set_parameters(settings.parameters);
    if (!status) return status;
  } else {
    Result<Matcher> made = Matcher::create(settings.parameters);
    if (!made) return made.error();
    state.matcher.emplace(std::move(made.value()));
  }
  state.matcher_revision = settings.revision;
  return {};
}

Status activate(ElementState& state, const Settings& settings) {
  Status status = check(state, settings);
  if (status) status = fit_matcher(state, settings);
  return status;
}

/// The names and values of what differs: " max-disparity=300 ...".
struct Differences {
  std::vector<const char*> names;
  std::string refused;
  std::string kept;
};

Differences differences(const Settings& refused, const Settings& kept) {
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
    found.refused += scale_text(refused);
    found.kept += scale_text(kept);
  }
  return found;
}

/// Returns the properties that must fit each other to their last values, unless they were changed
/// again in the meantime: the next pair judges those values then. The other properties keep theirs.
void restore(ElementState& state, const Settings& refused, const Status& status) {
  {
    const ObjectLock lock(state.element);
    if (state.settings.revision != refused.revision) return;
    state.settings.parameters = state.active.parameters;
    state.settings.disparity_scale = state.active.disparity_scale;
    state.settings.scale_is_set = state.active.scale_is_set;
    state.complete = state.active = state.settings;
    state.matcher_revision = state.settings.revision;  // the matcher has these parameters
  }
  const Differences changes = differences(refused, state.active);
  for (const char* name : changes.names) g_object_notify(G_OBJECT(state.element), name);
  post_settings_warning(
      state,
      "The new settings are not used, and the properties have their last values "
      "again: " +
          status.error().message + ".",
      "refused:" + changes.refused + "; in use:" + changes.kept + "; " + state.streams_text());
}

/// Logs settings that are in effect from now on.
void log_settings(ElementState& state) {
  const Settings& now = state.active;
  if (state.logged_revision == now.revision) return;
  state.logged_revision = now.revision;
  GST_DEBUG_OBJECT(state.element, "settings in effect:%s", settings_text(now).c_str());
  if (now.disparity_scale == kDefaultScale || now.scale_is_set) return;
  GST_INFO_OBJECT(state.element, "disparity-scale=%d, with which max-disparity=%s fits in 16 bits",
                  now.disparity_scale, now.parameters.text(Parameter::kMaxDisparity).c_str());
}

}  // namespace

DisparityUnit unit_of(const Settings& settings) {
  return {.scale = settings.disparity_scale,
          .max_disparity = settings.parameters.integer(Parameter::kMaxDisparity),
          .min_disparity = settings.parameters.integer(Parameter::kMinDisparity),
          .offset = settings.parameters.disparity_offset()};
}

void fit_scale(Settings& settings) {
  if (settings.scale_is_set) return;
  int scale = kDefaultScale;
  while (scale > 1 && !settings.parameters.check_scale16(scale)) scale /= 2;
  // A range that fits at no scale is refused with the default.
  settings.disparity_scale = settings.parameters.check_scale16(scale) ? scale : kDefaultScale;
}

bool apply_settings(ElementState& state) {
  const Input& left = state.input(Side::kLeft);
  const int width = left.has_caps ? left.info.width : 0;
  const int height = left.has_caps ? left.info.height : 0;
  Settings next;
  bool started = false;
  {
    const ObjectLock lock(state.element);
    const bool changed = state.matcher_revision != state.complete.revision;
    if (state.matcher && !changed && state.checked_width == width &&
        state.checked_height == height) {
      return true;
    }
    next = state.complete;
    started = state.started;
  }
  const Status status = activate(state, next);
  if (status) {
    state.active = next;
    log_settings(state);
  } else if (started && activate(state, state.active)) {
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
