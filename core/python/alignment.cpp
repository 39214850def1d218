// SPDX-License-Identifier: LGPL-2.1-or-later
#include "python/alignment.hpp"

#include <string_view>

#include "mtstereo/alignment.hpp"
#include "python/arrays.hpp"
#include "python/errors.hpp"
#include "python/exclusive.hpp"

namespace py = pybind11;

namespace mtstereo::python {
namespace {

class Alignment {
 public:
  Alignment() : tracker_(value_of(AlignmentTracker::create())) {}

  void watch(py::handle left, py::handle right) {
    const auto left_view = gray_view("left", left), right_view = gray_view("right", right);
    require(tracker_.with(
        [&](AlignmentTracker& tracker) { return tracker.watch(left_view.view, right_view.view); }));
  }

  PairFindings inspect(py::handle left, py::handle right, int max_disparity, int min_disparity) {
    const auto left_view = gray_view("left", left), right_view = gray_view("right", right);
    PairFindings findings;
    require(tracker_.with([&](AlignmentTracker& tracker) {
      Status status =
          tracker.inspect(left_view.view, right_view.view, max_disparity, min_disparity);
      findings = tracker.findings();
      return status;
    }));
    return findings;
  }

  ViewCorrection correction() {
    return tracker_.with([](const AlignmentTracker& tracker) { return tracker.correction(); });
  }

  bool trusted() {
    return tracker_.with([](const AlignmentTracker& tracker) { return tracker.trusted(); });
  }

  int views() {
    return tracker_.with([](const AlignmentTracker& tracker) { return tracker.views(); });
  }

  py::dict problems() {
    std::array<bool, kPairProblems> has{};
    tracker_.with([&](const AlignmentTracker& tracker) {
      for (int i = 0; i < kPairProblems; ++i) has[i] = tracker.has(static_cast<PairProblem>(i));
    });
    py::dict problems;
    for (int i = 0; i < kPairProblems; ++i) {
      const auto problem = static_cast<PairProblem>(i);
      if (has[i]) problems[problem_name(problem)] = problem_text(problem);
    }
    return problems;
  }

  void restore(const RowField& field) {
    require(tracker_.with([&](AlignmentTracker& tracker) { return tracker.restore(field); }));
  }

  void reset() {
    tracker_.with([](AlignmentTracker& tracker) { tracker.reset(); });
  }

 private:
  Exclusive<AlignmentTracker> tracker_;
};

void bind_corrections(py::module_& module) {
  py::class_<RowField>(module, "RowField",
                       "Row displacement of the right view. Terms in px, as the library's "
                       "RowField; docs/alignment.md "
                       "describes them. str() gives a text that parse() reads.")
      .def(py::init([](double offset, double roll, double stretch, double product, double square) {
             return RowField{offset, roll, stretch, product, square};
           }),
           py::arg("offset") = 0, py::arg("roll") = 0, py::arg("stretch") = 0,
           py::arg("product") = 0, py::arg("square") = 0)
      .def_static(
          "parse", [](std::string_view text) { return value_of(RowField::parse(text)); },
          py::arg("text"),
          "The field of a text that str() gave. ValueError: not five numbers within 100 px.")
      .def_readwrite("offset", &RowField::offset, "Everywhere the same [px].")
      .def_readwrite("roll", &RowField::roll, "Times u [px]; u = -1 .. 1 from left to right.")
      .def_readwrite("stretch", &RowField::stretch, "Times v [px]; v downwards, in the unit of u.")
      .def_readwrite("product", &RowField::product, "Times u v [px].")
      .def_readwrite("square", &RowField::square, "Times v v [px].")
      .def("largest", &RowField::largest, py::arg("width"), py::arg("height"),
           "Largest displacement in an image of this size [px].")
      .def("rms", &RowField::rms, py::arg("width"), py::arg("height"),
           "Root mean square of the displacement over an image of this size [px].")
      .def("__eq__", [](const RowField& a, const RowField& b) { return a == b; })
      .def("__str__", &RowField::to_text)
      .def("__repr__", [](const RowField& field) { return "<RowField " + field.to_text() + ">"; });
  py::class_<ViewCorrection>(module, "ViewCorrection",
                             "What a Matcher does to the views before it matches them.")
      .def(py::init([](const RowField& rows, float left_blur, float right_blur) {
             return ViewCorrection{rows, left_blur, right_blur};
           }),
           py::arg("rows") = RowField{}, py::arg("left_blur") = 0, py::arg("right_blur") = 0)
      .def_readwrite("rows", &ViewCorrection::rows,
                     "The rows of the right view are moved by this RowField.")
      .def_readwrite("left_blur", &ViewCorrection::left_blur,
                     "Sigma of the blur of the left view [px], 0 .. 3.")
      .def_readwrite("right_blur", &ViewCorrection::right_blur,
                     "Sigma of the blur of the right view [px], 0 .. 3.")
      .def("__eq__", [](const ViewCorrection& a, const ViewCorrection& b) { return a == b; });
}

void bind_findings(py::module_& module) {
  py::class_<PairFindings>(module, "PairFindings", "The result of the inspection of one pair.")
      .def_property_readonly(
          "trusted",
          [](const PairFindings& found) { return found.status == FieldStatus::kTrusted; },
          "True if `field` can be trusted.")
      .def_property_readonly(
          "status", [](const PairFindings& found) { return field_status_text(found.status); },
          "Whether `field` can be trusted, or why not, in words.")
      .def_readonly("matches", &PairFindings::matches,
                    "Corners of the left view that were found in the right one.")
      .def_readonly("inliers", &PairFindings::inliers,
                    "Matches that agree with the field within 1 px.")
      .def_readonly("residual", &PairFindings::residual,
                    "Standard deviation of the inliers about the field [px].")
      .def_readonly("field", &PairFindings::field, "The RowField of the pair; 0 without trust.")
      .def_readonly("deviation", &PairFindings::deviation,
                    "Predicted standard deviation of the field [px].")
      .def_readonly("sharpness_ratio", &PairFindings::sharpness_ratio,
                    "Sharpness of the left view divided by that of the right one; 0 = unknown.");
}

}  // namespace

void bind_alignment(py::module_& module) {
  bind_corrections(module);
  bind_findings(module);
  py::class_<Alignment>(
      module, "Alignment",
      R"(Finds the rows and the sharpness of the views, and what is wrong with the streams.

Call watch() for every pair and inspect() for the first and then for example every 30th, with the views as they come,
and give the correction to the matcher: matcher.correction = alignment.correction. The element mtstereo does this by
itself; a Matcher leaves the views unchanged.)")
      .def(py::init<>())
      .def("watch", &Alignment::watch, py::arg("left"), py::arg("right"),
           "Checks a pair for blank and frozen views. Arrays and errors as for Matcher.")
      .def("inspect", &Alignment::inspect, py::arg("left"), py::arg("right"),
           py::arg("max_disparity"), py::arg("min_disparity") = 0,
           "Estimates the row field of a pair, updates the correction, and returns PairFindings. "
           "The disparities "
           "min_disparity .. max_disparity [px] are searched. Arrays and errors as for Matcher.")
      .def_property_readonly("correction", &Alignment::correction,
                             "The ViewCorrection for the next pairs.")
      .def_property_readonly("trusted", &Alignment::trusted,
                             "True if the rows of the correction are confirmed.")
      .def_property_readonly("views", &Alignment::views,
                             "Number of scenes that the correction is made of.")
      .def_property_readonly(
          "problems", &Alignment::problems,
          "What is wrong with the streams now: {name: what was found and what to do}.")
      .def("restore", &Alignment::restore, py::arg("field"),
           "Starts with a RowField of an earlier run.")
      .def("reset", &Alignment::reset, "Forgets everything, as for another camera.");
}

}  // namespace mtstereo::python
