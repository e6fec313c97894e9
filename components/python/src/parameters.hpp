// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

namespace panvo::python {

namespace py = pybind11;

/// Reads the parameter structs of the algorithms, with their declared ranges, from a dictionary of names as in
/// `panvo component show`: {"tracking.max_features": 500}.
class ParameterReader {
 public:
  /// `given`: a dict, or None for the defaults. Throws TypeError for anything else.
  explicit ParameterReader(const py::object& given);

  /// The struct with the given values. Throws ValueError with all problems: unknown names, wrong types and ranges,
  /// contradictions.
  template <class Parameters>
  Parameters read() {
    Parameters parameters{};
    Parameters::describe(Field<Parameters>{*this, parameters, ""});
    add_conflicts(parameters, "");
    throw_problems();
    return parameters;
  }

  /// Declaration of each parameter: {"name": {"default": 300, "unit": "1", "min": 50, "max": 5000, "description": ...}}.
  template <class Parameters>
  static py::dict describe() {
    ParameterReader reader{py::none()};
    reader.read<Parameters>();
    return reader.declared_;
  }

 private:
  template <class Parameters>
  struct Field {
    ParameterReader& reader;
    Parameters& parameters;
    std::string prefix;

    template <class Value>
    requires std::is_arithmetic_v<Value>
    void operator()(Value Parameters::*member, const char* name, const char* unit, const char* description, double min,
                    double max) {
      auto& value = parameters.*member;
      py::dict entry = reader.declare(prefix + name, py::cast(value), unit, description);
      entry["min"] = py::cast(static_cast<Value>(min));
      entry["max"] = py::cast(static_cast<Value>(max));
      if (const auto given = reader.take(prefix + name)) {
        double number = 0.0;
        if (reader.read_number(prefix + name, given, std::is_integral_v<Value>, min, max, number)) {
          value = static_cast<Value>(number);
        }
      }
    }
    void operator()(bool Parameters::*member, const char* name, const char* unit, const char* description) {
      reader.declare(prefix + name, py::cast(parameters.*member), unit, description);
      if (const auto given = reader.take(prefix + name)) reader.read_flag(prefix + name, given, parameters.*member);
    }
    void operator()(std::string Parameters::*member, const char* name, const char* unit, const char* description,
                    std::initializer_list<const char*> choices) {
      py::dict entry = reader.declare(prefix + name, py::cast(parameters.*member), unit, description);
      py::list names;
      for (const char* choice : choices) names.append(choice);
      entry["choices"] = names;
      if (const auto given = reader.take(prefix + name)) {
        reader.read_choice(prefix + name, given, names, parameters.*member);
      }
    }
    template <class Nested>
    void group(Nested Parameters::*member, const char* name) {
      Nested::describe(Field<Nested>{reader, parameters.*member, prefix + name + "."});
      reader.add_conflicts(parameters.*member, prefix + name + ".");
    }
  };

  template <class Parameters>
  void add_conflicts(const Parameters& parameters, const std::string& prefix) {
    const auto add = [&](const char* first, const char* rule, const char* second) {
      problems_.push_back(fmt::format("{}{} {} {}{}", prefix, first, rule, prefix, second));
    };
    if constexpr (requires { parameters.find_conflicts(add); }) parameters.find_conflicts(add);
  }

  py::dict declare(const std::string& name, const py::object& value, const char* unit, const char* description);
  /// The given value of a parameter; null without one.
  py::object take(const std::string& name);
  bool read_number(const std::string& name, const py::object& given, bool is_whole, double min, double max,
                   double& value);
  void read_flag(const std::string& name, const py::object& given, bool& value);
  void read_choice(const std::string& name, const py::object& given, const py::list& choices, std::string& value);
  void throw_problems();

  py::dict given_;
  py::dict declared_;
  std::vector<std::string> problems_;
};

}  // namespace panvo::python
