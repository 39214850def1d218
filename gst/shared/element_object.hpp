// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/base/gstbasetransform.h>

#include <type_traits>

#include "shared/exception_guard.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {

/// The instance of an element: that of its base class, and its data.
template <typename Base, typename State>
struct Instance {
  Base parent;
  State* state;  ///< created in the element's init
};

/// What GObject asks of an `Element`, which is an Instance. kTable() is the table of its
/// properties. Their values are the member kValues of its state, and guarded by its lock.
/// kChangesCaps(before, now), if there is one: whether an element that is a GstBaseTransform has to
/// negotiate again after a change. No type is derived from an element's.
template <typename Element, auto kTable, auto kValues, auto kChangesCaps = nullptr>
struct ElementObject {
  static void set_property(GObject* object, guint id, const GValue* value, GParamSpec*) {
    [[maybe_unused]] bool changes_caps = false;
    {
      const ObjectLock lock(object);
      auto& values = reinterpret_cast<Element*>(object)->state->*kValues;
      [[maybe_unused]] const auto before = values;
      kTable().set(values, id, *value);
      if constexpr (kHasCaps) changes_caps = kChangesCaps(before, values);
    }
    if constexpr (kHasCaps) {
      if (changes_caps) gst_base_transform_reconfigure_src(GST_BASE_TRANSFORM(object));
    }
  }

  static void get_property(GObject* object, guint id, GValue* value, GParamSpec*) {
    const ObjectLock lock(object);
    kTable().get(reinterpret_cast<Element*>(object)->state->*kValues, id, *value);
  }

  static void finalize(GObject* object) noexcept {
    delete reinterpret_cast<Element*>(object)->state;
    const gpointer parent = g_type_class_peek_parent(G_OBJECT_GET_CLASS(object));
    G_OBJECT_CLASS(parent)->finalize(object);
  }

  /// For the class init of the element.
  static void install(GObjectClass* object_class) noexcept {
    object_class->set_property = guarded<set_property>;
    object_class->get_property = guarded<get_property>;
    object_class->finalize = finalize;
    kTable().install(object_class);
  }

 private:
  static constexpr bool kHasCaps = !std::is_null_pointer_v<decltype(kChangesCaps)>;
};

}  // namespace mtstereo::plugin
