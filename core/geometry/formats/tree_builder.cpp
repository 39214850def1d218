// SPDX-License-Identifier: LGPL-2.1-or-later
#include <utility>

#include "geometry/formats/syntax.hpp"

namespace mtstereo::formats {

void TreeBuilder::count_one(std::size_t cost) {
  values_ += cost;
  if (values_ > kMostValues) {
    throw FileError(file_ + ": there are more than " + std::to_string(kMostValues) +
                    " values, which no calibration has");
  }
}

void TreeBuilder::count(const Value& value) {
  constexpr std::size_t kBytesOfOneValue = 64;
  count_one(1 + value.text.size() / kBytesOfOneValue);
  for (const std::string& name : value.names) count_one(name.size() / kBytesOfOneValue);
  for (const Value& item : value.items) count(item);
}

void TreeBuilder::add(Value value) {
  count_one();
  if (open_.empty()) {
    root_ = std::move(value);
    return;
  }
  Level& top = open_.back();
  if (top.value.kind == Value::Kind::kMap && !top.has_name) {
    if (value.kind != Value::Kind::kScalar) {
      throw FileError(file_ + ": the name of an entry is a list or a map, a text is needed");
    }
    top.value.names.push_back(std::move(value.text));
    top.has_name = true;
    return;
  }
  top.value.items.push_back(std::move(value));
  top.has_name = false;
}

void TreeBuilder::add_text(std::string text) {
  Value value;
  value.text = std::move(text);
  add(std::move(value));
}

void TreeBuilder::begin(Value::Kind kind) {
  if (open_.size() >= kDeepestNesting) {
    throw FileError(file_ + ": lists and maps are nested more than " +
                    std::to_string(kDeepestNesting) + " times, which no calibration has");
  }
  open_.push_back({});
  open_.back().value.kind = kind;
}

Value TreeBuilder::end(bool copy) {
  Value value = std::move(open_.back().value);
  open_.pop_back();
  Value result;
  if (copy) result = value;
  add(std::move(value));
  return result;
}

}  // namespace mtstereo::formats
