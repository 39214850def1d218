// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <memory>

namespace mtstereo::plugin {

/// The deleter of the owning pointers below.
struct Unref {
  void operator()(GstBuffer* buffer) const { gst_buffer_unref(buffer); }
  void operator()(GstCaps* caps) const { gst_caps_unref(caps); }
  void operator()(GstObject* object) const { gst_object_unref(object); }
  void operator()(GstQuery* query) const { gst_query_unref(query); }
  void operator()(GstSample* sample) const { gst_sample_unref(sample); }
  void operator()(gchar* text) const { g_free(text); }
};
using BufferPointer = std::unique_ptr<GstBuffer, Unref>;
using CapsPointer = std::unique_ptr<GstCaps, Unref>;
using ObjectPointer = std::unique_ptr<GstObject, Unref>;
using QueryPointer = std::unique_ptr<GstQuery, Unref>;
using SamplePointer = std::unique_ptr<GstSample, Unref>;
using TextPointer = std::unique_ptr<gchar, Unref>;

/// Holds the lock of a GstObject for its lifetime. While it lives, post no message and take no
/// other lock of the element.
class ObjectLock {
 public:
  explicit ObjectLock(gpointer object) : object_(GST_OBJECT_CAST(object)) {
    GST_OBJECT_LOCK(object_);
  }
  ~ObjectLock() { GST_OBJECT_UNLOCK(object_); }
  ObjectLock(const ObjectLock&) = delete;
  ObjectLock& operator=(const ObjectLock&) = delete;

 private:
  GstObject* object_;
};

}  // namespace mtstereo::plugin
