// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/libav_log.hpp"

#include <cstdarg>
#include <cstdio>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/log.h>
}

namespace mtstereo::run {
namespace {

struct Receivers {
  std::mutex mutex;  // guards all below
  std::map<const void*, std::weak_ptr<LibavErrors>> of_decoders;
};

Receivers& receivers() {
  static Receivers* const all = new Receivers;  // threads of libav may outlive static objects
  return *all;
}

std::shared_ptr<LibavErrors> receiver_of(const void* decoder) {
  const std::lock_guard lock(receivers().mutex);
  const auto found = receivers().of_decoders.find(decoder);
  return found != receivers().of_decoders.end() ? found->second.lock() : nullptr;
}

GstDebugLevel level_of(int level) {
  if (level <= AV_LOG_QUIET) return GST_LEVEL_NONE;
  if (level <= AV_LOG_ERROR) return GST_LEVEL_ERROR;
  if (level <= AV_LOG_WARNING) return GST_LEVEL_WARNING;
  if (level <= AV_LOG_INFO) return GST_LEVEL_INFO;
  return level <= AV_LOG_VERBOSE ? GST_LEVEL_DEBUG : GST_LEVEL_LOG;
}

// As GStreamer does, whose function this one replaces.
void show(int level, const char* format, va_list arguments) {
  GstDebugCategory* const category = _gst_debug_get_category("libav");
  if (category == nullptr || gst_debug_category_get_threshold(category) < level_of(level)) return;
  gst_debug_log_valist(category, level_of(level), "", "", 0, nullptr, format, arguments);
}

// A reference that is to be forgotten is not known, as after the start at a keyframe: no pixel
// differs by it.
bool is_harmless(std::string_view text) { return text.starts_with("mmco: unref short failure"); }

// GStreamer sets two fields of the context, which threads of libav copy: the decoder, and the
// number of its frame.
void pass_on(const AVCodecContext& context, const char* format, va_list arguments) {
  const std::shared_ptr<LibavErrors> receiver = receiver_of(context.opaque);
  if (!receiver) return;
  char text[256];
  std::vsnprintf(text, sizeof text, format, arguments);
  const std::string_view line(text);
  if (is_harmless(line)) return;
  receiver->add_of(context.reordered_opaque,
                   std::string(line.substr(0, line.find_last_not_of("\n ") + 1)));
}

void on_log(void* object, int level, const char* format, va_list arguments) noexcept {
  va_list again;
  va_copy(again, arguments);
  show(level, format, again);
  va_end(again);
  const AVClass* const kind = object != nullptr ? *static_cast<const AVClass**>(object) : nullptr;
  if (level > AV_LOG_ERROR || kind == nullptr || kind->class_name == nullptr) return;
  if (std::string_view(kind->class_name) != "AVCodecContext") return;
  pass_on(*static_cast<const AVCodecContext*>(object), format, arguments);
}

}  // namespace

void receive_errors_of_libav(GstElement* decoder, const std::shared_ptr<LibavErrors>& receiver) {
  {
    const std::lock_guard lock(receivers().mutex);
    auto& all = receivers().of_decoders;
    std::erase_if(all, [](const auto& each) { return each.second.expired(); });
    all[decoder] = receiver;
  }
  av_log_set_callback(on_log);  // the plugin of the decoder has set its own one
}

}  // namespace mtstereo::run
