// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <glib-object.h>

#include <mutex>
#include <optional>

#include "matcher/engine/match_settings.hpp"
#include "shared/properties.hpp"

namespace mtstereo::plugin {

/// The table of the properties that decide a disparity map.
const PropertyTable<MatchSettings>& match_properties();

/// The values of these properties. A pair is matched with the values of the last g_object_set(), or
/// group between g_object_freeze_notify() and g_object_thaw_notify(), that has ended: values of one
/// call belong together.
///
/// GObject has no transaction. A class learns of the end of a group only by its function
/// dispatch_properties_changed(), which GObject calls once after the last value of the group: that
/// of the element calls commit(). No other function of the element may depend on notifications.
///
/// Any thread.
class MatchProperties {
 public:
  /// Sets a property. A value that is not valid is refused: while the element runs, the failure is
  /// returned. Otherwise it is kept as the error of the start, since there may be no bus yet.
  Status set(guint id, const GValue& value);
  /// Reads a property. `known` is the row field that was found, if there is one.
  void get(guint id, const AlignmentReport& report, GValue& value) const;
  /// A group of values is complete.
  void commit();

  MatchSettings committed() const;
  guint64 committed_revision() const;
  /// The values that the properties return.
  MatchSettings current() const;

  /// Returns the values that must fit each other to the last ones, unless they were changed again
  /// since the refused ones. Returns the settings in effect then.
  std::optional<MatchSettings> restore(const MatchSettings& refused, const MatchSettings& last);

  /// The element runs: a value that is not valid is refused, and no longer a problem of the start.
  void set_started(bool started);
  bool started() const;

 private:
  mutable std::mutex mutex_;  // guards the members below
  MatchSettings current_;
  MatchSettings committed_;
  bool started_ = false;
};

}  // namespace mtstereo::plugin
