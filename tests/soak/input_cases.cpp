// SPDX-License-Identifier: LGPL-2.1-or-later
// Properties from several threads, changes of caps, and caps and frames that are wrong.
#include <array>
#include <cstring>
#include <thread>

#include "soak.hpp"

namespace mtstereo::soak {
namespace {

constexpr const char* kProperties = "values of properties";

/// A text for a property: a sensible value, an extreme one, or none at all.
std::string random_text(Random& random, const GParamSpec* spec) {
  if (random.chance(0.2)) {
    constexpr std::array kAny = {"",     "0",   "-1",       "1",    "nan",  "x",
                                 "true", "1e9", "64,32,16", "fast", "none", "0.5,-0.1,0,0,0"};
    return random.one_of(kAny);
  }
  if (G_IS_PARAM_SPEC_INT(spec)) {
    const auto* range = G_PARAM_SPEC_INT(spec);
    const int most = random.chance(0.7) ? std::min(range->maximum, 40) : range->maximum;
    return std::to_string(random.between(std::min(range->minimum, most), most));
  }
  if (G_IS_PARAM_SPEC_DOUBLE(spec)) {
    const auto* range = G_PARAM_SPEC_DOUBLE(spec);
    const double share = static_cast<double>(random.between(0, 1000)) / 1000;
    return std::to_string(range->minimum + share * (range->maximum - range->minimum));
  }
  if (G_IS_PARAM_SPEC_BOOLEAN(spec)) return random.chance(0.5) ? "true" : "false";
  if (G_IS_PARAM_SPEC_ENUM(spec)) {
    return std::to_string(random.between(0, G_PARAM_SPEC_ENUM(spec)->enum_class->n_values - 1));
  }
  if (G_IS_PARAM_SPEC_INT64(spec) || G_IS_PARAM_SPEC_UINT64(spec)) {
    constexpr std::array kTimes = {"0",         "1",          "20000000",
                                   "100000000", "3600000000", "9223372036854775807"};
    return random.one_of(kTimes);
  }
  return "1,0";
}

/// Properties that belong to the pipeline, or that its other elements would not survive.
bool is_left_alone(const GParamSpec* spec) {
  if ((spec->flags & G_PARAM_WRITABLE) == 0) return true;
  for (const char* name :
       {"name", "parent", "start-time", "start-time-selection", "threads", "confidence-map"}) {
    if (std::strcmp(spec->name, name) == 0) return true;
  }
  return false;
}

void set_and_read(Random& random, GObject* object, int operations) {
  guint count = 0;
  GParamSpec** specs = g_object_class_list_properties(G_OBJECT_GET_CLASS(object), &count);
  for (int i = 0; i < operations; ++i) {
    GParamSpec* spec = specs[random.between(0, count - 1)];
    if (!is_left_alone(spec) && random.chance(0.7)) {
      gst_util_set_object_arg(object, spec->name, random_text(random, spec).c_str());
    } else if ((spec->flags & G_PARAM_READABLE) != 0) {
      GValue value = G_VALUE_INIT;
      g_value_init(&value, spec->value_type);
      g_object_get_property(object, spec->name, &value);
      g_value_unset(&value);
    }
  }
  g_free(specs);
}

void set_defaults(GObject* object) {
  guint count = 0;
  GParamSpec** specs = g_object_class_list_properties(G_OBJECT_GET_CLASS(object), &count);
  for (guint i = 0; i < count; ++i) {
    if (is_left_alone(specs[i])) continue;
    g_object_set_property(object, specs[i]->name, g_param_spec_get_default_value(specs[i]));
  }
  g_free(specs);
}

struct Objects {
  std::vector<GObject*> all;
  explicit Objects(const CheckedPipeline& pipeline) {
    for (const char* name : {"m", "c", "f"}) all.push_back(G_OBJECT(pipeline.named(name)));
    for (const char* name : {"sink_left", "sink_right"}) {
      all.push_back(G_OBJECT(gst_element_get_static_pad(pipeline.named("m"), name)));
    }
  }
  ~Objects() {
    for (std::size_t i = 3; i < all.size(); ++i) g_object_unref(all[i]);
  }
  Objects(const Objects&) = delete;
  Objects& operator=(const Objects&) = delete;
};

}  // namespace

void set_properties(Soak& soak) {
  constexpr int kOperations = 300;
  CheckedPipeline pipeline(
      soak, kProperties,
      "mtstereo name=m max-disparity=16 threads=2 ! mtconfidence name=f ! mtcolor name=c ! "
      "fakesink sync=false "
      "videotestsrc pattern=snow ! video/x-raw,format=GRAY8,width=64,height=48 ! queue ! "
      "m.sink_left "
      "videotestsrc pattern=snow ! video/x-raw,format=GRAY8,width=64,height=48 ! queue ! "
      "m.sink_right",
      false);
  soak.count(kProperties, [](Counts& counts) { ++counts.cases; });
  const Objects objects(pipeline);
  pipeline.set_state(GST_STATE_PLAYING);
  if (!pipeline.settle("start")) return;
  soak.within(120, kProperties, "set values", [&] {
    std::vector<std::thread> threads;
    for (int i = 0; i < 3; ++i) {
      threads.emplace_back([&, seed = soak.random.seed()] {
        Random random(seed);
        for (int block = 0; block < 10; ++block) {
          GObject* object = random.chance(0.7) ? objects.all[0] : random.one_of(objects.all);
          // output=confidence would change the caps to ones that mtcolor does not accept.
          if (object == objects.all[2]) continue;
          set_and_read(random, object, kOperations / 10);
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
  });
  soak.count(kProperties, [](Counts& counts) { counts.operations += 3 * kOperations; });
  for (GObject* object : objects.all) set_defaults(object);
  g_object_set(objects.all[0], "max-disparity", 16, nullptr);
  const std::uint64_t before = pipeline.maps();
  soak.within(120, kProperties, "maps after the defaults were set again", [&] {
    while (pipeline.maps() < before + 5 && !pipeline.failed()) g_usleep(1000);
  });
  if (pipeline.failed()) soak.fail(kProperties, pipeline.error());
}

void change_caps(Soak& soak) {
  const std::string kind = "changes of caps";
  Random& random = soak.random;
  test::StereoHarness harness("max-disparity=4 threads=1 disparity-scale=16");
  soak.within(120, kind, "match frames of changing sizes", [&] {
    GstClockTime time = 0;
    for (int i = 0; i < 10; ++i) {
      const int width = static_cast<int>(random.between(16, 90));
      const int height = static_cast<int>(random.between(8, 60));
      constexpr std::array kFormats = {"GRAY8", "I420", "NV12", "Y444"};
      constexpr std::array kRates = {"30/1", "25/1", "0/1", "30000/1001"};
      const test::Pair pair = test::noise_pair(width, height, 2, static_cast<unsigned>(i));
      const test::Layout left{random.one_of(kFormats)};
      const test::Layout right{random.one_of(kFormats)};
      harness.caps(test::raw_caps(left.format, width, height, random.one_of(kRates)),
                   test::raw_caps(right.format, width, height, random.one_of(kRates)));
      for (int frame = 0; frame < 3; ++frame, time += test::kFrame) {
        harness.push_pair(pair, time, left, right);
        const test::BufferPointer map = harness.pull();
        const gsize least = static_cast<gsize>(width) * static_cast<gsize>(height) * 2;
        if (!map || gst_buffer_get_size(map.get()) < least) {
          return soak.fail(kind, "a map is missing or has the wrong size");
        }
      }
      soak.count(kind, [](Counts& counts) { ++counts.operations; });
    }
  });
  soak.count(kind, [](Counts& counts) {
    ++counts.cases;
    counts.maps += 30;
  });
}

namespace {

/// Counts an error that was expected, and checks that it states its cause.
void expect_error(Soak& soak, const std::string& kind, test::StereoHarness& harness,
                  const std::string& what) {
  const test::Report report = harness.error(30);
  soak.count(kind, [](Counts& counts) {
    ++counts.operations;
    ++counts.errors;
  });
  if (report.text.empty()) {
    soak.fail(kind, "no error: " + what);
  } else if (!states_cause(report.text, report.details)) {
    soak.fail(kind, "the error does not state its cause: " + what + ": " + report.text);
  }
  if (harness.further_errors(0) > 0) soak.fail(kind, "more than one error: " + what);
}

}  // namespace

void send_wrong_caps(Soak& soak) {
  const std::string kind = "wrong caps";
  const std::string good = test::raw_caps("GRAY8", 48, 32);
  constexpr std::array kWrong = {
      "video/x-raw,format=GRAY8,width=64,height=32,framerate=30/1",
      "video/x-raw,format=GRAY8,width=48,height=31,framerate=30/1",
      "video/x-raw,format=GRAY8,width=48,height=32,framerate=30/1,interlace-mode=interleaved",
      "video/x-raw,format=GRAY8,width=48,height=32,framerate=30/1,interlace-mode=mixed",
      "video/x-raw(memory:GLMemory),format=GRAY8,width=48,height=32,framerate=30/1",
      "video/x-raw,format=v308,framerate=30/1",
      "video/x-raw,width=48,height=32,framerate=30/1",
      "video/x-raw,format=no-such-format,width=48,height=32",
      "video/x-bayer,format=bggr,width=48,height=32,framerate=30/1",
      "video/x-h264,stream-format=byte-stream",
      "image/jpeg,width=48,height=32",
      "audio/x-raw,format=S16LE,rate=48000,channels=2,layout=interleaved"};
  soak.within(180, kind, "wait for an error", [&] {
    const std::string wrong = soak.random.one_of(kWrong);
    const bool on_left = soak.random.chance(0.5);
    test::StereoHarness harness("max-disparity=8 threads=1");
    if (soak.random.chance(0.5)) {
      const test::Pair pair = test::noise_pair(48, 32, 2, 1);
      harness.caps(good);
      harness.push_pair(pair, 0);
      if (!harness.pull()) soak.fail(kind, "no map before the wrong caps");
    }
    harness.caps(on_left ? wrong : good, on_left ? good : wrong);
    const test::Pair pair = test::noise_pair(48, 32, 2, 1);
    harness.push(Side::kLeft, test::frame_buffer(pair.left, test::kFrame, test::kFrame));
    harness.push(Side::kRight, test::frame_buffer(pair.right, test::kFrame, test::kFrame));
    expect_error(soak, kind, harness, (on_left ? "left " : "right ") + wrong);
  });
  soak.count(kind, [](Counts& counts) { ++counts.cases; });
}

void send_wrong_frames(Soak& soak) {
  const std::string kind = "wrong frames";
  Random& random = soak.random;
  soak.within(180, kind, "wait for an error", [&] {
    test::StereoHarness harness("max-disparity=8 threads=1");
    harness.caps(test::raw_caps("GRAY8", 48, 32));
    const test::Pair pair = test::noise_pair(48, 32, 2, 1);
    const auto good = static_cast<int>(random.between(0, 5));
    for (int i = 0; i < good; ++i) {
      harness.push_pair(pair, static_cast<GstClockTime>(i) * test::kFrame);
      if (!harness.pull()) return soak.fail(kind, "no map of a good pair");
    }
    const auto time = static_cast<GstClockTime>(good) * test::kFrame;
    GstBuffer* frames[2] = {test::frame_buffer(pair.left, time, test::kFrame),
                            test::frame_buffer(pair.right, time, test::kFrame)};
    const auto side = static_cast<std::size_t>(random.between(0, 1));
    GstBuffer* wrong = frames[side];
    std::string what;
    switch (random.between(0, 3)) {
      case 0:
        what = "a short buffer";
        gst_buffer_set_size(wrong, random.between(0, 48 * 32 - 1));
        break;
      case 1:
        what = "a meta of another size";
        gst_buffer_add_video_meta(wrong, GST_VIDEO_FRAME_FLAG_NONE, GST_VIDEO_FORMAT_GRAY8, 40, 32);
        break;
      case 2:
        what = "a meta of another format";
        gst_buffer_add_video_meta(wrong, GST_VIDEO_FRAME_FLAG_NONE, GST_VIDEO_FORMAT_I420, 48, 32);
        break;
      default:
        what = "a frame without a time stamp";
        GST_BUFFER_PTS(wrong) = GST_CLOCK_TIME_NONE;
    }
    harness.push(Side::kLeft, frames[0]);
    harness.push(Side::kRight, frames[1]);
    expect_error(soak, kind, harness, what);
  });
  soak.count(kind, [](Counts& counts) { ++counts.cases; });
}

}  // namespace mtstereo::soak
