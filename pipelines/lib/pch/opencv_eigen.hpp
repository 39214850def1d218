// SPDX-License-Identifier: LGPL-2.1-or-later
// Precompiled for mtstereo-render.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core.hpp>
