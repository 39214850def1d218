// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cameras/split_layout.hpp"

#include <algorithm>

#include "mtstereo/parameters.hpp"
#include "shared/frame_views.hpp"

namespace mtstereo::plugin {
namespace {

/// The side of a whole frame that is twice as long as in a half.
const char* split_field(SplitLayout layout) {
  return layout == SplitLayout::kSideBySide ? "width" : "height";
}

bool is_splittable(const GstVideoFormatInfo& info) {
  const GstVideoFormat format = GST_VIDEO_FORMAT_INFO_FORMAT(&info);
  if (format == GST_VIDEO_FORMAT_UNKNOWN || format == GST_VIDEO_FORMAT_ENCODED) return false;
  return !GST_VIDEO_FORMAT_INFO_IS_TILED(&info) && !GST_VIDEO_FORMAT_INFO_IS_COMPLEX(&info) &&
         !GST_VIDEO_FORMAT_INFO_HAS_PALETTE(&info);
}

/// Pixels that share a sample of color, along the split side.
int pixels_per_sample(const GstVideoFormatInfo& info, SplitLayout layout) {
  unsigned shift = 0;
  for (guint i = 0; i < GST_VIDEO_FORMAT_INFO_N_COMPONENTS(&info); ++i) {
    shift =
        std::max(shift, layout == SplitLayout::kSideBySide ? GST_VIDEO_FORMAT_INFO_W_SUB(&info, i)
                                                           : GST_VIDEO_FORMAT_INFO_H_SUB(&info, i));
  }
  return 1 << shift;
}

using Lengths = void (*)(GValue* result, const GValue* from);

void set_range(GValue* result, int least, int most, int step) {
  if (least > most) return;  // stays unset: no size is possible
  if (least == most) {
    g_value_init(result, G_TYPE_INT);
    g_value_set_int(result, least);
    return;
  }
  g_value_init(result, GST_TYPE_INT_RANGE);
  gst_value_set_int_range_step(result, least, most, step);
}

/// Applies `single` to the integers and ranges of a value, which may be a list of them. The result
/// is unset if none remains.
void map_lengths(GValue* result, const GValue* from, Lengths single) {
  if (!GST_VALUE_HOLDS_LIST(from)) return single(result, from);
  GValue list = G_VALUE_INIT;
  g_value_init(&list, GST_TYPE_LIST);
  for (guint i = 0; i < gst_value_list_get_size(from); ++i) {
    GValue item = G_VALUE_INIT;
    single(&item, gst_value_list_get_value(from, i));
    if (G_IS_VALUE(&item)) gst_value_list_append_and_take_value(&list, &item);
  }
  if (gst_value_list_get_size(&list) > 0) {
    *result = list;
  } else {
    g_value_unset(&list);
  }
}

void halve(GValue* result, const GValue* from) {
  if (G_VALUE_HOLDS_INT(from)) {
    const int length = g_value_get_int(from);
    if (length % 2 == 0) set_range(result, length / 2, length / 2, 1);
  } else if (GST_VALUE_HOLDS_INT_RANGE(from)) {
    const int least = gst_value_get_int_range_min(from);
    const int most = gst_value_get_int_range_max(from);
    set_range(result, std::max(least / 2 + least % 2, 1), std::min(most / 2, kLargestImageSide), 1);
  }
}

void double_up(GValue* result, const GValue* from) {
  constexpr int kMost = 2 * kLargestImageSide;
  if (G_VALUE_HOLDS_INT(from)) {
    const int length = g_value_get_int(from);
    if (length <= kLargestImageSide) set_range(result, 2 * length, 2 * length, 1);
  } else if (GST_VALUE_HOLDS_INT_RANGE(from)) {
    const int least = std::min(gst_value_get_int_range_min(from), kLargestImageSide);
    const int most = std::min(gst_value_get_int_range_max(from), kLargestImageSide);
    set_range(result, std::max(2 * least, 2), std::min(2 * most, kMost), 2);
  }
}

/// Twice the length, or one more.
void allow_odd(GValue* result, const GValue* from) {
  if (!GST_VALUE_HOLDS_INT_RANGE(from)) return;
  const int least = std::min(gst_value_get_int_range_min(from), kLargestImageSide);
  const int most = std::min(gst_value_get_int_range_max(from), kLargestImageSide);
  set_range(result, std::max(2 * least - 1, 1), 2 * most, 1);
}

CapsPointer with_lengths(const GstCaps* caps, SplitLayout layout, Lengths change) {
  CapsPointer result(gst_caps_new_empty());
  if (gst_caps_is_any(caps)) return CapsPointer(gst_caps_new_any());
  for (guint i = 0; i < gst_caps_get_size(caps); ++i) {
    GstStructure* fields = gst_structure_copy(gst_caps_get_structure(caps, i));
    // They describe the whole frame.
    gst_structure_remove_fields(fields, "multiview-mode", "multiview-flags", nullptr);
    const GValue* from = gst_structure_get_value(fields, split_field(layout));
    if (from != nullptr) {
      GValue to = G_VALUE_INIT;
      map_lengths(&to, from, change);
      if (!G_IS_VALUE(&to)) {
        gst_structure_free(fields);
        continue;
      }
      gst_structure_take_value(fields, split_field(layout), &to);
    }
    const GstCapsFeatures* features = gst_caps_get_features(caps, i);
    gst_caps_append_structure_full(
        result.get(), fields, features != nullptr ? gst_caps_features_copy(features) : nullptr);
  }
  return result;
}

}  // namespace

std::string split_formats() {
  std::string list = "{ GRAY8";
  guint count = 0;
  const GstVideoFormat* formats = gst_video_formats_raw(&count);
  // The matcher reads formats with a plane of luma in place: they are preferred.
  for (const bool luma : {true, false}) {
    for (guint i = 0; i < count; ++i) {
      if (formats[i] == GST_VIDEO_FORMAT_GRAY8 || has_luma_plane(formats[i]) != luma) continue;
      if (!is_splittable(*gst_video_format_get_info(formats[i]))) continue;
      list += ", ";
      list += gst_video_format_to_string(formats[i]);
    }
  }
  return list + " }";
}

std::string split_problem(const GstVideoInfo& whole, SplitLayout layout) {
  const bool columns = layout == SplitLayout::kSideBySide;
  const int length = columns ? whole.width : whole.height;
  const std::string text =
      "Frames of " + std::to_string(whole.width) + "x" + std::to_string(whole.height) + " px ";
  if (length < 2 || length % 2 != 0) {
    return text + "have no two equal halves: their " + split_field(layout) +
           " must be even. If the views are not exactly half of the frame, put videocrop upstream.";
  }
  const int shared = pixels_per_sample(*whole.finfo, layout);
  if (length / 2 % shared == 0) return {};
  return text + "cannot be split in the middle: in the format " + GST_VIDEO_INFO_NAME(&whole) +
         " " + std::to_string(shared) + (columns ? " columns" : " rows") +
         " share a color, and a half has " + std::to_string(length / 2) +
         ". Put videoconvert and a capsfilter with format=GRAY8 upstream, or convert the file "
         "(ffmpeg -i FILE -pix_fmt gray -c:v ffv1 views.mkv).";
}

std::string layout_contradiction(const GstVideoInfo& whole, SplitLayout layout, bool swap) {
  const GstVideoMultiviewMode mode = GST_VIDEO_INFO_MULTIVIEW_MODE(&whole);
  if (mode < GST_VIDEO_MULTIVIEW_MODE_SIDE_BY_SIDE) return {};  // none, mono or a single view
  const std::string stated = std::string("The stream states multiview-mode=") +
                             gst_video_multiview_mode_to_caps_string(mode);
  const bool beside = mode == GST_VIDEO_MULTIVIEW_MODE_SIDE_BY_SIDE;
  if (!beside && mode != GST_VIDEO_MULTIVIEW_MODE_TOP_BOTTOM) {
    return stated + ", but mtsplit separates only views side by side or above each other.";
  }
  if (beside != (layout == SplitLayout::kSideBySide)) {
    return stated + ": set layout=" + (beside ? "side-by-side" : "top-bottom") + " on mtsplit.";
  }
  const int flags = GST_VIDEO_INFO_MULTIVIEW_FLAGS(&whole);
  if ((flags & GST_VIDEO_MULTIVIEW_FLAGS_RIGHT_VIEW_FIRST) == 0 || swap) return {};
  return stated + " with the right view first: set swap=true on mtsplit.";
}

CapsPointer half_caps(const GstCaps* caps, SplitLayout layout) {
  return with_lengths(caps, layout, halve);
}

CapsPointer whole_caps(const GstCaps* half, SplitLayout layout) {
  CapsPointer even = with_lengths(half, layout, double_up);
  if (gst_caps_is_any(even.get())) return even;
  // A frame that cannot be split is accepted last: the error that it causes says why. A source
  // without common caps would only report "not negotiated".
  CapsPointer odd = with_lengths(half, layout, allow_odd);
  gst_caps_append(even.get(), odd.release());
  return even;
}

HalfPosition second_half(const GstVideoInfo& whole, SplitLayout layout) {
  return layout == SplitLayout::kSideBySide ? HalfPosition{whole.width / 2, 0}
                                            : HalfPosition{0, whole.height / 2};
}

}  // namespace mtstereo::plugin
