// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/settings.hpp"

/// Internal to the list of steps: with which settings a step runs.

namespace mtstereo {

inline bool always(const Settings&) { return true; }
inline bool if_aligned(const Settings& s) { return s.aligned(); }
inline bool if_blurred(const Settings& s) { return s.blurred(); }
inline bool if_noise_filter(const Settings& s) { return s.noise_filter; }
inline bool if_shifted(const Settings& s) { return s.shifted(); }
inline bool if_half(const Settings& s) { return s.half(); }
inline bool if_refined(const Settings& s) { return s.refined(); }
inline bool if_census(const Settings& s) { return s.census(); }
inline bool if_gradient(const Settings& s) { return !s.census(); }
inline bool if_paths(const Settings& s) { return s.by_paths(); }
/// Whether nodes guide the matching of pixels.
inline bool if_nodes(const Settings& s) { return !s.by_paths(); }
inline bool if_outliers(const Settings& s) { return if_nodes(s) && s.outlier_radius > 0; }
inline bool if_guided_census(const Settings& s) { return if_nodes(s) && s.census(); }
inline bool if_pixel_outliers(const Settings& s) {
  return if_outliers(s) && s.outlier_removal == OutlierRemoval::kNodesAndPixels;
}
inline bool if_speckles(const Settings& s) { return s.speckle_size > 1; }
inline bool if_islands(const Settings& s) {
  return if_speckles(s) && s.min_confidence > 0 && !s.keeps_only_ends() && !s.keeps_likely_only();
}
inline bool if_thin(const Settings& s) { return s.thin_objects; }
/// Where the thin objects come back: into the matched map, or into the complete one.
inline bool if_thin_restoring(const Settings& s) { return if_thin(s) && !s.by_paths(); }
inline bool if_thin_drawing(const Settings& s) { return if_thin(s) && s.by_paths(); }
/// Where gaps are filled: in the matched map, or in what the rejection leaves of the complete one.
inline bool if_gaps(const Settings& s) { return s.max_gap > 0 && !s.by_paths(); }
inline bool if_guard(const Settings& s) { return if_thin_restoring(s) && if_gaps(s); }
/// Other modes reject what is corrected there.
inline bool if_left_strip(const Settings& s) { return s.by_paths() && s.mode == Mode::kFull; }
inline bool if_rejection(const Settings& s) {
  return s.keeps_likely_only() && s.least_reliability() > 0;
}
inline bool if_closing(const Settings& s) { return if_rejection(s) && s.max_gap > 0; }
inline bool if_smoothing(const Settings& s) { return s.smoothing_radius > 0; }

}  // namespace mtstereo
