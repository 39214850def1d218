// SPDX-License-Identifier: LGPL-2.1-or-later
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <new>
#include <sstream>
#include <utility>

#include "geometry/formats/syntax.hpp"

namespace mtstereo::formats {
namespace {

/// What the names of OpenCV's entries consist of.
constexpr std::string_view kNameLetters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.";

/// Builds the tree of one document. An alias becomes a copy of what it refers to; copies count
/// like any value, so that aliases of aliases end in an error.
class YamlHandler : public YAML::EventHandler {
 public:
  explicit YamlHandler(const std::string& file) : builder_(file), file_(file) {}

  Value take() { return builder_.take(); }

  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& /*mark*/, YAML::anchor_t anchor) override { add({}, anchor); }
  void OnScalar(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t anchor,
                const std::string& text) override {
    Value value;
    value.text = text;
    add(std::move(value), anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) {
      throw FileError(file_ + ": line " + std::to_string(mark.line + 1) +
                      ": an alias refers to the list or map that it is in");
    }
    builder_.count(found->second);
    builder_.add(found->second);
  }
  void OnSequenceStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/,
                       YAML::anchor_t anchor, YAML::EmitterStyle::value /*style*/) override {
    begin(Value::Kind::kList, anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    begin(Value::Kind::kMap, anchor);
  }
  void OnMapEnd() override { end(); }

 private:
  void add(Value value, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) anchors_[anchor] = value;
    builder_.add(std::move(value));
  }
  void begin(Value::Kind kind, YAML::anchor_t anchor) {
    builder_.begin(kind);
    open_.push_back(anchor);
  }
  void end() {
    const YAML::anchor_t anchor = open_.back();
    open_.pop_back();
    const bool named = anchor != YAML::NullAnchor;
    Value value = builder_.end(named);
    if (!named) return;
    builder_.count(value);
    anchors_[anchor] = std::move(value);
  }

  TreeBuilder builder_;
  std::string file_;
  std::vector<YAML::anchor_t> open_;
  std::map<YAML::anchor_t, Value> anchors_;
};

/// Adds the blank that YAML needs after the colon of "data:[" or "size:2", which OpenCV does not.
std::string with_separated_values(std::string_view text) {
  std::string separated;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    const std::size_t begin = line.find_first_not_of(' ');
    const std::size_t colon = line.find_first_not_of(kNameLetters, std::min(begin, line.size()));
    const bool glued = colon != std::string_view::npos && colon > begin && line[colon] == ':' &&
                       colon + 1 < line.size() &&
                       kBlanks.find(line[colon + 1]) == std::string_view::npos;
    separated += glued ? line.substr(0, colon + 1) : line;
    if (glued) separated.append(" ").append(line.substr(colon + 1));
  }
  return separated;
}

/// Any text that has no other form is read as YAML.
std::string remedy_of(const std::string& file) {
  if (file.ends_with(".yaml") || file.ends_with(".yml")) return {};
  return "; if it is no YAML, write its matrices to a YAML file with the names M1, D1, M2, D2, R, "
         "T";
}

}  // namespace

std::vector<Value> parse_yaml_documents(const std::string& text, const std::string& file,
                                        std::size_t most) {
  // "%YAML:1.0" is no directive of YAML. A comment in its place keeps the numbers of the lines.
  const bool opencv = text.compare(0, 5, "%YAML") == 0;
  std::string yaml = opencv ? with_separated_values(text) : text;
  if (text.compare(0, 6, "%YAML:") == 0) yaml[0] = '#';
  std::vector<Value> documents;
  try {
    std::istringstream stream(yaml);
    YAML::Parser parser(stream);
    while (documents.size() < most) {
      YamlHandler handler(file);
      if (!parser.HandleNextDocument(handler)) break;
      documents.push_back(handler.take());
    }
  } catch (const FileError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const YAML::Exception& error) {
    throw FileError(file + ": line " + std::to_string(error.mark.line + 1) +
                    " is not valid YAML: " + error.msg + remedy_of(file));
  } catch (const std::exception& error) {
    throw FileError(file + ": is not valid YAML: " + error.what());
  }
  return documents;
}

Value parse_yaml(const std::string& text, const std::string& file, std::size_t number) {
  std::vector<Value> documents = parse_yaml_documents(text, file, number);
  return documents.size() == number ? std::move(documents.back()) : Value();
}

}  // namespace mtstereo::formats
