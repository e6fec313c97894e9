// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "panvo/runtime/parameters.hpp"

namespace panvo::runtime {
namespace {

/// std::from_chars is exact, independent of the locale, and reports where it stopped.
template <class Number>
std::errc from_text(std::string_view text, Number& out) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') {
    text.remove_prefix(1);  // YAML allows a leading plus, from_chars does not
  }
  Number value{};
  const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) {
    return error;
  }
  if (stopped != text.data() + text.size()) {
    return std::errc::invalid_argument;
  }
  out = value;
  return std::errc{};
}

std::optional<std::string> number_from(std::string_view text, double& out) {
  double value = 0;
  if (const auto error = from_text(text, value); error != std::errc{}) {
    return error == std::errc::result_out_of_range ? "is a number out of range" : "is not a number";
  }
  if (!std::isfinite(value)) {
    return "is not a finite number";
  }
  out = value;
  return std::nullopt;
}

std::optional<std::string> not_one_value(const WrittenValue& written) {
  if (written.is_list) {
    return "is a list, but one value is needed";
  }
  return written.items.empty() ? std::optional<std::string>("has no value") : std::nullopt;
}

template <class Number>
std::string number_text(Number value) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

template <class Value>
std::string list_text(const std::vector<Value>& values) {
  std::string text = "[";
  for (const auto& value : values) {
    text += (text.size() > 1 ? ", " : "") + to_text(value);
  }
  return text + "]";
}

}  // namespace

std::optional<std::string> parse(const WrittenValue& written, bool& out) {
  if (auto wrong = not_one_value(written)) {
    return wrong;
  }
  const std::string& text = written.items[0];
  const bool is_true = text == "true" || text == "True" || text == "TRUE";
  const bool is_false = text == "false" || text == "False" || text == "FALSE";
  if (!is_true && !is_false) {
    return "is not true or false";
  }
  out = is_true;
  return std::nullopt;
}

std::optional<std::string> parse(const WrittenValue& written, std::int64_t& out) {
  if (auto wrong = not_one_value(written)) {
    return wrong;
  }
  if (const auto error = from_text(written.items[0], out); error != std::errc{}) {
    return error == std::errc::result_out_of_range ? "is a whole number out of range" : "is not a whole number";
  }
  return std::nullopt;
}

std::optional<std::string> parse(const WrittenValue& written, double& out) {
  if (auto wrong = not_one_value(written)) {
    return wrong;
  }
  return number_from(written.items[0], out);
}

std::optional<std::string> parse(const WrittenValue& written, std::string& out) {
  if (auto wrong = not_one_value(written)) {
    return wrong;
  }
  out = written.items[0];
  return std::nullopt;
}

std::optional<std::string> parse(const WrittenValue& written, std::vector<double>& out) {
  if (!written.is_list) {
    return "is not a list; write [1.0, 2.0]";
  }
  std::vector<double> values(written.items.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (auto wrong = number_from(written.items[i], values[i])) {
      return "item " + std::to_string(i + 1) + ", " + written.items[i] + ", " + *wrong;
    }
  }
  out = std::move(values);
  return std::nullopt;
}

std::optional<std::string> parse(const WrittenValue& written, std::vector<std::string>& out) {
  if (!written.is_list) {
    return "is not a list; write [first, second]";
  }
  out = written.items;
  return std::nullopt;
}

std::string to_text(bool value) { return value ? "true" : "false"; }
std::string to_text(std::int64_t value) { return number_text(value); }
std::string to_text(double value) { return number_text(value); }
std::string to_text(const std::string& value) { return value; }
std::string to_text(const std::vector<double>& value) { return list_text(value); }
std::string to_text(const std::vector<std::string>& value) { return list_text(value); }

}  // namespace panvo::runtime
