// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace panvo::camera_group {

/// Name of a device's setting (a control, a feature) and its requested value as text.
struct DeviceSetting {
  std::string name, value;

  bool operator==(const DeviceSetting&) const = default;
};

/// Extracts the settings of `device` ("left") from lines `name=value` (all devices) and `left:name=value` (one device),
/// in their order; `devices` lists all device names. Throws std::invalid_argument with the parameter's name and the
/// expected syntax.
std::vector<DeviceSetting> settings_of(std::string_view parameter, const std::vector<std::string>& lines,
                                       std::string_view device, const std::vector<std::string>& devices);

}  // namespace panvo::camera_group
