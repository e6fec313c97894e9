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

/// A configured value before type conversion: one scalar or a list of scalars.
struct WrittenValue {
  std::vector<std::string> items;
  bool is_list = false;
  Location where;
  bool is_for_several = false;  ///< given for several nodes at once ("/**"): those without such a parameter ignore it
};

/// Configured values of one component: parameter name ("tracker.max_features") to value.
using WrittenValues = std::map<std::string, WrittenValue>;

/// Declaration and current value of a parameter.
struct ParameterDescription {
  std::string name;
  std::string type;  ///< "bool", "integer", "number", "text", "numbers", "texts"
  std::string unit;  ///< "px", "m", "1" ...
  std::string description;
  std::string default_value;
  std::string value;  ///< current value
  std::optional<double> min, max;
  std::vector<std::string> choices;
  WrittenValue written;   ///< current value in configuration form, list items separated
  bool settable = false;  ///< at run time, see Context::on_parameters
  bool is_path = false;   ///< names a file or folder
};

/// Parses a configured value as the declared type, completely and independently of the locale. On failure, returns the
/// problem ("is not a whole number") and leaves `out` unchanged. Numbers must be finite. A whole number is a valid
/// number; 7.0 is not a valid whole number.
std::optional<std::string> parse(const WrittenValue& written, bool& out);
std::optional<std::string> parse(const WrittenValue& written, std::int64_t& out);
std::optional<std::string> parse(const WrittenValue& written, double& out);
std::optional<std::string> parse(const WrittenValue& written, std::string& out);
std::optional<std::string> parse(const WrittenValue& written, std::vector<double>& out);
std::optional<std::string> parse(const WrittenValue& written, std::vector<std::string>& out);

/// Formats a value for a configuration; parse() restores it exactly.
std::string to_text(bool value);
std::string to_text(std::int64_t value);
std::string to_text(double value);
std::string to_text(const std::string& value);
std::string to_text(const char*) = delete;  // would convert to bool
std::string to_text(const std::vector<double>& value);
std::string to_text(const std::vector<std::string>& value);

/// Reads plain parameter structs from configured values and records declarations and problems. A struct declares its
/// fields in `template <class Field> static void describe(Field&& field)`, by calls of
///   field(&P::member, "name", "unit", "description", min, max)   for numbers,
///   field(&P::member, "name", "unit", "description")             for bool, text and lists,
///   field(&P::member, "name", "unit", "description", {"a","b"})  for a choice,
///   field.path(&P::member, "name", "description")                for text that names a file or folder,
///   field.group(&P::member, "name")                              for a nested struct.
///
/// Optionally, it reports contradictory fields in `template <class Conflict> void find_conflicts(Conflict&& conflict)
/// const`, by calls of
///   conflict("first", "must be less than", "second").
class ParameterReader {
 public:
  /// `owner` names the component in messages ("binocular_odometry").
  ParameterReader(std::string owner, WrittenValues written) : owner_(std::move(owner)), written_(std::move(written)) {}

  /// Returns the struct: defaults overridden by the configured values. Problems are recorded, see problems().
  template <class Parameters>
  Parameters read() {
    return read(Parameters{}, "");
  }
  /// The same with other defaults, and a prefix ("motion.") in front of each name.
  template <class Parameters>
  Parameters read(Parameters parameters, const std::string& prefix) {
    Parameters::describe(Field<Parameters>{*this, parameters, prefix});
    add_conflicts(parameters, prefix);
    return parameters;
  }

  /// From now on, allows only paths below `folder`; empty: none. For values from other processes.
  void confine_paths(std::filesystem::path folder) { paths_below_ = std::move(folder); }

  /// Declared parameters in order of declaration, each name once.
  const std::vector<ParameterDescription>& declared() const noexcept { return declared_; }

  /// All invalid values and all configured keys that no read() has declared (with the nearest declared name), each with
  /// file and line, in order of line; not those of values for several nodes, which another one may have. Call it after
  /// the component's constructor, when all declarations are known.
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

  /// Overrides `value` with the configured value, if valid, and records the declaration.
  template <class Value>
  void declare(ParameterDescription description, Value& value);

  std::string owner_;
  WrittenValues written_;
  std::vector<ParameterDescription> declared_;
  Problems problems_;
  std::optional<std::filesystem::path> paths_below_;
};

}  // namespace panvo::runtime
