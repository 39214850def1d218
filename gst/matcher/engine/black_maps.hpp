// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include "mtstereo/image.hpp"

namespace mtstereo::plugin {

/// Collects the densities of maps, to find those that are nearly black although no inspection of
/// the views finds the reason.
class BlackMaps {
 public:
  static constexpr int kPairs = 60;  ///< successive pairs

  /// The density of the next map. `explained`: a problem of the views is known. Returns the mean of
  /// the last kPairs maps, after every kPairs without an explanation, until the report.
  std::optional<double> mean(double density, bool explained);
  /// A warning was posted.
  void report() { reported_ = true; }

 private:
  int pairs_ = 0;
  double sum_ = 0;
  bool reported_ = false;
};

/// The warning of maps with this mean density: what was found, and possible causes; "" if they are
/// as maps should be. The views are those of the last map. `sparse`: the mode keeps few pixels.
std::string black_maps_text(double density, bool sparse, GrayView left, GrayView right);

}  // namespace mtstereo::plugin
