// SPDX-License-Identifier: LGPL-2.1-or-later
// The parsers of text: values of parameters, row fields, and degradations of mtstereo-eval. The
// first byte selects the parser, the rest is the text.
#include <string>

#include "fuzz_image.hpp"
#include "lib/outputs/user_error.hpp"
#include "mtstereo/mtstereo.hpp"
#include "tools/eval/datasets.hpp"
#include "tools/eval/degrade.hpp"

namespace mtstereo::fuzz {
namespace {

/// A value that was accepted is equal after it was read as text and set again.
void check_value(const Parameters& parameters, Parameter id) {
  const std::string text = parameters.text(id);
  Parameters again = parameters;
  require(again.set(id, text).ok(), "the text of a value can be set");
  require(again.text(id) == text, "a value is equal after it was set from its text");
  const ParameterInfo& info = parameter_info(id);
  if (info.type == ParameterType::kInteger || info.type == ParameterType::kNumber) {
    const double value = parameters.get(id);
    require(value >= info.minimum && value <= info.maximum, "an accepted value is in range");
  }
}

/// Lines of NAME=VALUE, as on a command line.
void parse_parameters(FuzzInput& input) {
  Parameters parameters;
  while (!input.empty()) {
    const std::string_view line = input.line();
    const std::size_t equals = std::min(line.find('='), line.size());
    const std::string_view name = line.substr(0, equals);
    const std::string_view value = line.substr(std::min(equals + 1, line.size()));
    const ParameterInfo* info = find_parameter(name);
    const std::string before = info != nullptr ? parameters.text(info->id) : "";
    const Status status = parameters.set(name, value);
    require(info != nullptr || !status, "an unknown name is rejected");
    if (!status) {
      require(status.error().code == ErrorCode::kInvalidParameter, "the error is of a parameter");
      require(!status.error().message.empty(), "an error has a message");
      if (info != nullptr) require(parameters.text(info->id) == before, "the value is unchanged");
      continue;
    }
    check_value(parameters, info->id);
  }
  for (const int side : {1, 2, 7, 640, kLargestImageSide}) {
    const Status status = parameters.check_frame(side, side);
    require(status.ok() || !status.error().message.empty(), "an error has a message");
  }
  for (const int scale : {-1, 0, 1, 256, 65535}) {
    const Status status = parameters.check_scale16(scale);
    require(status.ok() || !status.error().message.empty(), "an error has a message");
  }
}

void parse_field(FuzzInput& input) {
  const Result<RowField> field = RowField::parse(input.rest());
  if (!field) {
    require(!field.error().message.empty(), "an error has a message");
    return;
  }
  const Result<RowField> again = RowField::parse(field->to_text());
  require(again.ok() && *again == *field, "a field is equal after it was stored as text");
  const double largest = field->largest(64, 48);
  require(largest >= 0 && largest <= 5 * kLargestFieldTerm, "the largest displacement is a number");
  require(field->rms(64, 48) <= largest + 1e-6, "the mean is not larger than the largest");
}

/// Applies a degradation that was accepted, to views of any size. H.264 takes too long.
void apply(const eval::Degradation& degradation, FuzzInput& input) {
  if (degradation.kind == eval::DegradationKind::kH264 ||
      degradation.kind == eval::DegradationKind::kCamH264) {
    return;
  }
  const int width = input.between(1, 40);
  const cv::Mat view(input.between(1, 30), width, CV_8UC1, cv::Scalar(input.byte()));
  const eval::LoadedPair pair{view, view, {cv::Mat(view.size(), CV_32FC1, cv::Scalar(1)), {}}};
  const auto [images, max_disparity] = eval::degrade(degradation, pair, width);
  const cv::Size size = images.truth.disparity.size();
  require(size.width >= width && max_disparity >= width, "truth and range are not smaller");
  require(images.left.type() == CV_8UC1 && images.left.size() == size,
          "the left view is gray and has the size of the truth");
  require(images.right.type() == CV_8UC1 && images.right.size() == size,
          "the right view is gray and has the size of the truth");
}

void parse_degradation(FuzzInput& input) {
  const std::string_view text = input.line();
  try {
    const eval::Degradation degradation = eval::parse_degradation(text);
    const eval::Degradation again = eval::parse_degradation(eval::degradation_text(degradation));
    require(again.kind == degradation.kind, "a degradation is equal after it was written as text");
    apply(degradation, input);
  } catch (const mtstereo::UserError& error) {
    require(error.what()[0] != '\0', "an error has a message");
  }
}

void parse_layout(FuzzInput& input) {
  const std::string_view text = input.rest();
  const auto layout = eval::find_layout(text);
  if (layout) require(eval::layout_name(*layout) == text, "a layout has the name it is found by");
}

}  // namespace
}  // namespace mtstereo::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) { return 0; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mtstereo::fuzz;
  constexpr std::array kParsers = {parse_parameters, parse_field, parse_degradation, parse_layout};
  FuzzInput input(data, size);
  input.one_of(kParsers)(input);
  return 0;
}
