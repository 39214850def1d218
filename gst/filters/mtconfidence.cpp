// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/mtconfidence.hpp"

#include <string>

#include "filters/disparity_filter.hpp"
#include "shared/authors.hpp"
#include "shared/caps.hpp"
#include "shared/caps_check.hpp"
#include "shared/confidence_meta.hpp"
#include "shared/confidence_pool.hpp"
#include "shared/disparity_meta.hpp"
#include "shared/element_object.hpp"
#include "shared/exception_guard.hpp"
#include "shared/frame_metas.hpp"
#include "shared/frame_views.hpp"
#include "shared/properties.hpp"

namespace mtstereo::plugin {

GST_DEBUG_CATEGORY_STATIC(mtconfidence_debug);
#define GST_CAT_DEFAULT mtconfidence_debug

namespace {

enum class Content { kDisparity, kConfidence };

struct ConfidenceSettings {
  int min_confidence = 0;
  Content output = Content::kDisparity;
};

/// All data of one mtconfidence element. Created in its init, deleted in its finalize.
struct ConfidenceState {
  // Guarded by the element's object lock.
  ConfidenceSettings settings;

  // Used by the streaming thread, and by stop() while that thread does not run.
  ConfidencePool pool;
};

using GstMtConfidence = Instance<GstVideoFilter, ConfidenceState>;
using GstMtConfidenceClass = GstVideoFilterClass;

constexpr const char* kImages = MTSTEREO_IMAGE_CAPS("GRAY8");
constexpr const char* kOutputs = MTSTEREO_IMAGE_CAPS("{ GRAY16_LE, GRAY8 }");

const PropertyTable<ConfidenceSettings>& properties() {
  static const GType contents = enum_type<Content>(
      "GstMtStereoConfidenceOutput",
      {{Content::kDisparity, "Disparities of sufficient confidence (GRAY16_LE)", "disparity"},
       {Content::kConfidence, "The confidence as an image (GRAY8)", "confidence"}});
  static const PropertyTable<ConfidenceSettings> table({
      {"min-confidence", &ConfidenceSettings::min_confidence, 0, 255,
       "Set disparities of lower confidence to 0 (unknown), and their confidence too (0: keep "
       "all, 255: keep only those of highest confidence)"},
      {"output", &ConfidenceSettings::output, contents, "Content of the output frames"},
  });
  return table;
}

}  // namespace

G_DEFINE_TYPE(GstMtConfidence, gst_mtstereo_confidence, GST_TYPE_VIDEO_FILTER)

namespace {

ConfidenceState& state_of(gpointer element) {
  return *reinterpret_cast<GstMtConfidence*>(element)->state;
}

ConfidenceSettings settings_of(gpointer element) {
  const ObjectLock lock(element);
  return state_of(element).settings;
}

/// The caps of the two outputs differ.
bool changes_caps(const ConfidenceSettings& before, const ConfidenceSettings& now) {
  return before.output != now.output;
}

GstCaps* transform_caps(GstBaseTransform* transform, GstPadDirection direction, GstCaps* caps,
                        GstCaps* filter) {
  const Content output = settings_of(transform).output;
  const bool to_src = direction == GST_PAD_SINK;
  const char* source = output == Content::kConfidence ? kImages : kDisparityCaps;
  const CapsPointer possible(gst_caps_from_string(to_src ? kDisparityCaps : source));
  CapsPointer mine(gst_caps_intersect_full(caps, possible.get(), GST_CAPS_INTERSECT_FIRST));
  if (output == Content::kConfidence)
    mine = image_caps(mine.get(), to_src ? kImages : kDisparityCaps);
  return filtered_caps(std::move(mine), filter).release();
}

/// Size and position of every pixel are kept, so the metas of the frame stay valid.
gboolean transform_meta(GstBaseTransform*, GstBuffer*, GstMeta* meta, GstBuffer*) {
  return !belongs_to_pixels(*meta->info);
}

// --- frames ---

/// The lowest confidence of a pixel that is kept.
struct Threshold {
  std::uint8_t least = 0;
  /// `value`, or 0 if it is lower.
  std::uint8_t confidence(std::uint8_t value) const {
    return value >= least ? value : std::uint8_t{0};
  }
};

void filter_confidence(const GstVideoFrame& from, GstVideoFrame& to, Threshold threshold) {
  for (int y = 0; y < GST_VIDEO_FRAME_HEIGHT(&from); ++y) {
    const std::uint8_t* in = plane_row(from, y);
    std::uint8_t* out = plane_row(to, y);
    for (int x = 0; x < GST_VIDEO_FRAME_WIDTH(&from); ++x) out[x] = threshold.confidence(in[x]);
  }
}

void filter_disparity(const GstVideoFrame& from, const GstVideoFrame& confidence, GstVideoFrame& to,
                      Threshold threshold) {
  for (int y = 0; y < GST_VIDEO_FRAME_HEIGHT(&from); ++y) {
    const std::uint8_t* in = plane_row(from, y);
    const std::uint8_t* certainty = plane_row(confidence, y);
    std::uint8_t* out = plane_row(to, y);
    for (int x = 0; x < GST_VIDEO_FRAME_WIDTH(&from); ++x) {
      const bool keep = certainty[x] >= threshold.least;
      out[2 * x] = keep ? in[2 * x] : std::uint8_t{0};
      out[2 * x + 1] = keep ? in[2 * x + 1] : std::uint8_t{0};
    }
  }
}

GstFlowReturn refuse_confidence(GstVideoFilter* filter, const std::string& problem) {
  GST_ELEMENT_ERROR(filter, STREAM, WRONG_TYPE,
                    ("The confidence map of a disparity map is invalid: %s. The fault is in an "
                     "element between mtstereo and mtconfidence, or in the application that "
                     "attached the map.",
                     problem.c_str()),
                    ("meta %s", kConfidenceMeta));
  return GST_FLOW_ERROR;
}

GstFlowReturn refuse_missing(GstVideoFilter* filter) {
  GST_ELEMENT_ERROR(
      filter, STREAM, WRONG_TYPE,
      ("A disparity map has no confidence map. Put an mtstereo with confidence-map=true upstream, "
       "and nothing between it and mtconfidence that changes the maps into other frames, such as "
       "videoscale, an encoder, a file or a network."),
      ("no sample \"%s\" in a meta %s", kConfidenceField, kConfidenceMeta));
  return GST_FLOW_ERROR;
}

/// The filtered confidence in a new buffer; NULL if there is no memory for it.
BufferPointer filtered_map(ConfidencePool& pool, const GstVideoInfo& disparity,
                           const GstVideoFrame& confidence, Threshold threshold) {
  if (!pool.fit(disparity)) return nullptr;
  BufferPointer map = pool.acquire();
  if (!map) return nullptr;
  MappedFrame frame(pool.info(), map.get(), GST_MAP_WRITE);
  if (!frame.mapped()) return nullptr;
  filter_confidence(confidence, *frame.frame(), threshold);
  return map;
}

GstFlowReturn attach_filtered(GstVideoFilter* filter, const GstVideoFrame& confidence,
                              Threshold threshold, GstBuffer* out) {
  ConfidencePool& pool = state_of(filter).pool;
  BufferPointer map = filtered_map(pool, filter->in_info, confidence, threshold);
  if (!map) {
    GST_ELEMENT_ERROR(filter, RESOURCE, NO_SPACE_LEFT,
                      ("There is not enough memory for a confidence map of %dx%d px.",
                       filter->in_info.width, filter->in_info.height),
                      (nullptr));
    return GST_FLOW_ERROR;
  }
  const SamplePointer sample = pool.finish(std::move(map), out);
  set_confidence(out, sample.get());
  return GST_FLOW_OK;
}

GstFlowReturn transform_frame(GstVideoFilter* filter, GstVideoFrame* in, GstVideoFrame* out) {
  const Threshold threshold{static_cast<std::uint8_t>(settings_of(filter).min_confidence)};
  GstSample* sample = confidence_of(in->buffer);
  if (sample == nullptr) return refuse_missing(filter);
  GstVideoInfo info;
  const std::string problem = confidence_problem(sample, filter->in_info, info);
  if (!problem.empty()) return refuse_confidence(filter, problem);
  MappedFrame confidence(info, gst_sample_get_buffer(sample), GST_MAP_READ);
  if (!confidence.mapped()) return refuse_confidence(filter, confidence.problem());

  // The negotiated format decides: the property may have changed since then.
  if (GST_VIDEO_FRAME_FORMAT(out) == GST_VIDEO_FORMAT_GRAY8) {
    filter_confidence(*confidence.frame(), *out, threshold);
    return GST_FLOW_OK;
  }
  filter_disparity(*in, *confidence.frame(), *out, threshold);
  if (const auto unit = disparity_unit_of(in->buffer)) set_disparity_unit(out->buffer, *unit);
  if (threshold.least > 0) {
    return attach_filtered(filter, *confidence.frame(), threshold, out->buffer);
  }
  set_confidence(out->buffer, sample);
  return GST_FLOW_OK;
}

// --- life ---

gboolean stop(GstBaseTransform* transform) {
  state_of(transform).pool.clear();
  return TRUE;
}

}  // namespace

static void gst_mtstereo_confidence_class_init(GstMtConfidenceClass* klass) {
  GST_DEBUG_CATEGORY_INIT(mtconfidence_debug, "mtconfidence", 0, "confidence of disparity maps");
  ElementObject<GstMtConfidence, properties, &ConfidenceState::settings, changes_caps>::install(
      G_OBJECT_CLASS(klass));

  auto* element_class = GST_ELEMENT_CLASS(klass);
  add_pad_template(element_class, "sink", GST_PAD_SINK, kDisparityCaps);
  add_pad_template(element_class, "src", GST_PAD_SRC, kOutputs);
  gst_element_class_set_static_metadata(
      element_class, "Disparity confidence filter", "Filter/Video",
      "Removes disparities of low confidence from the maps of mtstereo, or outputs the confidence",
      kAuthors);

  auto* transform_class = GST_BASE_TRANSFORM_CLASS(klass);
  check_sink_caps<FrameKind::kMap>(transform_class);
  transform_class->stop = guarded<stop, FALSE>;
  transform_class->transform_caps = guarded<transform_caps>;
  transform_class->transform_meta = guarded<transform_meta, FALSE>;
  transform_class->transform = guarded<transform_checked, GST_FLOW_ERROR>;
  GST_VIDEO_FILTER_CLASS(klass)->transform_frame = guarded<transform_frame, GST_FLOW_ERROR>;
}

static void gst_mtstereo_confidence_init(GstMtConfidence* self) {
  self->state = new_state<ConfidenceState>();
}

}  // namespace mtstereo::plugin
