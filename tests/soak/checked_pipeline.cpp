// SPDX-License-Identifier: LGPL-2.1-or-later
// Feature: errors as messages with a remedy, no output on stdout
#include "soak.hpp"
#include "support/stereo_harness.hpp"

namespace mtstereo::soak {
namespace {

constexpr double kStateSeconds = 60;

/// True if no element of the bin is changing its state.
bool elements_are_settled(GstElement* bin) {
  GstIterator* elements = gst_bin_iterate_recurse(GST_BIN(bin));
  GValue changing = G_VALUE_INIT;
  const auto is_settled = [](gconstpointer value, gconstpointer) -> gint {
    auto* element = GST_ELEMENT(g_value_get_object(static_cast<const GValue*>(value)));
    return gst_element_get_state(element, nullptr, nullptr, 0) == GST_STATE_CHANGE_ASYNC ? 0 : 1;
  };
  const bool found = gst_iterator_find_custom(elements, is_settled, &changing, nullptr) != FALSE;
  if (found) g_value_unset(&changing);
  gst_iterator_free(elements);
  return !found;
}

bool is_of_plugin(GstObject* source) {
  const std::string type = G_OBJECT_TYPE_NAME(source);
  return type.starts_with("GstMt");
}

}  // namespace

bool states_cause(const std::string& text, const std::string& details) {
  return text.size() >= 25 && text.find("Internal") == std::string::npos && !details.empty();
}

CheckedPipeline::CheckedPipeline(Soak& soak, std::string kind, const std::string& launch,
                                 bool numbered)
    : soak_(soak), kind_(std::move(kind)), numbered_(numbered) {
  pipeline_ = std::make_unique<test::Pipeline>(launch);
  GstElement* matcher = gst_bin_get_by_name(GST_BIN(element()), "m");
  if (matcher == nullptr) return;
  GstPad* output = gst_element_get_static_pad(matcher, "src");
  gst_pad_add_probe(output, GST_PAD_PROBE_TYPE_BUFFER, check_map, this, nullptr);
  gst_object_unref(output);
  gst_object_unref(matcher);
}

CheckedPipeline::~CheckedPipeline() {
  failed();
  soak_.within(kStateSeconds, kind_, "stop", [&] { pipeline_.reset(); });
  soak_.count(kind_, [&](Counts& counts) {
    counts.maps += maps_;
    counts.wrong += wrong_;
    counts.warned += warned_maps_;
    counts.unreadable += unreadable_;
  });
}

GstPadProbeReturn CheckedPipeline::check_map(GstPad*, GstPadProbeInfo* info, gpointer self) {
  auto& pipeline = *static_cast<CheckedPipeline*>(self);
  ++pipeline.maps_;
  if (!pipeline.numbered_) return GST_PAD_PROBE_OK;
  const auto difference = test::frame_difference(GST_PAD_PROBE_INFO_BUFFER(info));
  if (!difference) {
    ++pipeline.unreadable_;
  } else if (*difference != 0) {
    pipeline.failed();  // reads the warnings up to now
    ++(pipeline.warned_ ? pipeline.warned_maps_ : pipeline.wrong_);
  }
  return GST_PAD_PROBE_OK;
}

void CheckedPipeline::set_state(GstState state) {
  history_ += std::string("; ") + gst_element_state_get_name(state);
  soak_.within(kStateSeconds, kind_, std::string("state ") + gst_element_state_get_name(state),
               [&] { pipeline_->set_state(state); });
}

bool CheckedPipeline::settle(const char* what) {
  bool settled = false;
  int only_bin = 0;  // successive waits in which only the bin was not settled
  soak_.within(kStateSeconds, kind_, what + (" after " + history_), [&] {
    while (!settled && !failed() && only_bin < 100) {
      settled = pipeline_->wait_until_settled(0.1);
      only_bin = elements_are_settled(element()) ? only_bin + 1 : 0;
    }
  });
  if (!settled && only_bin > 0) soak_.bin_got_stuck();
  return settled || only_bin == 0;
}

bool CheckedPipeline::seek(double rate, GstSeekFlags flags, GstClockTime from, GstClockTime to) {
  bool done = false;
  const auto text = [](GstClockTime time) {
    return GST_CLOCK_TIME_IS_VALID(time) ? std::to_string(time / GST_MSECOND) + " ms" : "the end";
  };
  history_ += "; seek at rate " + std::to_string(rate) + " with flags " + std::to_string(flags) +
              " from " + text(from) + " to " + text(to);
  soak_.within(kStateSeconds, kind_, "seek after " + history_, [&] {
    done = gst_element_seek(element(), rate, GST_FORMAT_TIME, flags, GST_SEEK_TYPE_SET,
                            static_cast<gint64>(from), GST_SEEK_TYPE_SET,
                            GST_CLOCK_TIME_IS_VALID(to) ? static_cast<gint64>(to) : -1);
  });
  return done;
}

void CheckedPipeline::forget_end() {
  failed();
  const std::scoped_lock lock(mutex_);
  ended_ = false;
}

void CheckedPipeline::wait_for_end(const char* what) {
  soak_.within(kStateSeconds, kind_, what + (" after " + history_), [&] {
    while (!failed()) {
      {
        const std::scoped_lock lock(mutex_);
        if (ended_) return;
      }
      g_usleep(2000);
    }
  });
}

void CheckedPipeline::take(GstMessage* message) {
  switch (GST_MESSAGE_TYPE(message)) {
    case GST_MESSAGE_EOS:
      ended_ = true;
      return;
    case GST_MESSAGE_ERROR:
    case GST_MESSAGE_WARNING:
      break;
    default:
      return;
  }
  const test::Report report = test::report_of(message);
  const bool ours = is_of_plugin(GST_MESSAGE_SRC(message));
  if (ours) warned_ = true;
  if (ours && !states_cause(report.text, report.details)) {
    soak_.fail(kind_, "a message does not state its cause: " + report.text);
  }
  if (GST_MESSAGE_TYPE(message) != GST_MESSAGE_ERROR || !error_.empty()) return;
  error_ = report.text + " [" + report.details + "]";
  if (!ours) {
    soak_.fail(kind_, std::string("an error of ") + GST_OBJECT_NAME(GST_MESSAGE_SRC(message)) +
                          " instead of mtstereo: " + error_);
  }
}

bool CheckedPipeline::failed() {
  const std::scoped_lock lock(mutex_);
  GstBus* bus = gst_element_get_bus(element());
  while (const test::MessagePointer message{gst_bus_pop(bus)}) take(message.get());
  gst_object_unref(bus);
  return !error_.empty();
}

std::string CheckedPipeline::error() {
  failed();
  const std::scoped_lock lock(mutex_);
  return error_;
}

}  // namespace mtstereo::soak
