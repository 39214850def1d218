// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/matching_line.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "lib/outputs/user_error.hpp"
#include "recordings/matching/products.hpp"
#include "recordings/matching/work_facts.hpp"

namespace mtstereo::run {
namespace {

// Each lane has a matcher with its memory.
constexpr int kMostLanes = 8;

// Every frame is coded independently, so that lanes can share a file and pieces can be joined.
constexpr const char* kEncoder = "avenc_ffv1 gop-size=1 slices=4 threads=1";
constexpr const char* kSource = " format=time block=true max-buffers=2 max-bytes=0 max-time=0";
constexpr const char* kSink = " sync=false qos=false max-buffers=4 enable-last-sample=false";
// More frames than wait in the matcher: the left views of clouds must not stop them.
constexpr const char* kDeepQueue = "queue max-size-buffers=32 max-size-bytes=0 max-size-time=0";
constexpr const char* kQueue = "queue max-size-buffers=3 max-size-bytes=0 max-size-time=0";

bool rectifies(const Recording& recording) {
  return !recording.rectified && !recording.calibration.empty();
}

// The part of a pipeline that belongs to one lane.
class LaneLine {
 public:
  LaneLine(const Work& work, int lane) : work_(work), lane_(lane) {}

  std::string text() const {
    std::string line = " mtstereo " + named("m") + " qos=false ! tee " + named("t") + "  " +
                       lane_name("t", lane_) + ". ! " + kQueue + " ! appsink " + named(kMapSink) +
                       kSink;
    for (const Product product : work_.options.products) line += product_line(product);
    return line + views();
  }

 private:
  std::string named(const std::string& name) const { return "name=" + lane_name(name, lane_); }

  std::string rectifier(const std::string& name) const {
    return rectifies(work_.recording) ? "mtrectify " + named(name) + " ! " : "";
  }

  // A branch with a view as it is matched, in color.
  std::string copy(const char* formats, const char* element, const std::string& sink) const {
    return std::string(" ! ") + kDeepQueue + " ! videoconvert ! video/x-raw,format=" + formats +
           " ! " + rectifier(element) + sink + kSink;
  }

  std::vector<std::string> copies(const std::string& side) const {
    const bool left = side == "left", video = work_.options.format == MapFormat::kMatroska;
    const Product product = left ? Product::kRectifiedLeft : Product::kRectifiedRight;
    std::vector<std::string> branches;
    if (left && makes(work_.options, Product::kCloud)) {
      branches.push_back(copy("RGB", "rectify_view", "appsink " + named(kViewSink)));
    }
    if (makes(work_.options, product)) {
      const std::string encoder = video ? std::string(kEncoder) + " ! " : "";
      branches.push_back(copy(video ? "{BGRx,GRAY8}" : "{BGR,GRAY8}",
                              left ? "rectify_left_copy" : "rectify_right_copy",
                              encoder + "appsink " + named(product_name(product))));
    }
    return branches;
  }

  // From the pad of a view to the matcher, and to the sinks of its copies.
  std::string view(const std::string& pad, const std::string& side) const {
    std::string line = " " + pad;
    const std::vector<std::string> branches = copies(side);
    if (!branches.empty()) {
      const std::string tee = lane_name("views_" + side, lane_);
      line += " ! tee name=" + tee;
      for (const std::string& branch : branches) {
        line += "  ";
        line += tee;
        line += ".";
        line += branch;
      }
      line += "  " + tee + ".";
    }
    return line + " ! " + kQueue + " ! " + rectifier("rectify_" + side) + lane_name("m", lane_) +
           ".sink_" + side + " ";
  }

  std::string views() const {
    const Recording& recording = work_.recording;
    if (recording.arrangement == Arrangement::kTwoSources) {
      return view("appsrc " + named("left") + kSource, "left") +
             view("appsrc " + named("right") + kSource, "right");
    }
    const bool rows = recording.arrangement == Arrangement::kTopBottom;
    const std::string split = lane_name("split", lane_);
    return " appsrc " + named("both") + kSource + " ! mtsplit name=" + split +
           " layout=" + (rows ? "top-bottom" : "side-by-side") +
           (recording.swapped ? " swap=true" : "") + view(split + ".left", "left") +
           view(split + ".right", "right");
  }

  // From the maps to the sink of a product.
  std::string product_line(Product product) const {
    const bool video = work_.options.format == MapFormat::kMatroska;
    std::string line;
    switch (product) {
      case Product::kDisparity:
        if (!video) return {};  // files are made of the maps
        break;
      case Product::kDepth:
        line = " ! mtdepth " + named("depths");
        break;
      case Product::kColor:
        line = std::string(" ! mtcolor ! video/x-raw,format=") + (video ? "BGRx" : "BGR");
        break;
      case Product::kConfidence:
        line = " ! mtconfidence output=confidence";
        break;
      case Product::kCloud:
      case Product::kRectifiedLeft:
      case Product::kRectifiedRight:
        return {};  // of the views
    }
    return "  " + lane_name("t", lane_) + ". ! " + kQueue + line +
           (video ? std::string(" ! ") + kEncoder : "") + " ! appsink " +
           named(product_name(product)) + kSink;
  }

  const Work& work_;
  int lane_;
};

// Sets properties of the elements of a lane.
class LaneSettings {
 public:
  LaneSettings(const Pipeline& pipeline, int lane) : pipeline_(pipeline), lane_(lane) {}

  void set(const char* element, const char* property, const std::string& value) const {
    const ElementPointer found = element_of(pipeline_, lane_name(element, lane_));
    if (!found) return;
    GParamSpec* const known =
        g_object_class_find_property(G_OBJECT_GET_CLASS(found.get()), property);
    if (known == nullptr) throw UserError(std::string("mtstereo has no property ") + property);
    // Names of files may have any bytes.
    if (G_PARAM_SPEC_VALUE_TYPE(known) == G_TYPE_STRING) {
      g_object_set(found.get(), property, value.c_str(), nullptr);
    } else {
      gst_util_set_object_arg(G_OBJECT(found.get()), property, value.c_str());
    }
  }

  void set_calibration(const Recording& recording) const {
    if (recording.calibration.empty()) return;
    if (!rectifies(recording)) {
      set("depths", "calibration", recording.calibration);
      return;
    }
    constexpr std::array kCopies{"rectify_view", "rectify_left_copy", "rectify_right_copy"};
    for (const char* const name : {"rectify_left", "rectify_right"}) {
      set(name, "calibration", recording.calibration);
    }
    for (const char* const name : kCopies) {
      set(name, "calibration", recording.calibration);
      set(name, "color", "true");
    }
    set_shape(recording.shape);
    set("rectify_right", "camera", "right");
    set("rectify_right_copy", "camera", "right");
  }

  void set_shape(const RectifiedShape& shape) const {
    for (const char* const name : {"rectify_left", "rectify_right", "rectify_view",
                                   "rectify_left_copy", "rectify_right_copy"}) {
      set(name, "alpha", number_text(shape.alpha));
      set(name, "width", std::to_string(shape.width));
      set(name, "height", std::to_string(shape.height));
    }
  }

  void set_parameters(const Work& work, int threads) const {
    for (const auto& [name, value] : work.options.parameters) set("m", name.c_str(), value);
    for (const auto& [name, value] : work.correction) set("m", name.c_str(), value);
    if (work.options.near > 0) set("depths", "near", number_text(work.options.near));
    if (work.options.far) set("depths", "far", number_text(*work.options.far));
    if (threads > 0) set("m", "threads", std::to_string(threads));
  }

 private:
  const Pipeline& pipeline_;
  int lane_;
};

}  // namespace

Lanes lanes_for(int threads) {
  const int all = threads > 0 ? threads : std::max(1, static_cast<int>(g_get_num_processors()));
  const int count = std::min(all, kMostLanes);
  return {.count = count, .threads = (all + count - 1) / count};
}

std::string lane_name(const std::string& name, int lane) { return name + std::to_string(lane); }

Pipeline matching_pipeline(const Work& work, Lanes lanes) {
  std::string line;
  for (int lane = 0; lane < lanes.count; ++lane) line += LaneLine(work, lane).text();
  Pipeline pipeline = parse_pipeline(line);
  for (int lane = 0; lane < lanes.count; ++lane) {
    const LaneSettings settings(pipeline, lane);
    settings.set_calibration(work.recording);
    settings.set_parameters(work, lanes.threads);
  }
  return pipeline;
}

Pipeline map_pipeline(const Work& work) {
  Work maps = work;
  maps.options.products.clear();
  return matching_pipeline(maps, {.count = 1, .threads = work.options.threads});
}

}  // namespace mtstereo::run
