// SPDX-License-Identifier: LGPL-2.1-or-later
#include "python/matcher.hpp"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "mtstereo/matcher.hpp"
#include "python/arrays.hpp"
#include "python/errors.hpp"
#include "python/exclusive.hpp"
#include "python/keywords.hpp"

namespace py = pybind11;

namespace mtstereo::python {
namespace {

/// The maps of one pair, which nothing overwrites.
struct MatchResult {
  py::array_t<float> disparity;
  py::array_t<std::uint8_t> confidence;
  FrameStatistics statistics;
};

constexpr int kCacheLine = 64;                                             // [bytes]
constexpr int kLineValues = kCacheLine / static_cast<int>(sizeof(float));  // of the disparity
constexpr int kFetchedAhead = 16 * kLineValues;

/// Copies disparities as floating point; exact, since a value has less than 24 bits. Written
/// without a choice between floating-point values, so that the compiler makes vectors of it.
inline void write_values(const std::int32_t* values, float added, int count, float* pixels) {
  constexpr auto kUnknown = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN());
  for (int x = 0; x < count; ++x) {
    const float disparity = static_cast<float>(values[x]) * (1.0F / kDisparityOne) + added;
    const std::uint32_t unknown = values[x] == kNoDisparity ? ~std::uint32_t{0} : 0;
    pixels[x] = std::bit_cast<float>((std::bit_cast<std::uint32_t>(disparity) & ~unknown) |
                                     (kUnknown & unknown));
  }
}

/// Copies both maps. Most of its time it waits for memory, so it asks for cache lines ahead of
/// their use, at best 1 KB.
void write_maps(const FrameResult& maps, int offset, ImageView<float> disparity,
                ImageView<std::uint8_t> confidence) {
  const int width = maps.disparity.width;
  const auto added = static_cast<float>(offset);
  for (int y = 0; y < maps.disparity.height; ++y) {
    std::uint8_t* rates = confidence.row(y);
    for (int x = 0; x < width; x += kCacheLine) __builtin_prefetch(rates + x, 1);
    const std::int32_t* values = maps.disparity.row(y);
    float* pixels = disparity.row(y);
    int x = 0;
    for (; x + kLineValues <= width; x += kLineValues) {
      __builtin_prefetch(values + x + kFetchedAhead);
      __builtin_prefetch(pixels + x + kFetchedAhead, 1);
      write_values(values + x, added, kLineValues, pixels + x);
    }
    write_values(values + x, added, width - x, pixels + x);
    std::copy_n(maps.confidence.row(y), width, rates);
  }
}

class PythonMatcher {
 public:
  explicit PythonMatcher(const py::kwargs& keywords) {
    Parameters parameters;
    set_parameters(parameters, keywords);
    matcher_ = std::make_unique<Exclusive<Matcher>>(value_of(Matcher::create(parameters)));
  }

  // The threads of a matcher exist in the process that made it only: waiting for them would not
  // end.
  ~PythonMatcher() {
    if (getpid() != process_) matcher_.release();  // NOLINT(bugprone-unused-return-value)
  }

  MatchResult match(py::handle left, py::handle right) {
    const auto left_view = gray_view("left", left), right_view = gray_view("right", right);
    MatchResult result;
    result.disparity = new_image<float>(left_view.view.height, left_view.view.width);
    result.confidence = new_image<std::uint8_t>(left_view.view.height, left_view.view.width);
    const ImageView<float> disparity = view_of(result.disparity);
    const ImageView<std::uint8_t> confidence = view_of(result.confidence);
    require(own().with([&](Matcher& matcher) -> Status {
      const auto computed = matcher.compute(left_view.view, right_view.view);
      if (!computed) return computed.error();
      write_maps(*computed, matcher.parameters().disparity_offset(), disparity, confidence);
      result.statistics = computed->statistics;
      return {};
    }));
    return result;
  }

  void set(const py::kwargs& keywords) {
    Parameters parameters = this->parameters();
    set_parameters(parameters, keywords);
    require(own().with([&](Matcher& matcher) { return matcher.set_parameters(parameters); }));
  }

  Parameters parameters() {
    return own().with([](const Matcher& matcher) { return matcher.parameters(); });
  }

  void set_correction(const ViewCorrection& correction) {
    require(own().with([&](Matcher& matcher) { return matcher.set_correction(correction); }));
  }

  ViewCorrection correction() {
    return own().with([](const Matcher& matcher) { return matcher.correction(); });
  }

  void restart() {
    own().with([](Matcher& matcher) { matcher.restart(); });
  }

  void forget() {
    own().with([](Matcher& matcher) { matcher.forget(); });
  }

 private:
  Exclusive<Matcher>& own() {
    if (getpid() == process_) return *matcher_;
    throw std::runtime_error(
        "this Matcher was made before the process was forked, and its threads are in the other "
        "one: make a Matcher in each process");
  }

  std::unique_ptr<Exclusive<Matcher>> matcher_;
  pid_t process_ = getpid();
};

constexpr const char* kMatcherText = R"(Finds the disparity of the left image of rectified pairs.

    matcher = mtstereo.Matcher(mode="semi-dense", max_disparity=128)
    result = matcher(left, right)      # or: disparity, confidence = matcher(left, right)

Make one matcher for a stream and use it for all pairs. It has threads of its own (threads=1: none). The GIL is
released while it matches; calls of several threads wait for each other, so give each thread its own matcher.
A value of None is the default. TypeError: there is no such parameter, or its value has another type. ValueError: the
value is not allowed. The message names the parameter and what is allowed.

Parameters
----------
)";

constexpr const char* kCallText = R"(Matches one pair.

left, right: uint8 arrays of shape (height, width), each side 1 to 16384: the gray values of the rectified views. They
are not copied if the pixels of a row are contiguous and rows do not overlap, at any distance of the rows; other strides
are copied. Do not change them during the call.

Returns a MatchResult. TypeError: not an array, or not uint8. ValueError: not (height, width), different sizes, or
parameters that do not fit each other or the size. MemoryError, OSError: no memory, no thread. RuntimeError: the process
was forked after the matcher was made.)";

constexpr const char* kDisparityText =
    R"(float32, (height, width): disparity of the left view [px], NaN = unknown.
The left pixel (x, y) and the right pixel (x - disparity, y) show the same point.)";

constexpr const char* kConfidenceText =
    R"(uint8, (height, width): 1 .. 255, higher is more reliable; 0 = unknown.)";

void bind_result(py::module_& module) {
  py::class_<MatchResult>(
      module, "MatchResult",
      "The maps of one pair. They belong to the caller; (disparity, confidence) if unpacked.")
      .def_readonly("disparity", &MatchResult::disparity, kDisparityText)
      .def_readonly("confidence", &MatchResult::confidence, kConfidenceText)
      .def_property_readonly(
          "milliseconds", [](const MatchResult& result) { return result.statistics.milliseconds; },
          "Time of the matching [ms].")
      .def_property_readonly(
          "density", [](const MatchResult& result) { return result.statistics.density; },
          "Fraction of the pixels with a disparity, 0 .. 1.")
      .def_property_readonly(
          "half_resolution",
          [](const MatchResult& result) { return result.statistics.half_resolution; },
          "True if the views were matched at half resolution.")
      .def_property_readonly(
          "fine_detail", [](const MatchResult& result) { return result.statistics.fine_detail; },
          "With resolution='auto', the detail that both views have at full resolution: less than "
          "0.08 is soft; "
          "0 = not measured.")
      .def("__iter__", [](const MatchResult& result) {
        return py::iter(py::make_tuple(result.disparity, result.confidence));
      });
}

}  // namespace

void bind_matcher(py::module_& module) {
  bind_result(module);
  // pybind11 keeps no copy of the text of a class.
  static const std::string text = kMatcherText + keywords_text();
  py::class_<PythonMatcher>(module, "Matcher", text.c_str())
      .def(py::init<const py::kwargs&>())
      .def("__call__", &PythonMatcher::match, py::arg("left"), py::arg("right"), kCallText)
      .def("set", &PythonMatcher::set,
           "Sets parameters for the next pairs, by the keywords of Matcher(); all or, if one is "
           "refused, none.")
      .def_property_readonly(
          "parameters",
          [](PythonMatcher& matcher) { return parameter_values(matcher.parameters()); },
          "The values in effect, by keyword: those that were set, and the defaults of preset and "
          "mode.")
      .def_property("correction", &PythonMatcher::correction, &PythonMatcher::set_correction,
                    "The ViewCorrection of the next pairs; see Alignment.correction.")
      .def("restart", &PythonMatcher::restart,
           "Begins anew, as for another stream or after a seek: forgets the pairs, and with "
           "resolution='auto' "
           "matches the next one at full resolution.")
      .def("forget", &PythonMatcher::forget,
           "Forgets the pairs that temporal='hold' or 'filter' compares the next one with, as "
           "after a gap.");
}

}  // namespace mtstereo::python
