// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_group/device_setting.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace panvo::camera_group {
namespace {

std::string trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kSpace) - first + 1));
}

}  // namespace

std::vector<DeviceSetting> settings_of(std::string_view parameter, const std::vector<std::string>& lines,
                                       std::string_view device, const std::vector<std::string>& devices) {
  std::vector<DeviceSetting> settings;
  for (const auto& line : lines) {
    const auto equals = line.find('=');
    const std::string before = line.substr(0, equals);
    const auto colon = before.find(':');
    const std::string its_device = colon == std::string::npos ? std::string(device) : trimmed(before.substr(0, colon));
    const std::string name = trimmed(colon == std::string::npos ? before : before.substr(colon + 1));
    if (equals == std::string::npos || name.empty()) {
      throw std::invalid_argument(fmt::format(
          "{}: '{}' is not a setting; write name=value, or {}:name=value for one camera", parameter, line, device));
    }
    if (std::ranges::find(devices, its_device) == devices.end()) {
      throw std::invalid_argument(fmt::format("{}: '{}' names the unknown camera '{}'; cameras: {}", parameter, line,
                                              its_device, fmt::join(devices, ", ")));
    }
    if (its_device == device) settings.push_back({name, trimmed(line.substr(equals + 1))});
  }
  return settings;
}

}  // namespace panvo::camera_group
