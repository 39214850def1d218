// SPDX-License-Identifier: LGPL-2.1-or-later
// The elements around mtstereo: caps that a sink pad cannot take are one error of the element, with
// the pad, the cause and what to do.
#include <gst/app/gstappsrc.h>
#include <gtest/gtest.h>

#include <ostream>

#include "cameras/camera_harness.hpp"
#include "geometry/rigs.hpp"
#include "support/map_harness.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::caps_check_test {
namespace {

constexpr const char* kGray = "video/x-raw,format=GRAY8,width=64,height=48";
constexpr const char* kMap = "video/x-raw,format=GRAY16_LE,width=64,height=48";

/// An element and the pad that gets a stream. RIG and FOLDER in `launch` are replaced.
struct Target {
  const char* name;
  const char* launch;
  const char* pad;
  const char* valid;   ///< caps
  const char* remedy;  ///< for another format
};

void PrintTo(const Target& target, std::ostream* stream) { *stream << target.name; }

constexpr const char* kPoints = " location=FOLDER/%d.ply focal-length=100 baseline=0.1";

const Target kTargets[] = {
    {"mtrectify", "mtrectify calibration=RIG ! fakesink", "sink", kGray, "videoconvert"},
    {"mtsplit", "mtsplit name=e e.left ! fakesink async=false e.right ! fakesink async=false",
     "sink", kGray, "videoconvert"},
    {"mtdepth", "mtdepth focal-length=100 baseline=0.1 ! fakesink", "sink", kMap, "mtstereo"},
    {"mtcolor", "mtcolor ! fakesink", "sink", kMap, "mtstereo"},
    {"mtconfidence", "mtconfidence output=disparity ! fakesink", "sink", kMap, "mtstereo"},
    {"mtcloud", "mtcloud", "sink", kMap, "mtstereo"},
    {"mtcloudLeft", "mtcloud", "sink_left", kGray, "videoconvert"},
};

class RefusedCaps : public testing::TestWithParam<Target> {
 protected:
  std::string launch(const std::string& caps) {
    const Target& target = GetParam();
    std::string text = target.launch;
    const std::string factory = text.substr(0, text.find(' '));
    const std::string properties = factory == "mtcloud" ? kPoints : "";
    const bool named = text.find("name=e") != std::string::npos;
    text.replace(0, factory.size(), factory + (named ? "" : " name=e") + properties);
    for (auto [word, value] :
         {std::pair<std::string, std::string>{"RIG", folder_.write(plumb_bob_rig(64, 48))},
          {"FOLDER", folder_.path("")}}) {
      if (const auto at = text.find(word); at != std::string::npos) {
        text.replace(at, word.size(), value);
      }
    }
    return text + " appsrc name=in format=time caps=" + caps + " ! e." + target.pad;
  }
  /// The errors of the element for a frame with these caps.
  std::vector<Report> errors_of(const std::string& caps) {
    Pipeline pipeline(launch(caps));
    pipeline.set_state(GST_STATE_PLAYING);
    auto* source = GST_APP_SRC(pipeline.named("in"));
    for (int i = 0; i < 2; ++i) {
      gst_app_src_push_buffer(source, gst_buffer_new_allocate(nullptr, 64 * 48 * 4, nullptr));
    }
    gst_app_src_end_of_stream(source);
    GstBus* bus = gst_element_get_bus(pipeline.element());
    std::vector<Report> errors;
    // The source is the last one to post an error.
    for (bool ended = false; !ended;) {
      const MessagePointer message = next_message(bus, GST_MESSAGE_ERROR, 10);
      ended = !message || GST_MESSAGE_SRC(message.get()) == GST_OBJECT(source);
      if (message && !ended) errors.push_back(report_of(message.get()));
    }
    gst_object_unref(bus);
    return errors;
  }
  void expect_error(const std::string& caps, std::initializer_list<std::string> parts) {
    const std::vector<Report> errors = errors_of(caps);
    ASSERT_EQ(errors.size(), 1u) << caps;
    const std::string pad = std::string("The stream on ") + GetParam().pad + " ";
    EXPECT_NE(errors[0].text.find(pad), std::string::npos) << errors[0].text;
    for (const std::string& part : parts) {
      EXPECT_NE(errors[0].text.find(part), std::string::npos) << part << ": " << errors[0].text;
    }
    EXPECT_NE(errors[0].details.find("received " + caps.substr(0, caps.find_first_of(",("))),
              std::string::npos)
        << errors[0].details;
  }

  CalibrationFolder folder_;
};

// Feature: errors as messages with a remedy, no output on stdout
TEST_P(RefusedCaps, NameTheFormat) {
  const std::string other = GetParam().valid == kGray ? "RGB8P" : "I420";
  expect_error("video/x-raw,format=" + other + ",width=64,height=48",
               {"format " + other, GetParam().remedy});
}

TEST_P(RefusedCaps, NameTheKindOfStream) {
  expect_error("video/x-bayer,format=rggb,width=64,height=48", {"video/x-bayer", "bayer2rgb"});
  expect_error("video/x-h264,width=64,height=48", {"video/x-h264", "decoder"});
  expect_error("audio/x-raw", {"audio/x-raw", "raw video is required"});
}

TEST_P(RefusedCaps, NameTheMemory) {
  std::string caps = GetParam().valid;
  caps.insert(caps.find(','), "(memory:GLMemory)");
  expect_error(caps, {"memory:GLMemory", "gldownload"});
}

TEST_P(RefusedCaps, NameTheSize) {
  const std::string valid = GetParam().valid;
  const std::string format = valid.substr(0, valid.find(",width"));
  expect_error(format + ",width=0,height=0", {"0x0 px", "1 to "});
  expect_error(format + ",width=64,height=99999", {"64x99999 px", "videoscale"});
  expect_error(format, {"incomplete", "width and height"});
}

TEST_P(RefusedCaps, MayLackAFramerate) {
  Pipeline pipeline(launch(GetParam().valid));
  pipeline.set_state(GST_STATE_PLAYING);
  auto* source = GST_APP_SRC(pipeline.named("in"));
  GstPad* sink = gst_element_get_static_pad(pipeline.named("e"), GetParam().pad);
  gst_app_src_end_of_stream(source);
  GstBus* bus = gst_element_get_bus(pipeline.element());
  for (int i = 0; i < 100 && !gst_pad_has_current_caps(sink); ++i) g_usleep(10'000);
  EXPECT_TRUE(gst_pad_has_current_caps(sink));
  const MessagePointer error = next_message(bus, GST_MESSAGE_ERROR);
  EXPECT_EQ(text_of(error), "");
  gst_object_unref(bus);
  gst_object_unref(sink);
}

INSTANTIATE_TEST_SUITE_P(Of, RefusedCaps, testing::ValuesIn(kTargets),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace mtstereo::test::caps_check_test
