// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/problems.hpp"

namespace panvo::runtime {

/// A value as it was written, not yet of a type: one scalar, or a list of them.
struct WrittenValue {
  std::vector<std::string> items;
  bool is_list = false;
  Location where;
};

/// What a configuration says to one component: parameter name ("tracker.max_features") to value.
using WrittenValues = std::map<std::string, WrittenValue>;

/// A parameter as it is declared, for reading, checking and `--help`.
struct ParameterDescription {
  std::string name;
  std::string type;  ///< "bool", "integer", "number", "text", "numbers", "texts"
  std::string unit;  ///< "px", "m", "1" ...
  std::string description;
  std::string default_value;
  std::string value;  ///< in force
  std::optional<double> min, max;
  std::vector<std::string> choices;
  WrittenValue written;   ///< the value in force as it could have been written, a list's items apart
  bool settable = false;  ///< while the component runs, see Context::on_parameters
  bool is_path = false;   ///< names a file or folder
};

/// Parses one written value as the declared type, all of it and whatever the locale. On failure leaves `out`
/// as it is and returns what is wrong ("is not a whole number"). Numbers are finite; a whole number is a
/// number, 7.0 no whole number.
std::optional<std::string> parse(const WrittenValue& written, bool& out);
std::optional<std::string> parse(const WrittenValue& written, std::int64_t& out);
std::optional<std::string> parse(const WrittenValue& written, double& out);
std::optional<std::string> parse(const WrittenValue& written, std::string& out);
std::optional<std::string> parse(const WrittenValue& written, std::vector<double>& out);
std::optional<std::string> parse(const WrittenValue& written, std::vector<std::string>& out);

/// A value as it could have been written; parse() gives the same value back, numbers to the last bit.
std::string to_text(bool value);
std::string to_text(std::int64_t value);
std::string to_text(double value);
std::string to_text(const std::string& value);
std::string to_text(const char*) = delete;  // would be taken for a bool
std::string to_text(const std::vector<double>& value);
std::string to_text(const std::vector<std::string>& value);

/// Reads plain parameter structs from written values, and remembers what was declared and what was wrong.
/// A struct declares its fields in `template <class Field> static void describe(Field&& field)`, by calls of
///   field(&P::member, "name", "unit", "description", min, max)   for numbers,
///   field(&P::member, "name", "unit", "description")             for bool, text and lists,
///   field(&P::member, "name", "unit", "description", {"a","b"})  for a choice,
///   field.path(&P::member, "name", "description")                for text that names a file or folder,
///   field.group(&P::member, "name")                              for a nested struct.
///
/// Which fields contradict each other it may say in `template <class Conflict> void find_conflicts(Conflict&& conflict) const`, by calls of
///   conflict("first", "must be less than", "second").
class ParameterReader {
 public:
  /// `owner` names the component in messages ("binocular_odometry").
  ParameterReader(std::string owner, WrittenValues written) : owner_(std::move(owner)), written_(std::move(written)) {}

  /// The struct with its defaults overridden by what was written. Problems are remembered, see problems().
  template <class Parameters>
  Parameters read() {
    Parameters parameters{};
    Parameters::describe(Field<Parameters>{*this, parameters, ""});
    add_conflicts(parameters, "");
    return parameters;
  }

  /// From now on, what is written may name files and folders below this one only; empty: none. For what comes from other processes.
  void confine_paths(std::filesystem::path folder) { paths_below_ = std::move(folder); }

  /// In order of declaration, each name once.
  const std::vector<ParameterDescription>& declared() const noexcept { return declared_; }

  /// Every bad value, and every written key that no read() declared (with the nearest declared name), each
  /// with file and line, in order of line. To be called when the component has been constructed, so that all
  /// it declares is known.
  std::vector<std::string> problems() const;

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
      using Wide = std::conditional_t<std::is_integral_v<Value>, std::int64_t, double>;
      Wide value = parameters.*member;
      reader.read_number(prefix + name, unit, description, min, max, value);
      parameters.*member = static_cast<Value>(value);
    }
    template <class Value>
    void operator()(Value Parameters::*member, const char* name, const char* unit, const char* description) {
      reader.read_value(prefix + name, unit, description, parameters.*member);
    }
    void operator()(std::string Parameters::*member, const char* name, const char* unit, const char* description,
                    std::initializer_list<const char*> choices) {
      reader.read_choice(prefix + name, unit, description, choices, parameters.*member);
    }
    void path(std::string Parameters::*member, const char* name, const char* description) {
      reader.read_path(prefix + name, description, parameters.*member);
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
      add_conflict(prefix + first, rule, prefix + second);
    };
    if constexpr (requires { parameters.find_conflicts(add); }) parameters.find_conflicts(add);
  }
  void add_conflict(const std::string& first, const char* rule, const std::string& second);

  void read_number(const std::string& name, const char* unit, const char* description, double min, double max,
                   std::int64_t& value);
  void read_number(const std::string& name, const char* unit, const char* description, double min, double max,
                   double& value);
  void read_value(const std::string& name, const char* unit, const char* description, bool& value);
  void read_value(const std::string& name, const char* unit, const char* description, std::string& value);
  void read_value(const std::string& name, const char* unit, const char* description, std::vector<double>& value);
  void read_value(const std::string& name, const char* unit, const char* description, std::vector<std::string>& value);
  void read_choice(const std::string& name, const char* unit, const char* description,
                   std::initializer_list<const char*> choices, std::string& value);

  void read_path(const std::string& name, const char* description, std::string& value);

  /// Overrides `value` with what was written, if it is right, and remembers the declaration.
  template <class Value>
  void declare(ParameterDescription description, Value& value);

  std::string owner_;
  WrittenValues written_;
  std::vector<ParameterDescription> declared_;
  Problems problems_;
  std::optional<std::filesystem::path> paths_below_;
};

}  // namespace panvo::runtime
