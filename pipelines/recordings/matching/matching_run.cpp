// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/matching_run.hpp"

#include <utility>

#include "lib/outputs/user_error.hpp"
#include "recordings/matching/products.hpp"

namespace mtstereo::run {
namespace {

// Encoders add a constant to the time stamps and to the segment.
GstClockTime running_time(GstSample* sample) {
  return gst_segment_to_running_time(gst_sample_get_segment(sample), GST_FORMAT_TIME,
                                     GST_BUFFER_PTS(gst_sample_get_buffer(sample)));
}

}  // namespace

MatchingRun::MatchingRun(const Work& work, std::vector<std::int64_t> pairs, Pipeline pipeline,
                         int lanes, std::vector<DamageNote> earlier)
    : work_(work),
      pipeline_(std::move(pipeline)),
      feeder_(work, std::move(pairs), pipeline_, lanes) {
  for (int lane = 0; lane < lanes; ++lane) add_lane(lane);
  if (gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING) == GST_STATE_CHANGE_FAILURE) {
    fail("the pipeline cannot be started");
  }
  feeder_.start(std::move(earlier));
}

void MatchingRun::add_lane(int number) {
  auto lane = std::make_unique<Lane>();
  lane->matcher = element_of(pipeline_, lane_name("m", number));
  lane->maps = element_of(pipeline_, lane_name(kMapSink, number));
  for (const Product product : work_.options.products) {
    ElementPointer element = element_of(pipeline_, lane_name(product_name(product), number));
    if (element) lane->sinks.push_back({product, std::move(element)});
  }
  ElementPointer view = element_of(pipeline_, lane_name(kViewSink, number));
  if (view) lane->sinks.push_back({std::nullopt, std::move(view)});
  g_autoptr(GstPad) pad = gst_element_get_static_pad(lane->matcher.get(), "src");
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, on_map, lane.get(), nullptr);
  lanes_.push_back(std::move(lane));
}

MatchingRun::~MatchingRun() {
  feeder_.stop();
  gst_element_set_state(pipeline_.get(), GST_STATE_NULL);
}

GstPadProbeReturn MatchingRun::on_map(GstPad* pad, GstPadProbeInfo* /*info*/,
                                      gpointer self) noexcept {
  auto& lane = *static_cast<Lane*>(self);
  GstStructure* stats = nullptr;
  g_object_get(GST_PAD_PARENT(pad), "stats", &stats, nullptr);
  MapFigures figures;
  gst_structure_get_double(stats, "last-ms", &figures.milliseconds);
  gst_structure_get_double(stats, "fine-detail", &figures.fine_detail);
  gst_structure_get_double(stats, "sharpness", &figures.sharpness);
  gst_structure_free(stats);
  const std::lock_guard lock(lane.mutex);
  lane.figures.push_back(figures);
  return GST_PAD_PROBE_OK;
}

// The reason of the feeder is the cause, if there is one.
void MatchingRun::fail(const std::string& reason) {
  feeder_.check();
  const std::string posted = posted_error(pipeline_);
  throw UserError(work_.recording.name + ": " + (posted.empty() ? reason : posted));
}

SamplePointer MatchingRun::take(GstElement* sink) {
  SamplePointer sample;
  for (;;) {
    const Taken taken = take_sample(sink, sample);
    if (taken == Taken::kFrame) return sample;
    feeder_.check();
    const std::string posted = posted_error(pipeline_);
    if (!posted.empty()) throw UserError(work_.recording.name + ": " + posted);
    if (taken == Taken::kEnd) return sample;
  }
}

MatchingRun::MapFigures MatchingRun::Lane::next_figures() {
  const std::lock_guard lock(mutex);
  if (figures.empty()) return {};
  const MapFigures first = figures.front();
  figures.pop_front();
  return first;
}

std::optional<PairResult> MatchingRun::next() {
  Lane& lane = *lanes_[lane_];
  PairResult result;
  result.map = take(lane.maps.get());
  if (!result.map) return std::nullopt;
  const GstClockTime time = running_time(result.map.get());
  result.pair = static_cast<Nanoseconds>(time) / work_.period;
  if (result.pair <= last_)
    fail("a disparity map before that of pair " + std::to_string(last_) + " is missing");
  const MapFigures figures = lane.next_figures();
  result.matching_ms = figures.milliseconds;
  result.fine_detail = figures.fine_detail;
  result.sharpness = figures.sharpness;
  for (const Sink& sink : lane.sinks) {
    SamplePointer sample = take(sink.element.get());
    if (!sample || running_time(sample.get()) != time) {
      fail(std::string("no ") + (sink.product ? product_name(*sink.product) : kViewSink) +
           " was made of pair " + std::to_string(result.pair));
    }
    (sink.product ? result.products[*sink.product] : result.view) = std::move(sample);
  }
  last_ = result.pair;
  lane_ = (lane_ + 1) % lanes_.size();
  return result;
}

}  // namespace mtstereo::run
