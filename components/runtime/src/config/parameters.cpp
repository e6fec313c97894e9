// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/parameters.hpp"

#include <algorithm>
#include <cmath>

#include "paths_below.hpp"
#include "suggestion.hpp"

namespace panvo::runtime {
namespace {

const char* type_name(const bool&) { return "bool"; }
const char* type_name(const std::int64_t&) { return "integer"; }
const char* type_name(const double&) { return "number"; }
const char* type_name(const std::string&) { return "text"; }
const char* type_name(const std::vector<double>&) { return "numbers"; }
const char* type_name(const std::vector<std::string>&) { return "texts"; }

/// A bound in the notation of its type: 5000 for 5000.0.
std::string bound_text(const ParameterDescription& parameter, double bound) {
  constexpr double kExactlyWhole = 9007199254740992.0;  // 2^53
  const bool whole = parameter.type == "integer" && std::abs(bound) <= kExactlyWhole;
  return whole ? to_text(static_cast<std::int64_t>(bound)) : to_text(bound);
}

/// "must be 0.5..10 px"; empty if every value of the type is valid.
std::string requirement(const ParameterDescription& parameter) {
  if (parameter.min && parameter.max) {
    const bool has_unit = !parameter.unit.empty() && parameter.unit != "1";
    return "must be " + bound_text(parameter, *parameter.min) + ".." + bound_text(parameter, *parameter.max) +
           (has_unit ? " " + parameter.unit : "");
  }
  std::string choices;
  for (const auto& choice : parameter.choices) {
    choices += (choices.empty() ? "must be one of " : ", ") + choice;
  }
  return choices;
}

template <class Value>
WrittenValue value_as_written(const Value& value) {
  return {{to_text(value)}, false, {}};
}
template <class Item>
WrittenValue value_as_written(const std::vector<Item>& values) {
  WrittenValue written{{}, true, {}};
  for (const auto& value : values) written.items.push_back(to_text(value));
  return written;
}

template <class Value>
bool allowed(const ParameterDescription& parameter, const Value& value) {
  if constexpr (std::is_same_v<Value, std::int64_t> || std::is_same_v<Value, double>) {
    const auto number = static_cast<double>(value);
    return number >= parameter.min && number <= parameter.max;
  } else if constexpr (std::is_same_v<Value, std::string>) {
    const auto& choices = parameter.choices;
    return choices.empty() || std::find(choices.begin(), choices.end(), value) != choices.end();
  } else {
    return true;
  }
}

ParameterDescription described(const std::string& name, const char* unit, const char* description) {
  ParameterDescription parameter;
  parameter.name = name;
  parameter.unit = unit;
  parameter.description = description;
  return parameter;
}

ParameterDescription described(const std::string& name, const char* unit, const char* description, double min,
                               double max) {
  auto parameter = described(name, unit, description);
  parameter.min = min;
  parameter.max = max;
  return parameter;
}

std::string as_written(const WrittenValue& written) {
  if (written.is_list) {
    return to_text(written.items);
  }
  return written.items.empty() ? "" : written.items[0];
}

}  // namespace

template <class Value>
void ParameterReader::declare(ParameterDescription parameter, Value& value) {
  parameter.type = type_name(value);
  parameter.default_value = to_text(value);
  if (const auto found = written_.find(parameter.name); found != written_.end()) {
    const WrittenValue& written = found->second;
    const std::string must = requirement(parameter);
    Value parsed{};
    const auto misplaced =
        parameter.is_path && paths_below_ ? path_problem(as_written(written), *paths_below_) : std::nullopt;
    if (const auto wrong = parse(written, parsed)) {
      problems_.add(written.where, owner_ + "." + parameter.name + " = " + as_written(written) + ": " + *wrong +
                                       (must.empty() ? "" : "; " + must) + " (" + parameter.description + ")");
    } else if (misplaced) {
      problems_.add(written.where, owner_ + "." + parameter.name + " = " + as_written(written) + ": " + *misplaced +
                                       " (" + parameter.description + ")");
    } else if (!allowed(parameter, parsed)) {
      problems_.add(written.where, owner_ + "." + parameter.name + " = " + as_written(written) + ": " + must + " (" +
                                       parameter.description + ")");
    } else {
      value = std::move(parsed);
    }
  }
  parameter.value = to_text(value);
  parameter.written = value_as_written(value);

  const auto same_name = [&parameter](const auto& other) { return other.name == parameter.name; };
  if (std::none_of(declared_.begin(), declared_.end(), same_name)) {  // a struct may be read twice
    declared_.push_back(std::move(parameter));
  }
}

void ParameterReader::read_number(const std::string& name, const char* unit, const char* description, double min,
                                  double max, std::int64_t& value) {
  declare(described(name, unit, description, min, max), value);
}

void ParameterReader::read_number(const std::string& name, const char* unit, const char* description, double min,
                                  double max, double& value) {
  declare(described(name, unit, description, min, max), value);
}

void ParameterReader::read_value(const std::string& name, const char* unit, const char* description, bool& value) {
  declare(described(name, unit, description), value);
}

void ParameterReader::read_value(const std::string& name, const char* unit, const char* description,
                                 std::string& value) {
  declare(described(name, unit, description), value);
}

void ParameterReader::read_value(const std::string& name, const char* unit, const char* description,
                                 std::vector<double>& value) {
  declare(described(name, unit, description), value);
}

void ParameterReader::read_value(const std::string& name, const char* unit, const char* description,
                                 std::vector<std::string>& value) {
  declare(described(name, unit, description), value);
}

void ParameterReader::read_path(const std::string& name, const char* description, std::string& value) {
  auto parameter = described(name, "", description);
  parameter.is_path = true;
  declare(std::move(parameter), value);
}

void ParameterReader::read_choice(const std::string& name, const char* unit, const char* description,
                                  std::initializer_list<const char*> choices, std::string& value) {
  auto parameter = described(name, unit, description);
  parameter.choices.assign(choices.begin(), choices.end());
  declare(std::move(parameter), value);
}

void ParameterReader::add_conflict(const std::string& first, const char* rule, const std::string& second) {
  const auto value = [&](const std::string& name) {
    const auto found =
        std::find_if(declared_.begin(), declared_.end(), [&](const auto& declared) { return declared.name == name; });
    return found == declared_.end() ? std::string() : " (" + found->value + ")";
  };
  const auto written = written_.contains(first) ? written_.find(first) : written_.find(second);
  problems_.add(written == written_.end() ? Location{} : written->second.where,
                owner_ + "." + first + value(first) + " " + rule + " " + second + value(second));
}

std::vector<std::string> ParameterReader::problems() const {
  std::vector<std::string> names;
  for (const auto& parameter : declared_) {
    names.push_back(parameter.name);
  }
  Problems all = problems_;
  for (const auto& [name, written] : written_) {
    if (!written.is_for_several && std::find(names.begin(), names.end(), name) == names.end()) {
      all.add(written.where, owner_ + " has no parameter \"" + name + "\"" + suggestion(name, names));
    }
  }
  return all.sorted();
}

}  // namespace panvo::runtime
