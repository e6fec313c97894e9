// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace panvo::camera_group {

/// What a device calls something that can be set (a control, a feature), and the value it is to have, as written.
struct DeviceSetting {
  std::string name, value;

  bool operator==(const DeviceSetting&) const = default;
};

/// The settings for the device `device` ("left") out of lines `name=value` for all and `left:name=value` for one, in their order; `devices` are all
/// there are. Throws std::invalid_argument, which names the parameter and says how to write it.
std::vector<DeviceSetting> settings_of(std::string_view parameter, const std::vector<std::string>& lines,
                                       std::string_view device, const std::vector<std::string>& devices);

}  // namespace panvo::camera_group
