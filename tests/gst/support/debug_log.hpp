// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

namespace mtstereo::test {

/// The lines of a category up to this level while it lives.
class DebugLog {
 public:
  explicit DebugLog(GstDebugLevel level, const char* category = "mtstereo") : category_(category) {
    active_ = gst_debug_is_active();
    gst_debug_set_active(TRUE);
    gst_debug_set_threshold_for_name(category, level);
    // The macros of these names compare pointers of two kinds.
    (gst_debug_remove_log_function)(gst_debug_log_default);
    (gst_debug_add_log_function)(note, this, nullptr);
  }
  ~DebugLog() {
    gst_debug_remove_log_function_by_data(this);
    gst_debug_unset_threshold_for_name(category_.c_str());
    (gst_debug_add_log_function)(gst_debug_log_default, nullptr, nullptr);
    gst_debug_set_active(active_);
  }
  DebugLog(const DebugLog&) = delete;
  DebugLog& operator=(const DebugLog&) = delete;

  int lines_with(const std::string& text) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return static_cast<int>(std::count_if(lines_.begin(), lines_.end(), [&](const auto& line) {
      return line.find(text) != std::string::npos;
    }));
  }
  int lines() { return lines_with(""); }

 private:
  static void note(GstDebugCategory* category, GstDebugLevel, const gchar*, const gchar*, gint,
                   GObject*, GstDebugMessage* message, gpointer self) noexcept {
    auto& log = *static_cast<DebugLog*>(self);
    if (log.category_ != gst_debug_category_get_name(category)) return;
    const std::lock_guard<std::mutex> lock(log.mutex_);
    log.lines_.emplace_back(gst_debug_message_get(message));
  }

  std::string category_;
  gboolean active_ = FALSE;
  std::mutex mutex_;
  std::vector<std::string> lines_;
};

}  // namespace mtstereo::test
