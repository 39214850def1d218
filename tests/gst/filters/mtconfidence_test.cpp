// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "support/stereo_harness.hpp"

namespace mtstereo::test::mtconfidence_test {
namespace {

constexpr const char* kMeta = "MtStereoConfidenceMeta";
constexpr int kWidth = 5;
constexpr int kHeight = 3;

using Disparity = std::vector<std::uint16_t>;
using Confidence = std::vector<std::uint8_t>;

const Disparity kMap = {0,   256, 512, 1,   65535, 770, 0,     771,  //
                        772, 773, 774, 775, 776,   777, 0x0100};
const Confidence kSure = {0, 1, 2, 99, 100, 101, 0, 200, 254, 255, 50, 60, 70, 80, 255};

/// A GRAY16_LE or GRAY8 frame of kWidth x kHeight; all bytes outside the image are 0xAB.
template <typename T>
GstBuffer* frame_of(const std::vector<T>& values, int padding, int offset) {
  constexpr int kStep = sizeof(T);
  const int stride = GST_ROUND_UP_4(kStep * kWidth) + padding;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(offset + stride * kHeight), 0xAB);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    std::uint8_t* to = bytes.data() + offset + i / kWidth * stride + i % kWidth * kStep;
    const unsigned value = values[static_cast<std::size_t>(i)];
    to[0] = static_cast<std::uint8_t>(value);
    if (kStep == 2) to[1] = static_cast<std::uint8_t>(value >> 8);
  }
  GstBuffer* buffer = gst_buffer_new_memdup(bytes.data(), bytes.size());
  if (padding != 0 || offset != 0) {
    gsize offsets[GST_VIDEO_MAX_PLANES] = {static_cast<gsize>(offset)};
    gint strides[GST_VIDEO_MAX_PLANES] = {stride};
    gst_buffer_add_video_meta_full(buffer, GST_VIDEO_FRAME_FLAG_NONE,
                                   kStep == 2 ? GST_VIDEO_FORMAT_GRAY16_LE : GST_VIDEO_FORMAT_GRAY8,
                                   kWidth, kHeight, 1, offsets, strides);
  }
  return buffer;
}

/// Attaches a confidence map as an application does. Takes `confidence`; no caps if `caps` is "".
void attach(GstBuffer* map, GstBuffer* confidence, const std::string& caps) {
  CapsPointer parsed(caps.empty() ? nullptr : gst_caps_from_string(caps.c_str()));
  GstSample* sample = gst_sample_new(confidence, parsed.get(), nullptr, nullptr);
  GstCustomMeta* meta = gst_buffer_add_custom_meta(map, kMeta);
  gst_structure_set(gst_custom_meta_get_structure(meta), "confidence", GST_TYPE_SAMPLE, sample,
                    nullptr);
  gst_sample_unref(sample);
  if (confidence != nullptr) gst_buffer_unref(confidence);
}

/// An mtconfidence in a harness.
class Filter {
 public:
  explicit Filter(const std::string& properties) {
    element_ = make_element(properties, "mtconfidence");
    bus_ = gst_bus_new();
    gst_element_set_bus(element_, bus_);
    harness_ = gst_harness_new_with_element(element_, "sink", "src");
    gst_harness_set_src_caps_str(
        harness_, (raw_caps("GRAY16_LE", kWidth, kHeight) + ",disparity-scale=256").c_str());
  }
  ~Filter() {
    gst_element_set_bus(element_, nullptr);
    gst_harness_teardown(harness_);
    gst_object_unref(element_);
    gst_object_unref(bus_);
  }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;

  GstElement* element() const { return element_; }

  /// A disparity map with the confidence kSure, each with its own padding and offset.
  static GstBuffer* map(int padding = 0, int offset = 0, int sure_padding = 0,
                        int sure_offset = 0) {
    GstBuffer* map = frame_of(kMap, padding, offset);
    attach(map, frame_of(kSure, sure_padding, sure_offset), raw_caps("GRAY8", kWidth, kHeight));
    return map;
  }
  BufferPointer pass(GstBuffer* map) {
    const GstFlowReturn flow = gst_harness_push(harness_, map);
    EXPECT_EQ(flow, GST_FLOW_OK);
    return BufferPointer(flow == GST_FLOW_OK ? gst_harness_pull(harness_) : nullptr);
  }
  /// The error for a map that is rejected.
  std::string refusal(GstBuffer* map) {
    EXPECT_EQ(gst_harness_push(harness_, map), GST_FLOW_ERROR);
    const MessagePointer message(gst_bus_pop_filtered(bus_, GST_MESSAGE_ERROR));
    if (!message) return "";
    GError* error = nullptr;
    gst_message_parse_error(message.get(), &error, nullptr);
    std::string text = error->message;
    g_error_free(error);
    return text;
  }
  std::string output_caps() const {
    GstPad* pad = gst_element_get_static_pad(element_, "src");
    const CapsPointer caps(gst_pad_get_current_caps(pad));
    gst_object_unref(pad);
    gchar* text = gst_caps_to_string(caps.get());
    std::string result = text;
    g_free(text);
    return result;
  }

 private:
  GstElement* element_ = nullptr;
  GstBus* bus_ = nullptr;
  GstHarness* harness_ = nullptr;
};

Disparity kept(int least) {
  Disparity result = kMap;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (kSure[i] < least) result[i] = 0;
  }
  return result;
}

Confidence kept_confidence(int least) {
  Confidence result = kSure;
  for (std::uint8_t& value : result) {
    if (value < least) value = 0;
  }
  return result;
}

Confidence bytes_of(GstBuffer* buffer) {
  Confidence result;
  GstVideoInfo info;
  gst_video_info_set_format(&info, GST_VIDEO_FORMAT_GRAY8, kWidth, kHeight);
  GstVideoFrame frame;
  if (buffer == nullptr || !gst_video_frame_map(&frame, &info, buffer, GST_MAP_READ)) {
    ADD_FAILURE() << "no image";
    return result;
  }
  for (int y = 0; y < kHeight; ++y) {
    const auto* row = static_cast<const guint8*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0)) +
                      static_cast<gssize>(y) * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0);
    result.insert(result.end(), row, row + kWidth);
  }
  gst_video_frame_unmap(&frame);
  return result;
}

class MinConfidence : public testing::TestWithParam<int> {};

// Feature: confidence for each pixel
TEST_P(MinConfidence, KeepsDisparitiesOfAtLeastThisConfidence) {
  Filter filter("min-confidence=" + std::to_string(GetParam()));
  const BufferPointer out = filter.pass(Filter::map());
  ASSERT_TRUE(out);
  EXPECT_EQ(map_of(out.get(), kWidth, kHeight), kept(GetParam()));
  EXPECT_EQ(confidence_of(out.get()), kept_confidence(GetParam()));
}

TEST_P(MinConfidence, AppliesToTheConfidenceOutput) {
  Filter filter("output=confidence min-confidence=" + std::to_string(GetParam()));
  const BufferPointer out = filter.pass(Filter::map());
  EXPECT_EQ(bytes_of(out.get()), kept_confidence(GetParam()));
  EXPECT_TRUE(confidence_of(out.get()).empty());
}

INSTANTIATE_TEST_SUITE_P(Values, MinConfidence, testing::Values(0, 1, 2, 100, 101, 254, 255),
                         [](const auto& info) { return std::to_string(info.param); });

TEST(MtConfidence, KeepsEverythingByDefault) {
  Filter filter("");
  EXPECT_EQ(map_of(filter.pass(Filter::map()).get(), kWidth, kHeight), kMap);
}

TEST(MtConfidence, ReadsRowsWithPaddingAndOffset) {
  for (const int padding : {0, 4, 9}) {
    for (const int offset : {0, 1, 7}) {
      Filter disparity("min-confidence=80");
      const BufferPointer out = disparity.pass(Filter::map(padding, offset, 13 - padding, offset));
      EXPECT_EQ(map_of(out.get(), kWidth, kHeight), kept(80)) << padding << " " << offset;
      EXPECT_EQ(confidence_of(out.get()), kept_confidence(80)) << padding << " " << offset;
      Filter image("output=confidence");
      EXPECT_EQ(bytes_of(image.pass(Filter::map(padding, offset, 3, offset)).get()), kSure);
    }
  }
}

TEST(MtConfidence, DoesNotModifyItsInput) {
  Filter filter("min-confidence=255");
  const BufferPointer in(Filter::map());
  const BufferPointer out = filter.pass(gst_buffer_ref(in.get()));
  EXPECT_EQ(map_of(in.get(), kWidth, kHeight), kMap);
  EXPECT_EQ(confidence_of(in.get()), kSure);
}

TEST(MtConfidence, DoesNotOverwriteMapsInUse) {
  Filter filter("");
  std::vector<BufferPointer> held;
  const std::vector<int> values = {50, 100, 200, 255, 1};
  for (const int value : values) {
    g_object_set(filter.element(), "min-confidence", value, nullptr);
    held.push_back(filter.pass(Filter::map()));
  }
  for (std::size_t i = 0; i < held.size(); ++i) {
    EXPECT_EQ(map_of(held[i].get(), kWidth, kHeight), kept(values[i])) << values[i];
    EXPECT_EQ(confidence_of(held[i].get()), kept_confidence(values[i])) << values[i];
  }
}

TEST(MtConfidence, OutputCanBeChangedWhilePlaying) {
  Filter filter("");
  EXPECT_EQ(map_of(filter.pass(Filter::map()).get(), kWidth, kHeight), kMap);
  EXPECT_NE(filter.output_caps().find("disparity-scale=(int)256"), std::string::npos);
  gst_util_set_object_arg(G_OBJECT(filter.element()), "output", "confidence");
  EXPECT_EQ(bytes_of(filter.pass(Filter::map()).get()), kSure);
  EXPECT_NE(filter.output_caps().find("GRAY8"), std::string::npos);
  EXPECT_EQ(filter.output_caps().find("disparity-scale"), std::string::npos);
  gst_util_set_object_arg(G_OBJECT(filter.element()), "output", "disparity");
  EXPECT_EQ(map_of(filter.pass(Filter::map()).get(), kWidth, kHeight), kMap);
  EXPECT_NE(filter.output_caps().find("disparity-scale=(int)256"), std::string::npos);
}

TEST(MtConfidence, KeepsOtherMetas) {
  Filter filter("min-confidence=10");
  const CapsPointer clock(gst_caps_from_string("timestamp/x-ntp"));
  GstBuffer* map = Filter::map();
  gst_buffer_add_reference_timestamp_meta(map, clock.get(), 42, GST_CLOCK_TIME_NONE);
  gst_buffer_add_video_region_of_interest_meta(map, "face", 1, 1, 2, 2);
  const BufferPointer out = filter.pass(map);
  ASSERT_TRUE(out);
  EXPECT_NE(gst_buffer_get_reference_timestamp_meta(out.get(), clock.get()), nullptr);
  EXPECT_NE(gst_buffer_get_video_region_of_interest_meta(out.get()), nullptr);
}

// --- rejected input ---

TEST(MtConfidence, ReportsAMapWithoutConfidence) {
  for (const char* properties : {"", "min-confidence=9", "output=confidence"}) {
    Filter filter(properties);
    const std::string text = filter.refusal(frame_of(kMap, 0, 0));
    EXPECT_NE(text.find("mtstereo with confidence-map=true"), std::string::npos) << text;
  }
}

TEST(MtConfidence, ReportsAMetaWithoutItsField) {
  for (const bool wrong_type : {false, true}) {
    Filter filter("");
    GstBuffer* map = frame_of(kMap, 0, 0);
    GstCustomMeta* meta = gst_buffer_add_custom_meta(map, kMeta);
    if (wrong_type) {
      gst_structure_set(gst_custom_meta_get_structure(meta), "confidence", G_TYPE_INT, 3, nullptr);
    }
    const std::string text = filter.refusal(map);
    EXPECT_NE(text.find("has no confidence map"), std::string::npos) << text;
  }
}

/// The error for the map kMap with this confidence.
std::string refused(GstBuffer* confidence, const std::string& caps) {
  Filter filter("min-confidence=1");
  GstBuffer* map = frame_of(kMap, 0, 0);
  attach(map, confidence, caps);
  return filter.refusal(map);
}

TEST(MtConfidence, ReportsBothSizesIfTheyDiffer) {
  const std::string text =
      refused(gst_buffer_new_allocate(nullptr, 4096, nullptr), raw_caps("GRAY8", 8, 4));
  EXPECT_NE(text.find("8x4 px, the disparity map has 5x3 px"), std::string::npos) << text;
}

TEST(MtConfidence, ReportsAConfidenceThatIsNoGray8Frame) {
  const std::string gray = raw_caps("GRAY8", kWidth, kHeight);
  EXPECT_NE(refused(frame_of(kSure, 0, 0), "").find("GRAY8"), std::string::npos);
  EXPECT_NE(refused(frame_of(kSure, 0, 0), raw_caps("I420", 5, 3)).find("GRAY8"),
            std::string::npos);
  EXPECT_NE(refused(frame_of(kSure, 0, 0), "text/plain").find("GRAY8"), std::string::npos);
  EXPECT_NE(refused(nullptr, gray).find("GRAY8"), std::string::npos);
}

TEST(MtConfidence, ReportsAConfidenceWithTooFewBytes) {
  const std::string text =
      refused(gst_buffer_new_allocate(nullptr, 20, nullptr), raw_caps("GRAY8", kWidth, kHeight));
  EXPECT_NE(text.find("20 bytes"), std::string::npos) << text;
}

TEST(MtConfidence, ReportsAMapThatContradictsItsCaps) {
  Filter filter("");
  GstBuffer* map = Filter::map(64, 0);
  gst_buffer_set_size(map, 60);
  const std::string text = filter.refusal(map);
  EXPECT_NE(text.find("60 bytes"), std::string::npos) << text;
}

TEST(MtConfidence, OffersNoOtherFormats) {
  for (const char* format : {"GRAY8", "GRAY16_BE", "RGB"}) {
    GstElement* filter = make_element("", "mtconfidence");
    GstPad* pad = gst_element_get_static_pad(filter, "sink");
    const CapsPointer caps(gst_caps_from_string(raw_caps(format, 64, 48).c_str()));
    const CapsPointer offered(gst_pad_query_caps(pad, nullptr));
    EXPECT_FALSE(gst_caps_can_intersect(offered.get(), caps.get())) << format;
    gst_object_unref(pad);
    gst_object_unref(filter);
  }
}

}  // namespace
}  // namespace mtstereo::test::mtconfidence_test
