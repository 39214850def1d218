// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/view_borders.hpp"

#include <algorithm>

#include "shared/valid_columns_meta.hpp"

namespace mtstereo::plugin {
namespace {

bool has_border(const std::vector<ValidColumns>& columns, int width) {
  return std::any_of(columns.begin(), columns.end(),
                     [width](const ValidColumns& row) { return row.begin > 0 || row.end < width; });
}

}  // namespace

void Borders::View::take(GstBuffer* frame, const BorderedView& view) {
  GBytes* const bytes = valid_columns_of(frame);
  if (bytes == source.get() && view == taken_for) return;
  columns.clear();
  source.reset(bytes != nullptr ? g_bytes_ref(bytes) : nullptr);
  taken_for = view;
  if (bytes == nullptr) return;
  const std::vector<ValidColumns> all = unpack_valid_columns(bytes, view.width, view.height);
  if (has_border(all, view.width)) columns = without_margin(all, view.width, view.margin);
}

void Borders::take(GstBuffer* left, GstBuffer* right, const BorderedView& view) {
  views_[0].take(left, view);
  views_[1].take(right, view);
}

}  // namespace mtstereo::plugin
