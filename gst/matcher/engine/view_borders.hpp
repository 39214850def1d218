// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <array>
#include <memory>
#include <vector>

#include "matcher/engine/border.hpp"

namespace mtstereo::plugin {

/// The size of the views and the margin of their borders [px].
struct BorderedView {
  int width = 0;
  int height = 0;
  int margin = 0;
  friend bool operator==(const BorderedView&, const BorderedView&) = default;
};

/// The borders of both views of a stream, as mtrectify attaches them to the frames.
class Borders {
 public:
  /// Takes the borders of the frames of a pair. Costs nothing if they have not changed.
  void take(GstBuffer* left, GstBuffer* right, const BorderedView& view);
  /// True if a view has a border.
  bool any() const { return !views_[0].columns.empty() || !views_[1].columns.empty(); }
  /// Removes the disparities of the border from a map of the pair; see remove_border().
  long remove(ImageView<std::uint16_t> map, const DisparityUnit& unit) const {
    return remove_border(map, views_[0].columns, views_[1].columns, unit);
  }

 private:
  struct BytesDeleter {
    void operator()(GBytes* bytes) const { g_bytes_unref(bytes); }
  };
  struct View {
    std::unique_ptr<GBytes, BytesDeleter> source;  ///< what the columns were made from
    BorderedView taken_for;
    std::vector<ValidColumns> columns;  ///< without the margin; empty: no border

    void take(GstBuffer* frame, const BorderedView& view);
  };
  std::array<View, 2> views_;
};

}  // namespace mtstereo::plugin
