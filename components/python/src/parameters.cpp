// SPDX-License-Identifier: Apache-2.0
#include "parameters.hpp"

#include "arrays.hpp"

namespace panvo::python {
namespace {

std::string text_of(const py::handle& object) { return py::repr(object).cast<std::string>(); }

}  // namespace

ParameterReader::ParameterReader(const py::object& given) {
  if (given.is_none()) return;
  if (!py::isinstance<py::dict>(given)) {
    throw py::type_error(
        fmt::format("parameters: expected a dict of parameter names and values, not {}", type_name(given)));
  }
  given_ = given;
}

py::dict ParameterReader::declare(const std::string& name, const py::object& value, const char* unit,
                                  const char* description) {
  py::dict entry;
  entry["default"] = value;
  entry["unit"] = unit;
  entry["description"] = description;
  declared_[py::str(name)] = entry;
  return entry;
}

py::object ParameterReader::take(const std::string& name) {
  if (!given_.contains(name)) return {};
  return given_[py::str(name)];
}

bool ParameterReader::read_number(const std::string& name, const py::object& given, bool is_whole, double min,
                                  double max, double& value) {
  const bool is_flag = PyBool_Check(given.ptr());
  const bool is_number = !is_flag && (PyIndex_Check(given.ptr()) || (!is_whole && py::hasattr(given, "__float__")));
  if (is_number) value = PyFloat_AsDouble(given.ptr());
  if (PyErr_Occurred()) PyErr_Clear();
  if (is_number && value >= min && value <= max) return true;
  problems_.push_back(fmt::format("{} must be a {}number from {:g} to {:g}, not {}", name, is_whole ? "whole " : "",
                                  min, max, text_of(given)));
  return false;
}

void ParameterReader::read_flag(const std::string& name, const py::object& given, bool& value) {
  if (PyBool_Check(given.ptr())) {
    value = given.cast<bool>();
  } else {
    problems_.push_back(fmt::format("{} must be True or False, not {}", name, text_of(given)));
  }
}

void ParameterReader::read_choice(const std::string& name, const py::object& given, const py::list& choices,
                                  std::string& value) {
  if (py::isinstance<py::str>(given) && choices.contains(given)) {
    value = given.cast<std::string>();
  } else {
    problems_.push_back(fmt::format("{} must be one of {}, not {}", name, text_of(choices), text_of(given)));
  }
}

void ParameterReader::throw_problems() {
  for (const auto& [key, value] : given_) {
    if (!declared_.contains(key)) {
      problems_.push_back(fmt::format("{} is not a parameter; the parameters are {}", text_of(key),
                                      py::str(", ").attr("join")(declared_).cast<std::string>()));
    }
  }
  if (problems_.empty()) return;
  throw py::value_error(fmt::format("parameters: {}", fmt::join(problems_, "\nparameters: ")));
}

}  // namespace panvo::python
