// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "panvo/conversions/result.hpp"

namespace panvo::v4l2_camera {

/// A setting of a camera, as the camera describes it.
struct Control {
  enum class Kind : std::uint8_t { kNumber, kSwitch, kMenu, kButton };

  std::uint32_t id = 0;
  std::string name{};  ///< of the parameter: control_name() of what the camera calls it
  Kind kind = Kind::kNumber;
  std::int64_t least = 0, most = 0, step = 1, standard = 0;
  std::map<std::int64_t, std::string> choices{};  ///< of a menu
  bool is_read_only = false;
  bool is_64_bit = false;
};

/// The name of a control as a parameter: "White Balance, Automatic" is white_balance_automatic.
std::string control_name(std::string_view name);

/// The value that a text means: a number, true or false, a choice of a menu by its text or number. The reason says what may be written.
conversions::Result<std::int64_t> control_value(const Control& control, const std::string& text);

/// A control and what it is to be, as written.
struct ControlSetting {
  std::string name, value;
};

/// The settings for the device `device` ("left") out of lines `name=value` for all and `left:name=value` for one, in their order; `devices` are all
/// there are. Throws std::invalid_argument, saying how to write it.
std::vector<ControlSetting> settings_of(const std::vector<std::string>& lines, std::string_view device,
                                        const std::vector<std::string>& devices);

}  // namespace panvo::v4l2_camera
