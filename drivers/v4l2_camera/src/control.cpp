// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/control.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <optional>

namespace panvo::v4l2_camera {
namespace {

using conversions::Reason;

std::optional<std::int64_t> number_of(const std::string& text) {
  std::int64_t number = 0;
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && last == end ? std::optional(number) : std::nullopt;
}

conversions::Result<std::int64_t> choice_of(const Control& control, const std::string& text) {
  std::string known;
  for (const auto& [value, name] : control.choices) {
    if (control_name(name) == control_name(text) || number_of(text) == value) return value;
    known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", value, name);
  }
  return Reason{"is not a valid choice; choices: " + known};
}

}  // namespace

std::string control_name(std::string_view name) {
  std::string result;
  for (const char character : name) {
    const auto byte = static_cast<unsigned char>(character);
    if (std::isalnum(byte) != 0) {
      result += static_cast<char>(std::tolower(byte));
    } else if (!result.empty() && result.back() != '_') {
      result += '_';
    }
  }
  if (!result.empty() && result.back() == '_') result.pop_back();
  return result;
}

conversions::Result<std::int64_t> control_value(const Control& control, const std::string& text) {
  if (control.is_read_only) return Reason{"is read-only"};
  if (control.kind == Control::Kind::kButton) return std::int64_t{1};
  if (control.kind == Control::Kind::kMenu) return choice_of(control, text);
  if (control.kind == Control::Kind::kSwitch) {
    if (text == "true" || text == "1") return std::int64_t{1};
    if (text == "false" || text == "0") return std::int64_t{0};
    return Reason{"is neither true nor false"};
  }
  const auto number = number_of(text);
  if (!number) return Reason{"is not a whole number"};
  if (*number < control.least || *number > control.most)
    return Reason{fmt::format("is out of range, {} to {}", control.least, control.most)};
  if (control.step > 1 && (*number - control.least) % control.step != 0)
    return Reason{fmt::format("is not a valid step: use {} plus a multiple of {}", control.least, control.step)};
  return *number;
}

}  // namespace panvo::v4l2_camera
