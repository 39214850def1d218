// SPDX-License-Identifier: LGPL-2.1-or-later

// Pairs from GStreamer sources.

#include <gst/gst.h>

#include <memory>
#include <utility>

#include "lib/media/decoding_problem.hpp"
#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "matcher/pairing/tolerance.hpp"
#include "programs/calibrate/branch.hpp"
#include "programs/calibrate/source.hpp"

namespace mtstereo::calibrate {
namespace {

using outputs::decimal;

constexpr plugin::Nanoseconds kHalfFrame = -1;  // the default tolerance of mtstereo
constexpr std::size_t kMostWaiting = 32;        // frames of one side
constexpr double kNanoseconds = 1e-9;

void start_gstreamer() {
  g_autoptr(GError) error = nullptr;
  if (gst_init_check(nullptr, nullptr, &error) != FALSE) return;
  throw UserError(std::string("GStreamer cannot be initialized: ") +
                  (error != nullptr ? error->message : "unknown error"));
}

struct StopPipeline {
  void operator()(GstElement* pipeline) const {
    gst_element_set_state(pipeline, GST_STATE_NULL);
    gst_object_unref(pipeline);
  }
};

class Streams : public PairSource {
 public:
  explicit Streams(const SourceOptions& options) : options_(options) {
    start_gstreamer();
    pipeline_.reset(GST_ELEMENT(gst_object_ref_sink(gst_pipeline_new(nullptr))));
    const bool two = options.arrangement == Arrangement::kTwoSources;
    left_ = std::make_unique<Branch>(GST_PIPELINE(pipeline_.get()), two ? "left" : "", options.left,
                                     options);
    if (two) {
      right_ =
          std::make_unique<Branch>(GST_PIPELINE(pipeline_.get()), "right", options.right, options);
    }
    if (gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING) == GST_STATE_CHANGE_FAILURE) {
      check_errors();
      throw UserError("the sources cannot be started");
    }
  }

  SourceState next(ImagePair& pair) override {
    check_errors();
    const SourceState state = right_ ? next_of_two(pair) : next_of_one(pair);
    if (state == SourceState::kPair) find_out_live();
    return state;
  }

  bool stills() const override { return false; }
  bool live() const override { return live_; }

 private:
  // The first error that a source has posted.
  void check_errors() const {
    g_autoptr(GstBus) bus = gst_element_get_bus(pipeline_.get());
    g_autoptr(GstMessage) message = gst_bus_pop_filtered(bus, GST_MESSAGE_ERROR);
    if (message == nullptr) return;
    std::string title = "the sources";
    for (const Branch* branch : {left_.get(), right_.get()}) {
      if (branch != nullptr && branch->owns(GST_MESSAGE_SRC(message))) title = branch->title();
    }
    throw UserError(title + ": " + media::decoding_problem(message));
  }

  // Live sources cannot wait for the search of the board.
  void find_out_live() {
    if (std::exchange(asked_, true)) return;
    live_ = left_->is_live() || (right_ && right_->is_live());
    if (!live_) return;
    left_->drop_old_frames();
    if (right_) right_->drop_old_frames();
  }

  // Waits for one more frame of a branch.
  void pull(Branch& branch) const {
    if (branch.pull()) return;
    check_errors();
    branch.check_silence(options_.timeout);
  }

  void name(const Branch::Frame& frame, ImagePair& pair) {
    pair.time =
        frame.time ? kNanoseconds * static_cast<double>(*frame.time) : static_cast<double>(index_);
    pair.name = decimal(pair.time, 2) + " s";
    ++index_;
  }

  SourceState next_of_one(ImagePair& pair) {
    if (left_->frames().empty()) pull(*left_);
    if (left_->frames().empty()) {
      return left_->ended() ? SourceState::kEnd : SourceState::kWaiting;
    }
    const Branch::Frame& frame = left_->frames().front();
    name(frame, pair);
    split(frame.image, options_.arrangement, pair);
    left_->erase(0);
    return SourceState::kPair;
  }

  SourceState next_of_two(ImagePair& pair) {
    for (Branch* branch : {left_.get(), right_.get()}) {
      if (branch->frames().empty()) pull(*branch);
      if (!branch->frames().empty()) continue;
      return branch->ended() ? SourceState::kEnd : SourceState::kWaiting;
    }
    if (options_.pairing == Pairing::kIndex) return take(pair);
    for (const Branch* branch : {left_.get(), right_.get()}) {
      if (branch->frames().back().time) continue;
      throw UserError(branch->title() +
                      ": its frames have no time stamps; pair them by --pairing index");
    }
    return pair_by_time(pair);
  }

  SourceState pair_by_time(ImagePair& pair) {
    const plugin::Nanoseconds tolerance =
        plugin::effective_tolerance(kHalfFrame, {left_->caps_period(), right_->caps_period()},
                                    {left_->buffer_period(), right_->buffer_period()});
    const plugin::PairDecision step = finder_.next(left_->waiting(), right_->waiting(), tolerance);
    Branch& branch = step.side == Side::kLeft ? *left_ : *right_;
    switch (step.action) {
      case plugin::PairAction::kPair:
        finder_.paired(*left_->frames().front().time, *right_->frames().front().time);
        unpaired_ = 0;
        return take(pair);
      case plugin::PairAction::kDrop:
        if (!step.wrong_time) finder_.dropped(step.side, *branch.frames()[step.index].time);
        branch.erase(step.index);
        check_unpaired(step.difference);
        return SourceState::kWaiting;
      case plugin::PairAction::kWait:
        break;
    }
    if (branch.frames().size() >= kMostWaiting) branch.erase(0);
    pull(branch);
    return SourceState::kWaiting;
  }

  // Streams whose times never fit.
  void check_unpaired(plugin::Nanoseconds difference) {
    if (++unpaired_ < kMostUnpaired) return;
    throw UserError(std::to_string(unpaired_) +
                    " frames in a row have no partner: the times of the sources differ by " +
                    decimal(kNanoseconds * static_cast<double>(difference), 3) +
                    " s. Start both together, or pair files by --pairing index");
  }

  SourceState take(ImagePair& pair) {
    name(left_->frames().front(), pair);
    pair.left = left_->frames().front().image;
    pair.right = right_->frames().front().image;
    left_->erase(0);
    right_->erase(0);
    return SourceState::kPair;
  }

  static constexpr int kMostUnpaired = 2000;  // frames

  SourceOptions options_;
  std::unique_ptr<GstElement, StopPipeline> pipeline_;
  std::unique_ptr<Branch> left_, right_;
  plugin::PairFinder finder_;
  int unpaired_ = 0;
  int index_ = 0;
  bool asked_ = false, live_ = false;
};

}  // namespace

std::unique_ptr<PairSource> open_streams(const SourceOptions& options) {
  return std::make_unique<Streams>(options);
}

}  // namespace mtstereo::calibrate
