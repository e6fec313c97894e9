// SPDX-License-Identifier: Apache-2.0
#include "node_services/parameter_values.hpp"

#include <array>
#include <string_view>

namespace panvo::runtime::node_services {
namespace {

struct TypeNames {
  ParameterType type;
  std::string_view ours;
};
constexpr std::array<TypeNames, 6> kTypes{{{ParameterType::kBool, "bool"},
                                           {ParameterType::kInteger, "integer"},
                                           {ParameterType::kDouble, "number"},
                                           {ParameterType::kString, "text"},
                                           {ParameterType::kDoubleArray, "numbers"},
                                           {ParameterType::kStringArray, "texts"}}};

constexpr std::array<std::string_view, 10> kShownTypes{"nothing", "a bool", "an integer", "a number", "a text",
                                                       "bytes",   "bools",  "integers",   "numbers",  "texts"};

template <class Items>
WrittenValue list_of(const Items& items) {
  WrittenValue written{{}, true, {}};
  for (const auto& item : items) written.items.push_back(to_text(item));
  return written;
}

ParameterType written_type(const rcl_interfaces::msg::ParameterValue& value) {
  return value.type() < kShownTypes.size() ? static_cast<ParameterType>(value.type()) : ParameterType::kNotSet;
}

bool is_empty_list(const rcl_interfaces::msg::ParameterValue& value) {
  const auto written = written_value(value);
  return written && written->is_list && written->items.empty();
}

}  // namespace

ParameterType ros_type(const ParameterDescription& parameter) {
  for (const auto& [type, ours] : kTypes) {
    if (parameter.type == ours) return type;
  }
  return ParameterType::kNotSet;
}

rcl_interfaces::msg::ParameterValue ros_value(const ParameterDescription& parameter) {
  rcl_interfaces::msg::ParameterValue value;
  const auto type = ros_type(parameter);
  value.type(static_cast<std::uint8_t>(type));
  const WrittenValue& written = parameter.written;
  // Always valid: created by to_text() from a value of the type.
  if (type == ParameterType::kBool) {
    bool parsed = false;
    parse(written, parsed);
    value.bool_value(parsed);
  } else if (type == ParameterType::kInteger) {
    std::int64_t parsed = 0;
    parse(written, parsed);
    value.integer_value(parsed);
  } else if (type == ParameterType::kDouble) {
    parse(written, value.double_value());
  } else if (type == ParameterType::kString) {
    parse(written, value.string_value());
  } else if (type == ParameterType::kDoubleArray) {
    parse(written, value.double_array_value());
  } else if (type == ParameterType::kStringArray) {
    parse(written, value.string_array_value());
  }
  return value;
}

rcl_interfaces::msg::ParameterDescriptor ros_descriptor(const ParameterDescription& parameter) {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.name(parameter.name);
  descriptor.type(static_cast<std::uint8_t>(ros_type(parameter)));
  const bool has_unit = !parameter.unit.empty() && parameter.unit != "1";
  descriptor.description(parameter.description + (has_unit ? " [" + parameter.unit + "]" : ""));
  std::string choices;
  for (const auto& choice : parameter.choices) choices += (choices.empty() ? "one of " : ", ") + choice;
  descriptor.additional_constraints(choices);
  descriptor.read_only(!parameter.settable);
  if (!parameter.min || !parameter.max) return descriptor;
  if (parameter.type == "integer") {
    rcl_interfaces::msg::IntegerRange range;
    range.from_value(static_cast<std::int64_t>(*parameter.min));
    range.to_value(static_cast<std::int64_t>(*parameter.max));
    range.step(1);
    descriptor.integer_range().push_back(range);
  } else {
    rcl_interfaces::msg::FloatingPointRange range;
    range.from_value(*parameter.min);
    range.to_value(*parameter.max);
    descriptor.floating_point_range().push_back(range);
  }
  return descriptor;
}

std::optional<WrittenValue> written_value(const rcl_interfaces::msg::ParameterValue& value) {
  const auto one = [](std::string text) { return WrittenValue{{std::move(text)}, false, {}}; };
  switch (written_type(value)) {
    case ParameterType::kBool:
      return one(to_text(value.bool_value()));
    case ParameterType::kInteger:
      return one(to_text(static_cast<std::int64_t>(value.integer_value())));
    case ParameterType::kDouble:
      return one(to_text(value.double_value()));
    case ParameterType::kString:
      return one(value.string_value());
    case ParameterType::kByteArray: {
      WrittenValue written{{}, true, {}};
      for (const auto item : value.byte_array_value()) written.items.push_back(std::to_string(unsigned{item}));
      return written;
    }
    case ParameterType::kBoolArray: {
      WrittenValue written{{}, true, {}};
      for (const bool item : value.bool_array_value()) written.items.push_back(to_text(item));
      return written;
    }
    case ParameterType::kIntegerArray:
      return list_of(value.integer_array_value());
    case ParameterType::kDoubleArray:
      return list_of(value.double_array_value());
    case ParameterType::kStringArray:
      return list_of(value.string_array_value());
    case ParameterType::kNotSet:
      break;
  }
  return std::nullopt;
}

std::optional<std::string> type_problem(const ParameterDescription& parameter,
                                        const rcl_interfaces::msg::ParameterValue& value) {
  const auto wanted = ros_type(parameter), given = written_type(value);
  const bool is_list = wanted == ParameterType::kDoubleArray || wanted == ParameterType::kStringArray;
  if (given == wanted || (is_list && is_empty_list(value))) return std::nullopt;
  if (wanted == ParameterType::kDouble && given == ParameterType::kInteger) return std::nullopt;
  if (wanted == ParameterType::kDoubleArray && given == ParameterType::kIntegerArray) return std::nullopt;
  return parameter.name + " is " + std::string(kShownTypes[static_cast<std::size_t>(wanted)]) + ", but " +
         std::string(kShownTypes[static_cast<std::size_t>(given)]) + " was given";
}

}  // namespace panvo::runtime::node_services
