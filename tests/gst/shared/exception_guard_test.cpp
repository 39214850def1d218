// SPDX-License-Identifier: LGPL-2.1-or-later
// What C code and the bus see if a callback of an element throws.
#include "shared/exception_guard.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "support/stereo_harness.hpp"

namespace mtstereo::test::exception_guard_test {
namespace {

using plugin::guarded;

GstFlowReturn throw_error(GstElement*) { throw std::runtime_error("the disk is full"); }
gboolean throw_bad_alloc(GstElement*, int) { throw std::bad_alloc(); }
gboolean throw_number(GstElement*) { throw 42; }
GstBuffer* throw_instead_of_buffer(GstElement*) { throw std::logic_error("no buffer"); }
void throw_from_procedure(GstElement*, guint) { throw std::out_of_range("no such index"); }
int add(GstElement*, int first, int second) { return first + second; }

int g_calls = 0;
void count_call(gpointer) noexcept { ++g_calls; }

class ExceptionGuard : public testing::Test {
 protected:
  void SetUp() override {
    g_calls = 0;
    element = gst_element_factory_make("identity", nullptr);
    ASSERT_NE(element, nullptr);
    bus = gst_bus_new();
    gst_element_set_bus(element, bus);
  }
  void TearDown() override {
    gst_element_set_bus(element, nullptr);
    gst_object_unref(bus);
    gst_object_unref(element);
  }
  /// The text of the next error message, or "" if there is none.
  std::string error() {
    const MessagePointer message(gst_bus_pop_filtered(bus, GST_MESSAGE_ERROR));
    if (!message) return "";
    EXPECT_EQ(GST_MESSAGE_SRC(message.get()), GST_OBJECT_CAST(element));
    GError* error = nullptr;
    gchar* details = nullptr;
    gst_message_parse_error(message.get(), &error, &details);
    EXPECT_TRUE(g_error_matches(error, GST_LIBRARY_ERROR, GST_LIBRARY_ERROR_FAILED));
    EXPECT_NE(std::string(details).find("exception"), std::string::npos) << details;
    std::string text = error->message;
    g_error_free(error);
    g_free(details);
    return text;
  }

  GstElement* element = nullptr;
  GstBus* bus = nullptr;
};

TEST_F(ExceptionGuard, IsACallbackForCCode) {
  static_assert(std::is_same_v<decltype(guarded<throw_error, GST_FLOW_ERROR>),
                               GstFlowReturn (*const)(GstElement*) noexcept>);
  EXPECT_EQ((guarded<add, 0>(element, 2, 3)), 5);
  EXPECT_EQ(error(), "");
}

TEST_F(ExceptionGuard, TurnsAnExceptionIntoAnErrorMessageAndTheFallback) {
  EXPECT_EQ((guarded<throw_error, GST_FLOW_ERROR>(element)), GST_FLOW_ERROR);
  const std::string text = error();
  EXPECT_NE(text.find("the disk is full"), std::string::npos) << text;
  EXPECT_EQ(error(), "") << "more than one message";
}

TEST_F(ExceptionGuard, CatchesOutOfMemory) {
  EXPECT_EQ((guarded<throw_bad_alloc, FALSE>(element, 1)), FALSE);
  EXPECT_NE(error().find("bad_alloc"), std::string::npos);
}

TEST_F(ExceptionGuard, CatchesExceptionsOfUnknownType) {
  EXPECT_EQ((guarded<throw_number, TRUE>(element)), TRUE);
  EXPECT_NE(error().find("unknown exception"), std::string::npos);
}

TEST_F(ExceptionGuard, ReturnsNullWithoutAFallback) {
  EXPECT_EQ(guarded<throw_instead_of_buffer>(element), nullptr);
  EXPECT_NE(error().find("no buffer"), std::string::npos);
}

TEST_F(ExceptionGuard, GuardsFunctionsWithoutAResult) {
  guarded<throw_from_procedure>(element, 7);
  EXPECT_NE(error().find("no such index"), std::string::npos);
}

TEST_F(ExceptionGuard, RunsTheActionAfterAnExceptionOnly) {
  EXPECT_EQ((guarded<add, 0, count_call>(element, 1, 1)), 2);
  EXPECT_EQ(g_calls, 0);
  guarded<throw_error, GST_FLOW_ERROR, count_call>(element);
  EXPECT_EQ(g_calls, 1);
}

}  // namespace
}  // namespace mtstereo::test::exception_guard_test
