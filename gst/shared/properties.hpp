// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <functional>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mtstereo/result.hpp"

// The properties of an element as a table: a row for each one, with its field in the structure of
// the values. The default of a property is its field's initial value.

namespace mtstereo::plugin {

inline constexpr auto kWhilePlaying = static_cast<GParamFlags>(
    G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS | GST_PARAM_MUTABLE_PLAYING);
inline constexpr auto kBeforeStart =
    static_cast<GParamFlags>(G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS | GST_PARAM_MUTABLE_READY);

/// A value of an enumeration, what it means, and its name.
template <typename Enum>
struct Word {
  Enum value;
  const char* help;
  const char* nick;
};

/// Registers an enumeration. To be called once: types exist until the program ends.
template <typename Enum>
GType enum_type(const char* name, std::initializer_list<Word<Enum>> words) {
  auto* values = new GEnumValue[words.size() + 1]{};
  GEnumValue* next = values;
  for (const Word<Enum>& word : words)
    *next++ = {static_cast<gint>(word.value), word.help, word.nick};
  const GType type = g_enum_register_static(name, values);
  gst_type_mark_as_plugin_api(type, static_cast<GstPluginAPIFlags>(0));
  return type;
}

inline void from_value(const GValue& value, int& field) { field = g_value_get_int(&value); }
inline void from_value(const GValue& value, gint64& field) { field = g_value_get_int64(&value); }
inline void from_value(const GValue& value, guint64& field) { field = g_value_get_uint64(&value); }
inline void from_value(const GValue& value, double& field) { field = g_value_get_double(&value); }
inline void from_value(const GValue& value, float& field) {
  field = static_cast<float>(g_value_get_double(&value));
}
inline void from_value(const GValue& value, std::optional<double>& field) {
  field = g_value_get_double(&value);
}
inline void from_value(const GValue& value, bool& field) {
  field = g_value_get_boolean(&value) != FALSE;
}
inline void from_value(const GValue& value, std::string& field) {
  const gchar* text = g_value_get_string(&value);
  field = text != nullptr ? text : "";
}

inline void to_value(GValue& value, int field) { g_value_set_int(&value, field); }
inline void to_value(GValue& value, gint64 field) { g_value_set_int64(&value, field); }
inline void to_value(GValue& value, guint64 field) { g_value_set_uint64(&value, field); }
inline void to_value(GValue& value, double field) { g_value_set_double(&value, field); }
inline void to_value(GValue& value, float field) {
  g_value_set_double(&value, static_cast<double>(field));
}
inline void to_value(GValue& value, std::optional<double> field) {
  g_value_set_double(&value, field.value_or(0));
}
inline void to_value(GValue& value, bool field) { g_value_set_boolean(&value, field); }
inline void to_value(GValue& value, const std::string& field) {
  g_value_set_string(&value, field.empty() ? nullptr : field.c_str());
}

/// Where a value is in a structure: `&State::near`, or `{&State::range, &Range::near}`.
template <typename State, typename T>
class Field {
 public:
  template <typename Owner>
  Field(T Owner::*member)  // implicit: it is what a row has
      : reference_([member](State& state) -> T& { return state.*member; }) {}
  template <typename Outer, typename Part, typename Inner>
  Field(Part Outer::*part, T Inner::*member)
      : reference_([part, member](State& state) -> T& { return state.*part.*member; }) {}

  T& of(State& state) const { return reference_(state); }
  const T& of(const State& state) const { return reference_(const_cast<State&>(state)); }
  T usual() const { return of(State()); }

 private:
  std::function<T&(State&)> reference_;
};

/// A row of a table of properties.
template <typename State>
class Property {
 public:
  using Set = std::function<Status(State&, const GValue&)>;
  using Get = std::function<void(const State&, GValue&)>;

  /// A property with functions of its own.
  Property(GParamSpec* spec, Set set, Get get)
      : spec_(spec), set_(std::move(set)), get_(std::move(get)) {}

  Property(const char* name, Field<State, int> field, int least, int most, const char* blurb,
           GParamFlags flags = kWhilePlaying)
      : Property(field, g_param_spec_int(name, name, blurb, least, most, field.usual(), flags)) {}
  Property(const char* name, Field<State, gint64> field, gint64 least, gint64 most,
           const char* blurb, GParamFlags flags = kWhilePlaying)
      : Property(field, g_param_spec_int64(name, name, blurb, least, most, field.usual(), flags)) {}
  Property(const char* name, Field<State, guint64> field, guint64 least, guint64 most,
           const char* blurb, GParamFlags flags = kWhilePlaying)
      : Property(field, g_param_spec_uint64(name, name, blurb, least, most, field.usual(), flags)) {
  }
  Property(const char* name, Field<State, double> field, double least, double most,
           const char* blurb, GParamFlags flags = kWhilePlaying)
      : Property(field, g_param_spec_double(name, name, blurb, least, most, field.usual(), flags)) {
  }
  Property(const char* name, Field<State, float> field, double least, double most,
           const char* blurb, GParamFlags flags = kWhilePlaying)
      : Property(field, g_param_spec_double(name, name, blurb, least, most,
                                            static_cast<double>(field.usual()), flags)) {}
  /// Not set: 0.
  Property(const char* name, Field<State, std::optional<double>> field, double least, double most,
           const char* blurb, GParamFlags flags = kWhilePlaying)
      : Property(field, g_param_spec_double(name, name, blurb, least, most, 0, flags)) {}
  Property(const char* name, Field<State, bool> field, const char* blurb,
           GParamFlags flags = kWhilePlaying)
      : Property(field, g_param_spec_boolean(name, name, blurb, field.usual(), flags)) {}
  /// Not set: NULL.
  Property(const char* name, Field<State, std::string> field, const char* blurb,
           GParamFlags flags = kWhilePlaying)
      : Property(field, g_param_spec_string(name, name, blurb, nullptr, flags)) {}
  /// `type`: of enum_type().
  template <typename Owner, typename Enum>
  Property(const char* name, Enum Owner::*member, GType type, const char* blurb,
           GParamFlags flags = kWhilePlaying)
      : spec_(
            g_param_spec_enum(name, name, blurb, type, static_cast<gint>(State().*member), flags)),
        set_([member](State& state, const GValue& value) {
          state.*member = static_cast<Enum>(g_value_get_enum(&value));
          return Status();
        }),
        get_([member](const State& state, GValue& value) {
          g_value_set_enum(&value, static_cast<gint>(state.*member));
        }) {}

  GParamSpec* spec() const { return spec_; }
  /// Fails if the value is refused; the state is unchanged then.
  Status set(State& state, const GValue& value) const { return set_(state, value); }
  void get(const State& state, GValue& value) const { get_(state, value); }

 private:
  template <typename T>
  Property(const Field<State, T>& field, GParamSpec* spec)
      : spec_(spec),
        set_([field](State& state, const GValue& value) {
          from_value(value, field.of(state));
          return Status();
        }),
        get_([field](const State& state, GValue& value) { to_value(value, field.of(state)); }) {}

  GParamSpec* spec_;
  Set set_;
  Get get_;
};

/// All properties of an element, or a group of them with successive numbers.
template <typename State>
class PropertyTable {
 public:
  using Rows = std::vector<Property<State>>;

  explicit PropertyTable(Rows rows, guint first = 1) : rows_(std::move(rows)), first_(first) {}
  /// Two groups of rows.
  PropertyTable(Rows rows, Rows more) : PropertyTable(std::move(rows)) {
    std::move(more.begin(), more.end(), std::back_inserter(rows_));
  }

  void install(GObjectClass* object_class) const {
    guint id = first_;
    for (const Property<State>& row : rows_) {
      g_object_class_install_property(object_class, id++, row.spec());
    }
  }
  /// Sets a property of a table whose rows refuse no value.
  void set(State& state, guint id, const GValue& value) const {
    [[maybe_unused]] const Status accepted = row(id).set(state, value);
  }
  void get(const State& state, guint id, GValue& value) const { row(id).get(state, value); }

  /// The number after the last one.
  guint end() const { return first_ + static_cast<guint>(rows_.size()); }
  bool has(guint id) const { return id >= first_ && id < end(); }
  /// The row of a number that the table has.
  const Property<State>& row(guint id) const { return rows_[id - first_]; }

 private:
  Rows rows_;
  guint first_;
};

}  // namespace mtstereo::plugin
