// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/valid_columns_meta.hpp"

#include <cstdint>
#include <cstring>

#include "shared/pixel_meta.hpp"

namespace mtstereo::plugin {
namespace {

/// A row in the GBytes.
struct PackedRow {
  std::int32_t begin;
  std::int32_t end;
};

GBytes* columns_in(GstCustomMeta& meta) {
  const GValue* value =
      gst_structure_get_value(gst_custom_meta_get_structure(&meta), kColumnsField);
  return value != nullptr && G_VALUE_HOLDS(value, G_TYPE_BYTES)
             ? static_cast<GBytes*>(g_value_get_boxed(value))
             : nullptr;
}

/// GStreamer calls it; it calls C functions only, so that it throws nothing.
gboolean transform_columns(GstBuffer* to, GstCustomMeta* meta, GstBuffer*, GQuark type,
                           gpointer data, gpointer) noexcept {
  GBytes* columns = columns_in(*meta);
  if (columns == nullptr || !keeps_pixels(type, data)) return FALSE;
  set_valid_columns(to, columns);  // shared, not copied
  return TRUE;
}

}  // namespace

bool register_valid_columns_meta() {
  // Once per process, by the first caller.
  static const bool registered = register_pixel_meta(kValidColumnsMeta, transform_columns);
  return registered;
}

GBytes* pack_valid_columns(const std::vector<ValidColumns>& columns) {
  std::vector<PackedRow> rows;
  rows.reserve(columns.size());
  for (const ValidColumns& row : columns) rows.push_back({row.begin, row.end});
  return g_bytes_new(rows.data(), rows.size() * sizeof(PackedRow));
}

void set_valid_columns(GstBuffer* frame, GBytes* columns) {
  GstCustomMeta* meta = gst_buffer_get_custom_meta(frame, kValidColumnsMeta);
  if (meta == nullptr) {
    meta = gst_buffer_add_custom_meta(frame, kValidColumnsMeta);
    // A pool removes the other metas from a buffer that returns to it.
    if (frame->pool != nullptr) {
      auto* flags = &reinterpret_cast<GstMeta*>(meta)->flags;
      *flags = static_cast<GstMetaFlags>(*flags | GST_META_FLAG_POOLED);
    }
  } else if (columns_in(*meta) == columns) {
    return;
  }
  gst_structure_set(gst_custom_meta_get_structure(meta), kColumnsField, G_TYPE_BYTES, columns,
                    nullptr);
}

void remove_valid_columns(GstBuffer* frame) {
  GstCustomMeta* meta = gst_buffer_get_custom_meta(frame, kValidColumnsMeta);
  if (meta != nullptr) gst_buffer_remove_meta(frame, reinterpret_cast<GstMeta*>(meta));
}

GBytes* valid_columns_of(GstBuffer* frame) {
  GstCustomMeta* meta = gst_buffer_get_custom_meta(frame, kValidColumnsMeta);
  return meta != nullptr ? columns_in(*meta) : nullptr;
}

std::vector<ValidColumns> unpack_valid_columns(GBytes* columns, int width, int height) {
  gsize size = 0;
  const auto* bytes = static_cast<const std::uint8_t*>(g_bytes_get_data(columns, &size));
  if (height < 1 || size != static_cast<gsize>(height) * sizeof(PackedRow)) return {};
  std::vector<ValidColumns> result;
  result.reserve(static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    PackedRow row{};
    std::memcpy(&row, bytes + static_cast<std::size_t>(y) * sizeof row, sizeof row);
    if (row.begin < 0 || row.end < row.begin || row.end > width) return {};
    result.push_back({row.begin, row.end});
  }
  return result;
}

}  // namespace mtstereo::plugin
