// SPDX-License-Identifier: LGPL-2.1-or-later
#include "python/keywords.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>
#include <vector>

#include "python/errors.hpp"
#include "python/names.hpp"

namespace py = pybind11;

namespace mtstereo::python {
namespace {

using T = ParameterType;

std::vector<std::string> words_of(const ParameterInfo& info) {
  std::vector<std::string> words;
  std::string_view rest = info.choices;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('|'), rest.size());
    words.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return words;
}

std::string number_text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

/// What Python calls the type of a parameter, and the values that it allows.
std::string type_text(const ParameterInfo& info) {
  switch (info.type) {
    case T::kBoolean:
      return "bool";
    case T::kLevels:
      return "str or sequence of int, such as (1, 0)";
    case T::kChoice: {
      std::string text;
      for (const std::string& word : words_of(info))
        text += (text.empty() ? "'" : ", '") + word + "'";
      return text;
    }
    case T::kInteger:
    case T::kNumber:
      break;
  }
  return std::string(info.type == T::kInteger ? "int" : "float") + ", " +
         number_text(info.minimum) + " to " + number_text(info.maximum) +
         (*info.unit != '\0' ? " " : "") + info.unit;
}

[[noreturn]] void refuse_type(const ParameterInfo& info, py::handle value) {
  throw py::type_error(keyword_of(info) + " = " + std::string(py::repr(value)) + " has the type " +
                       Py_TYPE(value.ptr())->tp_name + ": pass " + type_text(info));
}

[[noreturn]] void refuse_keyword(const std::string& keyword) {
  std::string known;
  for (const ParameterInfo& info : parameter_table()) {
    known += (known.empty() ? "" : ", ") + keyword_of(info);
  }
  throw py::type_error("there is no parameter '" + keyword + "': the parameters are " + known);
}

bool is_bool(py::handle value) {
  return PyBool_Check(value.ptr()) ||
         std::string_view(Py_TYPE(value.ptr())->tp_name) == "numpy.bool_";
}

/// A number; one that no double can hold is infinite, which no parameter allows.
double number_of(py::handle value) {
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() == nullptr) return number;
  if (!PyErr_ExceptionMatches(PyExc_OverflowError)) throw py::error_already_set();
  PyErr_Clear();
  return std::numeric_limits<double>::infinity();
}

std::string levels_of(const ParameterInfo& info, py::handle value) {
  if (!PySequence_Check(value.ptr())) refuse_type(info, value);
  std::string text;
  for (const py::handle& level : py::reinterpret_borrow<py::sequence>(value)) {
    if (!PyIndex_Check(level.ptr()) || is_bool(level)) refuse_type(info, value);
    text += (text.empty() ? "" : ",") + std::string(py::str(level));
  }
  return text;
}

Status set_one(Parameters& parameters, const ParameterInfo& info, py::handle value) {
  const bool text = PyUnicode_Check(value.ptr());
  switch (info.type) {
    case T::kBoolean:
      if (!is_bool(value)) refuse_type(info, value);
      return parameters.set(info.id, PyObject_IsTrue(value.ptr()) == 1 ? 1.0 : 0.0);
    case T::kInteger:
      if (!PyIndex_Check(value.ptr()) || is_bool(value)) refuse_type(info, value);
      return parameters.set(info.id, number_of(value));
    case T::kNumber:
      if (!PyNumber_Check(value.ptr()) || is_bool(value)) refuse_type(info, value);
      return parameters.set(info.id, number_of(value));
    case T::kChoice:
      if (!text) refuse_type(info, value);
      return parameters.set(info.id, std::string(py::str(value)));
    case T::kLevels:
      return parameters.set(info.id, text ? std::string(py::str(value)) : levels_of(info, value));
  }
  refuse_type(info, value);
}

py::object keyword_value(const Parameters& parameters, const ParameterInfo& info) {
  switch (info.type) {
    case T::kBoolean:
      return py::bool_(parameters.integer(info.id) != 0);
    case T::kInteger:
      return py::int_(parameters.integer(info.id));
    case T::kNumber:
      return py::float_(parameters.get(info.id));
    case T::kChoice:
      return py::str(parameters.text(info.id));
    case T::kLevels:
      break;
  }
  const Parameters::Levels levels = parameters.node_levels();
  return py::tuple(
      py::cast(std::vector<int>(levels.level.begin(), levels.level.begin() + levels.count)));
}

std::string type_name(const ParameterInfo& info) {
  constexpr const char* kNames[] = {"int", "float", "bool", "choice", "levels"};
  return kNames[static_cast<int>(info.type)];
}

}  // namespace

void set_parameters(Parameters& parameters, const py::kwargs& keywords) {
  Parameters changed = parameters;
  for (const auto& [key, value] : keywords) {
    const std::string keyword = py::str(key);
    const auto table = parameter_table();
    const auto info = std::find_if(table.begin(), table.end(), [&](const ParameterInfo& row) {
      return keyword_of(row) == keyword;
    });
    if (info == table.end()) refuse_keyword(keyword);
    if (value.is_none()) {
      changed.unset(info->id);
    } else {
      require(set_one(changed, *info, value));
    }
  }
  parameters = changed;
}

py::dict parameter_values(const Parameters& parameters) {
  py::dict values;
  for (const ParameterInfo& info : parameter_table()) {
    values[py::str(keyword_of(info))] = keyword_value(parameters, info);
  }
  return values;
}

std::string keywords_text() {
  std::string text;
  for (const ParameterInfo& info : parameter_table()) {
    text += keyword_of(info) + ": " + type_text(info) + "; default " +
            parameter_defaults_text(info.id) + "\n    " + with_keywords(info.help) + "\n";
    const std::vector<std::string> words = words_of(info);
    for (std::size_t i = 0; i < words.size() && info.choice_help[i] != nullptr; ++i) {
      text += "    - '" + words[i] + "': " + info.choice_help[i] + "\n";
    }
  }
  return text;
}

void bind_parameters(py::module_& module) {
  py::class_<ParameterInfo>(module, "ParameterInfo",
                            "One keyword of Matcher: a row of the library's table.")
      .def_property_readonly("name", &keyword_of, "The keyword.")
      .def_property_readonly("type", &type_name, "'int', 'float', 'bool', 'choice' or 'levels'.")
      .def_readonly("unit", &ParameterInfo::unit, "'px', '%', ... or ''.")
      .def_readonly("minimum", &ParameterInfo::minimum, "Smallest value of an int or float.")
      .def_readonly("maximum", &ParameterInfo::maximum, "Largest value of an int or float.")
      .def_property_readonly("choices", &words_of, "The words of a choice.")
      .def_property_readonly(
          "default", [](const ParameterInfo& info) { return parameter_defaults_text(info.id); },
          "The default, and those of the modes and presets that differ.")
      .def_property_readonly(
          "help", [](const ParameterInfo& info) { return with_keywords(info.help); },
          "What it does, in one line.")
      .def("__repr__", [](const ParameterInfo& info) {
        return "<ParameterInfo " + keyword_of(info) + ": " + type_text(info) + ">";
      });
  module.def(
      "parameter_table",
      [] {
        py::list rows;
        for (const ParameterInfo& info : parameter_table()) rows.append(py::cast(&info));
        return rows;
      },
      "All parameters: a list of ParameterInfo. docs/parameters.md describes how to choose them.");
}

}  // namespace mtstereo::python
