// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support/fixtures.hpp"

namespace mtstereo::test {

std::string property_text(GstElement* element, const char* name) {
  GValue value = G_VALUE_INIT;
  g_object_get_property(G_OBJECT(element), name, &value);
  gchar* serialized =
      G_VALUE_HOLDS_STRING(&value) ? g_value_dup_string(&value) : gst_value_serialize(&value);
  std::string text = serialized;
  g_free(serialized);
  g_value_unset(&value);
  return text;
}

void StreamsTest::expect_next(const Parameters& parameters, int scale) {
  const BufferPointer map = next();
  ASSERT_TRUE(map) << harness->error(1).text;
  const int width = pair.left.width;
  EXPECT_EQ(first_difference(library_map(pair, parameters, scale),
                             map_of(map.get(), width, pair.left.height), width),
            "");
}

}  // namespace mtstereo::test
