// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "support/harness.hpp"

namespace mtstereo::fuzz {

using test::BufferPointer;
using test::CapsPointer;
using test::EventPointer;
using test::MessagePointer;

/// An element with a bus. Errors that it posts must state a cause.
class TestedElement {
 public:
  explicit TestedElement(const char* factory);
  ~TestedElement();
  TestedElement(const TestedElement&) = delete;
  TestedElement& operator=(const TestedElement&) = delete;

  GstElement* get() const { return element_; }
  /// Takes all messages from the bus. True if an error was among the messages so far.
  bool has_failed();

 private:
  GstElement* element_;
  GstBus* bus_;
  bool failed_ = false;
};

/// The caps of a text; nullptr if the text is none.
CapsPointer parsed_caps(const std::string& text);

/// The caps of a text, with every field fixed; nullptr if the text is none, or if frames of these
/// caps would be large.
CapsPointer fixed_caps(const std::string& text);

/// A buffer of this size, filled with a pattern of `seed`.
GstBuffer* pattern_buffer(std::size_t size, unsigned seed);

}  // namespace mtstereo::fuzz
