// SPDX-License-Identifier: LGPL-2.1-or-later
// The matcher with any parameters, sizes, strides and images. The library must reject what it
// cannot match, and keep what its headers promise about every map.
#include <cmath>
#include <vector>

#include "fuzz_image.hpp"
#include "mtstereo/mtstereo.hpp"

namespace mtstereo::fuzz {
namespace {

/// Sets up to eight parameters. Costs that depend on the parameters stay small.
Parameters parameters_of(FuzzInput& input) {
  Parameters parameters;
  const auto table = parameter_table();
  for (int count = input.byte() % 9; count > 0; --count) {
    const ParameterInfo& info = table[input.byte() % table.size()];
    if (info.id == Parameter::kThreads) continue;
    if (info.type == ParameterType::kLevels) {
      constexpr std::array kLevels = {"0", "1,0", "2,0", "5,3,0", "9,0", "7,6,5,4,3,2,1,0"};
      (void)parameters.set(info.id, std::string_view(input.one_of(kLevels)));
      continue;
    }
    const double most = info.type == ParameterType::kBoolean ? 1 : info.maximum;
    const double share = static_cast<double>(input.bits(2)) / 65535;
    const double value = info.minimum + share * share * (most - info.minimum);
    const bool whole = info.type != ParameterType::kNumber;
    // A value that is not allowed, such as an even kernel, is rejected.
    (void)parameters.set(info.id, whole ? std::round(value) : value);
  }
  return parameters;
}

ViewCorrection correction_of(FuzzInput& input) {
  ViewCorrection correction;
  if (input.byte() % 4 != 0) return correction;
  const auto term = [&] { return (input.byte() - 128) / (input.flag() ? 1.25 : 64.0); };
  correction.rows = {term(), term(), term(), term(), term()};
  correction.left_blur = static_cast<float>(input.byte() % 4) * 0.9F;
  correction.right_blur = static_cast<float>(input.byte() % 4) * 0.9F;
  return correction;
}

void check_map(const DisparityView& map, const GrayView& confidence, const Parameters& parameters) {
  require(confidence.width == map.width && confidence.height == map.height,
          "the confidence has the size of the map");
  const int end = (parameters.integer(Parameter::kMaxDisparity) - parameters.disparity_offset()) *
                  kDisparityOne;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const std::int32_t value = map.row(y)[x];
      require(value == kNoDisparity || value < end, "a disparity is below max-disparity");
      require((value == kNoDisparity) == (confidence.row(y)[x] == 0),
              "the confidence is 0 exactly where there is no disparity");
    }
  }
}

struct Maps {
  std::vector<std::int32_t> disparity;
  std::vector<std::uint8_t> confidence;
  friend bool operator==(const Maps&, const Maps&) = default;
};

Maps copy_of(const DisparityView& map, const GrayView& confidence) {
  Maps maps;
  for (int y = 0; y < map.height; ++y) {
    maps.disparity.insert(maps.disparity.end(), map.row(y), map.row(y) + map.width);
    maps.confidence.insert(maps.confidence.end(), confidence.row(y), confidence.row(y) + map.width);
  }
  return maps;
}

/// Converts the map at some scale, into memory of exactly its size.
void check_scaled(const DisparityView& map, const Parameters& parameters, int scale) {
  std::vector<std::uint16_t> memory(static_cast<std::size_t>(map.width) *
                                    static_cast<std::size_t>(map.height));
  const ImageView<std::uint16_t> out{
      memory.data(), map.width, map.height,
      static_cast<std::ptrdiff_t>(sizeof(std::uint16_t)) * map.width};
  require(write_disparity16(map, scale, out).ok(), "a map can be converted at every scale");
  const bool fits = parameters.check_scale16(scale).ok();
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const std::int32_t value = map.row(y)[x];
      require((value == kNoDisparity) == (out.row(y)[x] == 0), "0 stands for no disparity only");
      if (value == kNoDisparity || !fits) continue;
      const double wanted = static_cast<double>(value) * scale / kDisparityOne;
      require(std::abs(out.row(y)[x] - wanted) <= 1, "a converted disparity is the rounded one");
    }
  }
}

/// Matches with a number of threads; no maps if the library rejects the frame.
Maps match(Matcher& matcher, Parameters parameters, int threads, GrayView left, GrayView right,
           int scale) {
  require(parameters.set(Parameter::kThreads, threads).ok(), "a number of threads can be set");
  require(matcher.set_parameters(parameters).ok(), "parameters can be set");
  const Result<FrameResult> result = matcher.compute(left, right);
  const bool fits = parameters.check_frame(left.width, left.height).ok();
  require(result.ok() == fits, "check_frame() predicts whether a frame is matched");
  if (!result) {
    require(!result.error().message.empty(), "an error has a message");
    return {};
  }
  const auto& [map, confidence, statistics] = *result;
  require(map.width == left.width && map.height == left.height, "the map has the frame's size");
  check_map(map, confidence, parameters);
  check_scaled(map, parameters, scale);
  return copy_of(map, confidence);
}

Matcher new_matcher(int threads) {
  Parameters parameters;
  require(parameters.set(Parameter::kThreads, threads).ok(), "a number of threads can be set");
  Result<Matcher> made = Matcher::create(parameters);
  require(made.ok(), "a matcher can be created");
  return std::move(made.value());
}

void set_correction(Matcher& matcher, const ViewCorrection& correction) {
  const RowField& rows = correction.rows;
  bool in_range = true;
  for (const double term : {rows.offset, rows.roll, rows.stretch, rows.product, rows.square}) {
    in_range = in_range && std::abs(term) <= kLargestFieldTerm;
  }
  require(matcher.set_correction(correction).ok() == in_range,
          "a correction is accepted if its terms are in range");
}

/// One frame, by a matcher that may have matched another one before, and by a new one with three
/// threads.
void match_frame(Matcher& used, FuzzInput& input) {
  const Parameters parameters = parameters_of(input);
  const ViewCorrection correction = correction_of(input);
  const int width = input.between(1, 80);
  const int height = input.between(1, 24);
  FuzzImage left(width, height, input.byte() % 40, input.byte() % 9);
  FuzzImage right(width, height, input.byte() % 40, input.byte() % 9);
  const int scale = input.between(1, 65535);
  const int shift = input.between(0, 40);
  const bool related = input.flag();
  left.paint(input);
  if (related) {
    right.copy_moved(left, shift, 0);
    right.disturb(input);
  } else {
    right.paint(input);
  }
  Matcher fresh = new_matcher(3);
  set_correction(used, {});  // a rejected correction keeps the one before
  set_correction(used, correction);
  set_correction(fresh, correction);
  const Maps one = match(used, parameters, 1, left.view(), right.view(), scale);
  const Maps three = match(fresh, parameters, 3, left.view(), right.view(), scale);
  require(one == three, "the result does not depend on threads and earlier frames");
  if (width == 1 || height == 1) return;  // the stride of a single row does not matter
  GrayView wrong = right.view();
  wrong.stride = width - 1;
  require(!used.compute(left.view(), wrong).ok(), "a stride below the width is rejected");
}

}  // namespace
}  // namespace mtstereo::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) { return 0; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mtstereo;
  fuzz::FuzzInput input(data, size);
  Matcher matcher = fuzz::new_matcher(1);
  fuzz::match_frame(matcher, input);
  if (!input.empty()) fuzz::match_frame(matcher, input);
  return 0;
}
