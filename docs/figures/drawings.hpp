// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/prepare/max_tree.hpp"

namespace mtstereo::figures {

/// A pre-processed image, its levels spread over 0 .. 255.
cv::Mat draw_levels(GrayView levels, int gray_levels);

/// The Max-tree of one row as bars: one a node, as wide as the node, the root at the top, each
/// child below its parent, darker the deeper. Leaves are red.
cv::Mat draw_tree(const MaxTrees& trees, int y, int bar_height);

/// The nodes of a level, each in a color of its own, over the dimmed image.
cv::Mat draw_nodes(const NodeLevel& level, const cv::Mat& gray);

/// Images side by side with a thin gap; gray ones become color.
cv::Mat side_by_side(const cv::Mat& left, const cv::Mat& right);

}  // namespace mtstereo::figures
