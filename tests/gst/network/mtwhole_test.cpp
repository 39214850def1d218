// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gst/check/gstharness.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/pipeline.hpp"

namespace mtstereo::test::mtwhole_test {
namespace {

constexpr GstClockTime kPeriod = 40 * GST_MSECOND;

/// Encoded pictures, each of which is decoded without any other one.
std::vector<std::string> encoded_pictures(int count) {
  Pipeline pipeline("videotestsrc pattern=snow num-buffers=" + std::to_string(count) +
                    " ! video/x-raw,format=I420,width=64,height=48,framerate=25/1 ! x264enc "
                    "tune=zerolatency key-int-max=1 ! h264parse config-interval=-1 ! "
                    "video/x-h264,stream-format=byte-stream,alignment=au ! appsink name=out "
                    "sync=false wait-on-eos=false");
  EXPECT_EQ(pipeline.run(), "");
  std::vector<std::string> pictures;
  for (const Sample& sample : pipeline.samples()) {
    pictures.emplace_back(sample.bytes.begin(), sample.bytes.end());
  }
  return pictures;
}

/// A parser and mtwhole downstream of a demultiplexer.
class Receiver {
 public:
  Receiver() : harness_(gst_harness_new_parse("h264parse ! mtwhole")) {
    gst_harness_set_src_caps_str(harness_, "video/x-h264,stream-format=byte-stream,alignment=nal");
  }
  ~Receiver() { gst_harness_teardown(harness_); }
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  void push(const std::string& data, bool after_gap = false) {
    GstBuffer* buffer = gst_buffer_new_memdup(data.data(), data.size());
    GST_BUFFER_PTS(buffer) = kPeriod * pushed_;
    if (after_gap) GST_BUFFER_FLAG_SET(buffer, GST_BUFFER_FLAG_DISCONT);
    ++pushed_;
    EXPECT_EQ(gst_harness_push(harness_, buffer), GST_FLOW_OK);
  }

  /// The numbers of the pictures that were output until the end of the stream.
  std::vector<int> end() {
    gst_harness_push_event(harness_, gst_event_new_eos());
    std::vector<int> numbers;
    while (GstBuffer* buffer = gst_harness_try_pull(harness_)) {
      numbers.push_back(static_cast<int>(GST_BUFFER_PTS(buffer) / kPeriod));
      gst_buffer_unref(buffer);
    }
    return numbers;
  }

 private:
  GstHarness* harness_;
  guint pushed_ = 0;
};

class MtWhole : public testing::Test {
 protected:
  std::vector<std::string> pictures = encoded_pictures(5);
  Receiver receiver;

  void SetUp() override { ASSERT_EQ(pictures.size(), 5u); }
};

TEST_F(MtWhole, PassesPicturesThatAnotherOneFollows) {
  for (const std::string& picture : pictures) receiver.push(picture);
  EXPECT_EQ(receiver.end(), (std::vector<int>{0, 1, 2, 3}));
}

// Feature: two videos from another computer
TEST_F(MtWhole, DropsThePictureUpstreamOfAGap) {
  for (int i = 0; i < 5; ++i) {
    const std::string& picture = pictures[static_cast<std::size_t>(i)];
    receiver.push(i == 2 ? picture.substr(0, picture.size() / 2) : picture, i == 3);
  }
  EXPECT_EQ(receiver.end(), (std::vector<int>{0, 1, 3}));
}

TEST_F(MtWhole, DropsTheLastPictureOfTheStream) {
  receiver.push(pictures[0]);
  receiver.push(pictures[1].substr(0, pictures[1].size() - 1));
  EXPECT_EQ(receiver.end(), std::vector<int>{0});
}

}  // namespace
}  // namespace mtstereo::test::mtwhole_test
