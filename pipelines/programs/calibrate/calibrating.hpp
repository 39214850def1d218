// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "programs/calibrate/held_out.hpp"
#include "programs/calibrate/solving.hpp"

// From views to a calibration and its figures.

namespace mtstereo::calibrate {

/// A model that was tried on the held-out views.
struct ModelTrial {
  Model model;
  double distance = 0;  ///< that 90 % of the held-out corners are below [px]
  std::string failure;  ///< why the model does not fit; empty if it does
};

/// The calibration, made from all views, and how one without every fifth view fits those.
struct Calibrated {
  Model model = Model::kPlumbBob;
  std::vector<ModelTrial> trials;  ///< with an automatic choice of the model
  cv::Size left_size, right_size;  ///< of the left and the right camera [px]
  /// The first source is the right camera. Views, sizes and solution are in the right order.
  bool swapped = false;
  Solution solution;
  Rectification rectification;  ///< with the default options of rectify()
  bool wild = false;            ///< a lens model turns back within the image
  Fit fit;                      ///< of the views in use
  /// Figures of a calibration of four fifths of the views, on the others.
  struct HeldOut {
    Fit fit;
    double focal_length_change = 0;  ///< of the calibration of all views, relative
    double baseline_change = 0;      ///< the same
  };
  std::optional<HeldOut> held_out;  ///< not with fewer than kFewestForHoldOut views
};

/// Calibrates. `model`: std::nullopt chooses the one that fits the held-out views best. Throws
/// UserError.
Calibrated calibrate(std::optional<Model> model, cv::Size left, cv::Size right,
                     std::vector<BoardView> views);

}  // namespace mtstereo::calibrate
