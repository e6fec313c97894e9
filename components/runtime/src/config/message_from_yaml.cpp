// SPDX-License-Identifier: Apache-2.0
#include "message_from_yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <limits>

#include "panvo/interfaces/message_layout.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/parameters.hpp"
#include "suggestion.hpp"

namespace panvo::runtime {
namespace {

using interfaces::CdrField;
using interfaces::CdrLayout;
using interfaces::CdrNumber;

YAML::Node load(const std::string& text) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw ConfigError("\"" + text + "\" is not valid YAML: " + error.what());
  }
}

/// Writes members in layout order, from a map that may lack some.
class Builder {
 public:
  void message(const CdrLayout& layout, const YAML::Node& map, const std::string& path) {
    check_keys(layout, map, path);
    for (const CdrField& field : layout.fields) {
      const std::string name = path + (path.empty() ? "" : ".") + std::string(field.name);
      const YAML::Node value = map.IsMap() ? map[std::string(field.name)] : YAML::Node();
      if (field.is_sequence || field.is_array) {
        list(field, value, name);
      } else {
        element(field, value, name);
      }
    }
  }

  interfaces::Bytes take() { return std::move(bytes_); }

 private:
  static bool is_written(const YAML::Node& node) { return node.IsDefined() && !node.IsNull(); }

  static void check_keys(const CdrLayout& layout, const YAML::Node& map, const std::string& path) {
    if (!is_written(map)) return;
    if (!map.IsMap()) throw ConfigError((path.empty() ? "the message" : path) + ": write its members as {name: value}");
    std::vector<std::string> names;
    for (const CdrField& field : layout.fields) names.emplace_back(field.name);
    for (const auto& entry : map) {
      const auto key = entry.first.Scalar();
      if (std::find(names.begin(), names.end(), key) == names.end())
        throw ConfigError((path.empty() ? "" : path + ": ") + "there is no member \"" + key + "\"" +
                          suggestion(key, names));
    }
  }

  void list(const CdrField& field, const YAML::Node& value, const std::string& name) {
    if (is_written(value) && !value.IsSequence()) throw ConfigError(name + ": write a list, [a, b]");
    const std::size_t count = is_written(value) ? value.size() : 0;
    if (field.is_array && count != 0 && count != field.array_size)
      throw ConfigError(name + ": needs " + std::to_string(field.array_size) + " values, not " + std::to_string(count));
    if (field.is_sequence) number(static_cast<std::uint32_t>(count));
    const std::size_t elements = field.is_array ? field.array_size : count;
    for (std::size_t i = 0; i < elements; ++i)
      element(field, count != 0 ? value[i] : YAML::Node(), name + "[" + std::to_string(i) + "]");
  }

  void element(const CdrField& field, const YAML::Node& value, const std::string& name) {
    if (field.nested) return message(*field.nested, is_written(value) ? value : YAML::Node(), name);
    if (is_written(value) && !value.IsScalar()) throw ConfigError(name + ": needs one value");
    const std::string text = is_written(value) ? value.Scalar() : "";
    if (field.is_string) return string(text);
    if (text.empty()) return zero(field.size);
    switch (field.number) {
      case CdrNumber::kBool: {
        bool is_true = false;
        if (const auto wrong = parse({{text}, false, {}}, is_true))
          throw ConfigError(name + " = " + text + ": " + *wrong);
        return number(static_cast<std::uint8_t>(is_true));
      }
      case CdrNumber::kFloat:
        return field.size == 4 ? number(static_cast<float>(real(text, name))) : number(real(text, name));
      case CdrNumber::kSigned:
        return whole<std::int8_t, std::int16_t, std::int32_t, std::int64_t>(field.size, text, name);
      case CdrNumber::kUnsigned:
        return whole<std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t>(field.size, text, name);
    }
  }

  static double real(const std::string& text, const std::string& name) {
    double value = 0;
    if (text == ".nan") return std::numeric_limits<double>::quiet_NaN();
    if (text == ".inf" || text == "-.inf") return (text[0] == '-' ? -1 : 1) * std::numeric_limits<double>::infinity();
    if (const auto wrong = parse({{text}, false, {}}, value)) throw ConfigError(name + " = " + text + ": " + *wrong);
    return value;
  }

  template <class One, class Two, class Four, class Eight>
  void whole(std::size_t size, const std::string& text, const std::string& name) {
    if (size == 1) return number(whole<One>(text, name));
    if (size == 2) return number(whole<Two>(text, name));
    if (size == 4) return number(whole<Four>(text, name));
    number(whole<Eight>(text, name));
  }
  template <class Number>
  static Number whole(const std::string& text, const std::string& name) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
      throw ConfigError(name + " = " + text + ": is not a whole number from " +
                        std::to_string(std::numeric_limits<Number>::min()) + " to " +
                        std::to_string(std::numeric_limits<Number>::max()));
    }
    return value;
  }

  void string(const std::string& text) {
    number(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back(0);
  }

  void zero(std::size_t size) {
    align(size);
    bytes_.resize(bytes_.size() + size);
  }

  template <class Number>
  void number(Number value) {
    static_assert(std::endian::native == std::endian::little);
    align(sizeof value);
    const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(Number)>>(value);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  void align(std::size_t size) {
    constexpr std::size_t kEncapsulation = 4;
    while ((bytes_.size() - kEncapsulation) % size != 0) bytes_.push_back(0);
  }

  interfaces::Bytes bytes_{0, 1, 0, 0};
};

/// Detects the type of a scalar; a quoted one is a string.
rcl_interfaces::msg::ParameterValue scalar_value(const YAML::Node& node) {
  constexpr std::uint8_t kBool = 1, kInteger = 2, kDouble = 3, kString = 4;  // rcl_interfaces/msg/ParameterType's
  const WrittenValue written{{node.Scalar()}, false, {}};
  rcl_interfaces::msg::ParameterValue value;
  bool is_true = false;
  std::int64_t whole = 0;
  double real = 0;
  if (node.Tag() == "!") {
    value.type(kString);
    value.string_value(node.Scalar());
  } else if (!parse(written, is_true)) {
    value.type(kBool);
    value.bool_value(is_true);
  } else if (!parse(written, whole)) {
    value.type(kInteger);
    value.integer_value(whole);
  } else if (!parse(written, real)) {
    value.type(kDouble);
    value.double_value(real);
  } else {
    value.type(kString);
    value.string_value(node.Scalar());
  }
  return value;
}

rcl_interfaces::msg::ParameterValue list_value(const YAML::Node& node, const std::string& text) {
  constexpr std::uint8_t kArrayOffset = 5;  // offset from a scalar type to its array type; byte arrays excluded
  constexpr std::uint8_t kInteger = 2, kDouble = 3;
  rcl_interfaces::msg::ParameterValue value;
  std::uint8_t type = 0;
  std::vector<rcl_interfaces::msg::ParameterValue> items;
  for (const auto& item : node) {
    if (!item.IsScalar()) throw ConfigError(text + ": a parameter must be a value or a list of values");
    auto& last = items.emplace_back(scalar_value(item));
    if (type == kInteger && last.type() == kDouble) type = kDouble;
    if (type == 0) type = last.type();
    if (last.type() != type && !(type == kDouble && last.type() == kInteger))
      throw ConfigError(text + ": the values of a list must have the same type");
  }
  for (const auto& item : items) {
    value.bool_array_value().push_back(item.bool_value());
    value.integer_array_value().push_back(item.integer_value());
    value.double_array_value().push_back(item.type() == kInteger ? static_cast<double>(item.integer_value())
                                                                 : item.double_value());
    value.string_array_value().push_back(item.string_value());
  }
  constexpr std::uint8_t kEmpty = 4;  // an empty list counts as strings
  value.type(static_cast<std::uint8_t>((type == 0 ? kEmpty : type) + kArrayOffset));
  if (type != 1) value.bool_array_value().clear();
  if (type != kInteger) value.integer_array_value().clear();
  if (type != kDouble) value.double_array_value().clear();
  if (type != kEmpty) value.string_array_value().clear();
  return value;
}

}  // namespace

interfaces::Bytes message_from_yaml(const interfaces::MessageType& type, const std::string& text) {
  Builder builder;
  builder.message(*type.layout, load(text), "");
  return builder.take();
}

rcl_interfaces::msg::ParameterValue parameter_value_from_yaml(const std::string& text) {
  const YAML::Node node = load(text);
  if (node.IsScalar()) return scalar_value(node);
  if (node.IsSequence()) return list_value(node, text);
  throw ConfigError("\"" + text + "\": a parameter must be a value or a list of values");
}

}  // namespace panvo::runtime
