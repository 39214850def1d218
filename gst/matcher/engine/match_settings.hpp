// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <glib.h>

#include <string>

#include "matcher/engine/alignment.hpp"
#include "mtstereo/parameters.hpp"
#include "shared/disparity_meta.hpp"

namespace mtstereo::plugin {

/// The properties that decide the disparity map of a pair. Each pair is matched with one copy.
struct MatchSettings {
  Parameters parameters;
  AlignmentSettings alignment;
  int disparity_scale = 256;   ///< [steps per px]
  bool scale_is_set = false;   ///< otherwise it follows the search range, see fit_scale()
  bool confidence_map = true;  ///< attach a confidence map to every disparity map
  std::string problem;         ///< why a value was refused, the error of the next start; "" if none
  guint problem_property = 0;  ///< the id of the property of `problem`
  guint64 revision = 0;        ///< incremented by every change

  /// Chooses the disparity scale if none was set: 256, or the largest smaller power of two with
  /// which the search range fits into 16 bits. To be called after every change of a parameter.
  void fit_scale();
  /// The unit of the disparity maps.
  DisparityUnit unit() const;
  /// True if the scale is not set and is not the usual one.
  bool has_other_scale() const;
  /// All settings that must fit each other: " preset=default mode=dense ...".
  std::string text() const;
};

}  // namespace mtstereo::plugin
