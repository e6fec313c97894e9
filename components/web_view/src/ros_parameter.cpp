// SPDX-License-Identifier: Apache-2.0
#include "ros_parameter.hpp"

#include <type_traits>

namespace panvo::web_view {
namespace {

/// The constants of rcl_interfaces/msg/ParameterType.
enum Type : std::uint8_t { kNotSet, kBool, kInteger, kDouble, kString, kBytes, kBools, kIntegers, kDoubles, kStrings };

}  // namespace

ParameterValue value_of(const rcl_interfaces::msg::ParameterValue& value) {
  switch (value.type()) {
    case kBool:
      return value.bool_value();
    case kInteger:
      return value.integer_value();
    case kDouble:
      return value.double_value();
    case kString:
      return value.string_value();
    case kBytes: {
      const auto& bytes = value.byte_array_value();
      return std::vector<std::int64_t>(bytes.begin(), bytes.end());
    }
    case kBools:
      return value.bool_array_value();
    case kIntegers:
      return value.integer_array_value();
    case kDoubles:
      return value.double_array_value();
    case kStrings:
      return value.string_array_value();
    default:
      return {};
  }
}

rcl_interfaces::msg::ParameterValue ros_value_of(const ParameterValue& value) {
  rcl_interfaces::msg::ParameterValue ros;
  ros.type(kNotSet);
  const auto set = [&](Type type, const auto& write) {
    ros.type(type);
    write();
  };
  if (const auto* one = std::get_if<bool>(&value)) set(kBool, [&] { ros.bool_value(*one); });
  if (const auto* one = std::get_if<std::int64_t>(&value)) set(kInteger, [&] { ros.integer_value(*one); });
  if (const auto* one = std::get_if<double>(&value)) set(kDouble, [&] { ros.double_value(*one); });
  if (const auto* one = std::get_if<std::string>(&value)) set(kString, [&] { ros.string_value(*one); });
  if (const auto* list = std::get_if<std::vector<bool>>(&value)) set(kBools, [&] { ros.bool_array_value(*list); });
  if (const auto* list = std::get_if<std::vector<std::int64_t>>(&value))
    set(kIntegers, [&] { ros.integer_array_value(*list); });
  if (const auto* list = std::get_if<std::vector<double>>(&value))
    set(kDoubles, [&] { ros.double_array_value(*list); });
  if (const auto* list = std::get_if<std::vector<std::string>>(&value))
    set(kStrings, [&] { ros.string_array_value(*list); });
  return ros;
}

}  // namespace panvo::web_view
