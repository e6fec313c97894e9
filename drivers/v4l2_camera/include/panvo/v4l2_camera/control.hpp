// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "panvo/conversions/result.hpp"

namespace panvo::v4l2_camera {

/// A control of a camera, as the camera describes it.
struct Control {
  enum class Kind : std::uint8_t { kNumber, kSwitch, kMenu, kButton };

  std::uint32_t id = 0;
  std::string name{};  ///< control_name() of the camera's name
  Kind kind = Kind::kNumber;
  std::int64_t least = 0, most = 0, step = 1, standard = 0;
  std::map<std::int64_t, std::string> choices{};  ///< of a menu
  bool is_read_only = false;
  bool is_64_bit = false;
};

/// Converts a camera's control name to the name used in parameters: "White Balance, Automatic" becomes
/// white_balance_automatic.
std::string control_name(std::string_view name);

/// Parses the value of a control: a number, true or false, or a menu choice by its text or number. Fails with the
/// allowed values.
conversions::Result<std::int64_t> control_value(const Control& control, const std::string& text);

}  // namespace panvo::v4l2_camera
