// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/decoder_reports.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <string_view>

#include "lib/outputs/texts.hpp"
#include "recordings/media/decoder_kind.hpp"

namespace mtstereo::run {
namespace {

constexpr std::size_t kMost = 100'000;   // frames that are listed
constexpr std::size_t kMostBegun = 256;  // more than threads of libav have at once
constexpr std::size_t kMostKnown = 32;   // frames of which only the first report counts
constexpr const char* kBaseClass = "videodecoder";
constexpr std::string_view kError = "error: ";  // how the base class begins reports of decoders

// The reports about the frame that this thread decodes.
thread_local std::weak_ptr<DecoderReports> decoding;

void on_log(GstDebugCategory* category, GstDebugLevel level, const gchar* /*file*/,
            const gchar* /*function*/, gint /*line*/, GObject* /*object*/, GstDebugMessage* message,
            gpointer /*data*/) noexcept {
  if (level != GST_LEVEL_WARNING) return;
  if (std::string_view(gst_debug_category_get_name(category)) != kBaseClass) return;
  const std::shared_ptr<DecoderReports> reports = decoding.lock();
  if (!reports) return;
  const gchar* const content = gst_debug_message_get(message);
  const std::string_view text = content != nullptr ? content : "";
  if (text.starts_with(kError)) reports->add(std::string(text.substr(kError.size())));
}

// Of the base class of the decoders.
void listen_to_base_class() {
  static std::once_flag once;
  std::call_once(once, [] {
    // In brackets: the macros of these names compare pointers of functions with pointers of data.
    (gst_debug_add_log_function)(on_log, nullptr, nullptr);
    // Without GST_DEBUG nothing is printed. The default function prints all that passes the
    // thresholds.
    const char* const wanted = std::getenv("GST_DEBUG");
    if (wanted == nullptr || *wanted == '\0') {
      (gst_debug_remove_log_function)(nullptr);  // the default function
    }
  });
  // The threshold is that of GST_DEBUG, which stays if it is higher.
  GstDebugCategory* const category = _gst_debug_get_category(kBaseClass);
  if (category == nullptr || gst_debug_category_get_threshold(category) >= GST_LEVEL_WARNING) {
    return;
  }
  gst_debug_category_set_threshold(category, GST_LEVEL_WARNING);
}

Nanoseconds order_of(const DamagedFrame& frame) {
  return frame.time.value_or(std::numeric_limits<Nanoseconds>::min());
}

}  // namespace

void DecoderReports::listen_to(GstElement* decoder) {
  // What libav returns to the base class is of an earlier frame.
  if (is_libav_decoder(decoder)) {
    receive_errors_of_libav(decoder, shared_from_this());
  } else {
    listen_to_base_class();
  }
}

void DecoderReports::begin(std::optional<Nanoseconds> time, bool keyframe) {
  decoding = weak_from_this();
  const std::lock_guard lock(mutex_);
  if (keyframe && !started_) {
    started_ = true;
    start_ = time;
  }
  begun_.push_back({time, counts(time)});
  if (begun_.size() > kMostBegun) begun_.pop_front();
  ++number_;
}

void DecoderReports::set_first(Nanoseconds time) {
  const std::lock_guard lock(mutex_);
  first_ = time;
}

void DecoderReports::flush() {
  const std::lock_guard lock(mutex_);
  started_ = false;
  start_.reset();
}

void DecoderReports::add(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  if (!begun_.empty()) add_frame(begun_.back(), reason);
}

void DecoderReports::add_of(std::int64_t number, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  const std::int64_t place = number - number_ + std::ssize(begun_);
  if (place < 0 || place >= std::ssize(begun_)) return;
  add_frame(begun_[static_cast<std::size_t>(place)], reason);
}

void DecoderReports::add(std::optional<Nanoseconds> time, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  add_frame({time, counts(time)}, reason);
}

bool DecoderReports::counts(std::optional<Nanoseconds> time) const {
  if (!started_ || time == kNotShown) return false;
  return !time || (*time >= start_.value_or(*time) && *time >= first_.value_or(*time));
}

void DecoderReports::add_frame(const Begun& frame, const std::string& reason) {
  if (!frame.counts || frames_.size() >= kMost) return;
  if (std::find(damaged_.begin(), damaged_.end(), frame.time) != damaged_.end()) return;
  frames_.push_back({frame.time, reason});
  damaged_.push_back(frame.time);
  if (damaged_.size() > kMostKnown) damaged_.pop_front();
}

std::vector<DamagedFrame> DecoderReports::take_until(Nanoseconds time) {
  const std::lock_guard lock(mutex_);
  const auto later = std::stable_partition(
      frames_.begin(), frames_.end(),
      [time](const DamagedFrame& frame) { return !frame.time || *frame.time <= time; });
  std::vector<DamagedFrame> found(std::make_move_iterator(frames_.begin()),
                                  std::make_move_iterator(later));
  frames_.erase(frames_.begin(), later);
  std::stable_sort(found.begin(), found.end(), [](const DamagedFrame& a, const DamagedFrame& b) {
    return order_of(a) < order_of(b);
  });
  return found;
}

std::string seconds_text(Nanoseconds time) { return outputs::format("%.3f s", seconds(time)); }

std::string damage_text(const std::vector<DamagedFrame>& frames, const std::string& title) {
  if (frames.empty()) return "";
  const DamagedFrame& first = frames.front();
  std::string text = outputs::counted(frames.size(), "frame") + " of the " + title +
                     " cannot be decoded without errors";
  if (first.time) text += ", the first one at " + seconds_text(*first.time);
  return text + " (" + first.reason + ")";
}

}  // namespace mtstereo::run
