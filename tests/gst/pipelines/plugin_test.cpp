// SPDX-License-Identifier: LGPL-2.1-or-later
// The types that the plugin registers, as gst-inspect-1.0 lists them.
#include <gst/gst.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace mtstereo::test::plugin_test {
namespace {

/// The class of an element. It holds a reference.
class ElementClass {
 public:
  explicit ElementClass(GstElementFactory* factory) : name_(GST_OBJECT_NAME(factory)) {
    GstPluginFeature* loaded = gst_plugin_feature_load(GST_PLUGIN_FEATURE(factory));
    type_ = gst_element_factory_get_element_type(GST_ELEMENT_FACTORY(loaded));
    class_ = G_OBJECT_CLASS(g_type_class_ref(type_));
    gst_object_unref(loaded);
  }
  ~ElementClass() { g_type_class_unref(class_); }
  ElementClass(const ElementClass&) = delete;
  ElementClass& operator=(const ElementClass&) = delete;

  const std::string& name() const { return name_; }
  GType type() const { return type_; }
  /// The properties of the element, without those of its base classes.
  std::vector<GParamSpec*> properties() const {
    guint count = 0;
    GParamSpec** all = g_object_class_list_properties(class_, &count);
    std::vector<GParamSpec*> own;
    std::copy_if(all, all + count, std::back_inserter(own),
                 [this](const GParamSpec* spec) { return spec->owner_type == type_; });
    g_free(all);
    return own;
  }

 private:
  std::string name_;
  GType type_ = 0;
  GObjectClass* class_ = nullptr;
};

class Plugin : public testing::Test {
 protected:
  void SetUp() override {
    GList* features = gst_registry_get_feature_list_by_plugin(gst_registry_get(), "mtstereo");
    for (GList* item = features; item != nullptr; item = item->next) {
      if (GST_IS_ELEMENT_FACTORY(item->data)) {
        elements.push_back(std::make_unique<ElementClass>(GST_ELEMENT_FACTORY(item->data)));
      }
    }
    gst_plugin_feature_list_free(features);
  }

  std::vector<std::unique_ptr<ElementClass>> elements;
};

/// Begins with a capital letter, or with a number, and ends without a period.
bool is_sentence(const std::string& text) {
  return !text.empty() && g_ascii_islower(text.front()) == FALSE && text.back() != '.';
}

// Feature: tests with newer versions of GStreamer
// Feature: two input pads that always exist
TEST_F(Plugin, RegistersItsElements) {
  std::set<std::string> names;
  for (const auto& element : elements) names.insert(element->name());
  EXPECT_EQ(names, (std::set<std::string>{"mtstereo", "mtcolor", "mtconfidence", "mtdepth",
                                          "mtcloud", "mtrectify", "mtsplit", "mtwhole"}));
}

TEST_F(Plugin, NamesElementsLikeTheirFactories) {
  for (const auto& element : elements) {
    GstElement* made = gst_element_factory_make(element->name().c_str(), nullptr);
    const std::string name = GST_OBJECT_NAME(made);
    gst_object_unref(made);
    const auto digits = name.find_first_of("0123456789");
    EXPECT_EQ(name.substr(0, digits), element->name());
    EXPECT_NE(digits, std::string::npos) << name;
  }
}

TEST_F(Plugin, GivesItsTypesOnePrefix) {
  for (const auto& element : elements) {
    EXPECT_TRUE(g_str_has_prefix(g_type_name(element->type()), "GstMt"));
    for (const GParamSpec* spec : element->properties()) {
      if (!G_IS_PARAM_SPEC_ENUM(spec)) continue;
      EXPECT_TRUE(g_str_has_prefix(g_type_name(spec->value_type), "GstMtStereo"))
          << g_type_name(spec->value_type);
    }
  }
}

TEST_F(Plugin, DescribesEveryEnumerationValue) {
  int values = 0;
  for (const auto& element : elements) {
    for (GParamSpec* spec : element->properties()) {
      if (!G_IS_PARAM_SPEC_ENUM(spec)) continue;
      const GEnumClass* type = G_PARAM_SPEC_ENUM(spec)->enum_class;
      for (guint i = 0; i < type->n_values; ++i, ++values) {
        const std::string name = type->values[i].value_name;
        const std::string nick = type->values[i].value_nick;
        EXPECT_NE(name, "") << element->name() << " " << spec->name << "=" << nick;
        EXPECT_NE(name, nick) << element->name() << " " << spec->name;
        EXPECT_TRUE(is_sentence(name)) << element->name() << " " << spec->name << ": " << name;
      }
    }
  }
  EXPECT_GT(values, 10);
}

TEST_F(Plugin, DescribesEveryProperty) {
  for (const auto& element : elements) {
    for (GParamSpec* spec : element->properties()) {
      const gchar* blurb = g_param_spec_get_blurb(spec);
      ASSERT_NE(blurb, nullptr) << spec->name;
      EXPECT_STRNE(blurb, spec->name) << element->name();
      EXPECT_TRUE(is_sentence(blurb)) << element->name() << " " << spec->name << ": " << blurb;
    }
  }
}

TEST_F(Plugin, DescribesItselfInSentenceCaseAndWithoutAMadeUpAddress) {
  for (const auto& element : elements) {
    GstElementFactory* factory = gst_element_factory_find(element->name().c_str());
    for (const char* key : {GST_ELEMENT_METADATA_LONGNAME, GST_ELEMENT_METADATA_DESCRIPTION}) {
      EXPECT_TRUE(is_sentence(gst_element_factory_get_metadata(factory, key))) << element->name();
    }
    EXPECT_STREQ("The mtstereo authors",
                 gst_element_factory_get_metadata(factory, GST_ELEMENT_METADATA_AUTHOR));
    gst_object_unref(factory);
  }
  GstPlugin* plugin = gst_registry_find_plugin(gst_registry_get(), "mtstereo");
  const std::string origin = gst_plugin_get_origin(plugin);
  EXPECT_TRUE(origin == "Unknown package origin" || origin.rfind("https://", 0) == 0) << origin;
  gst_object_unref(plugin);
}

}  // namespace
}  // namespace mtstereo::test::plugin_test
