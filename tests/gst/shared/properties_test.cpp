// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/properties.hpp"

#include <gtest/gtest.h>

namespace mtstereo::plugin::properties_test {
namespace {

enum class Color { kRed, kBlue };

struct Range {
  double near = 0.5;
};

struct Values {
  int count = 3;
  gint64 wait = -1;
  bool enabled = true;
  std::string path;
  std::optional<double> offset;
  Color color = Color::kBlue;
  Range range;
};

Status set_even(Values& values, const GValue& value) {
  if (g_value_get_int(&value) % 2 != 0) return Error{ErrorCode::kInvalidParameter, "odd"};
  values.count = g_value_get_int(&value);
  return {};
}

const PropertyTable<Values>& table() {
  static const GType colors = enum_type<Color>(
      "MtStereoTestColor", {{Color::kRed, "Red", "red"}, {Color::kBlue, "Blue", "blue"}});
  static const PropertyTable<Values> made(
      {
          {"count", &Values::count, 1, 9, "Count"},
          {"wait", &Values::wait, -1, 100, "Wait"},
          {"enabled", &Values::enabled, "Enabled", kBeforeStart},
          {"path", &Values::path, "Path"},
          {"offset", &Values::offset, -5, 5, "Offset"},
          {"color", &Values::color, colors, "Color"},
      },
      {
          {"near", {&Values::range, &Range::near}, 0, 10, "Near"},
          {g_param_spec_int("even", "even", "Even", 0, 9, 0, kWhilePlaying), set_even,
           [](const Values& values, GValue& value) { g_value_set_int(&value, values.count); }},
      });
  return made;
}

constexpr guint kCount = 1, kPath = 4, kOffset = 5, kColor = 6, kNear = 7, kEven = 8;

/// A value of the type of a property.
class Value {
 public:
  explicit Value(guint id) { g_value_init(&value_, table().row(id).spec()->value_type); }
  ~Value() { g_value_unset(&value_); }
  Value(const Value&) = delete;
  Value& operator=(const Value&) = delete;
  GValue& operator*() { return value_; }

 private:
  GValue value_ = G_VALUE_INIT;
};

TEST(PropertyTable, HasTheDefaultsOfTheFields) {
  EXPECT_EQ(G_PARAM_SPEC_INT(table().row(kCount).spec())->default_value, 3);
  EXPECT_EQ(G_PARAM_SPEC_DOUBLE(table().row(kNear).spec())->default_value, 0.5);
  EXPECT_EQ(G_PARAM_SPEC_ENUM(table().row(kColor).spec())->default_value, 1);
  EXPECT_EQ(G_PARAM_SPEC_STRING(table().row(kPath).spec())->default_value, nullptr);
}

TEST(PropertyTable, SetsAndReadsTheFieldOfARow) {
  Values values;
  Value near(kNear);
  g_value_set_double(&*near, 2.5);
  table().set(values, kNear, *near);
  EXPECT_EQ(values.range.near, 2.5);
  Value color(kColor);
  g_value_set_enum(&*color, 0);
  table().set(values, kColor, *color);
  EXPECT_EQ(values.color, Color::kRed);
  Value read(kColor);
  table().get(values, kColor, *read);
  EXPECT_EQ(g_value_get_enum(&*read), 0);
  EXPECT_EQ(values.count, 3) << "the field of another row";
}

TEST(PropertyTable, AValueThatIsNotSetIsReadAsItsDefault) {
  Values values;
  Value offset(kOffset);
  table().get(values, kOffset, *offset);
  EXPECT_EQ(g_value_get_double(&*offset), 0);
  Value path(kPath);
  table().get(values, kPath, *path);
  EXPECT_EQ(g_value_get_string(&*path), nullptr);
  table().set(values, kPath, *path);
  EXPECT_EQ(values.path, "") << "of NULL";
}

TEST(PropertyTable, ARowCanRefuseAValue) {
  Values values;
  Value even(kEven);
  g_value_set_int(&*even, 5);
  EXPECT_FALSE(table().row(kEven).set(values, *even));
  EXPECT_EQ(values.count, 3);
  g_value_set_int(&*even, 4);
  EXPECT_TRUE(table().row(kEven).set(values, *even));
  EXPECT_EQ(values.count, 4);
}

TEST(PropertyTable, KnowsItsNumbers) {
  EXPECT_FALSE(table().has(0));
  EXPECT_TRUE(table().has(kCount));
  EXPECT_TRUE(table().has(kEven));
  EXPECT_FALSE(table().has(table().end()));
}

}  // namespace
}  // namespace mtstereo::plugin::properties_test
