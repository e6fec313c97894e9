// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/negotiation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace panvo::v4l2_camera {
namespace {

std::string format_names(const std::vector<Control>& controls) {
  std::string text;
  for (const auto& control : controls) text += (text.empty() ? "" : ", ") + control.name;
  return text.empty() ? "none" : text;
}

/// Sets one control. Returns why it was refused, nullopt on success. Throws DeviceError if the device is gone.
std::optional<std::string> set(VideoDevice& device, const std::vector<Control>& controls,
                               const camera_group::DeviceSetting& setting) {
  const auto control =
      std::find_if(controls.begin(), controls.end(), [&](const Control& each) { return each.name == setting.name; });
  if (control == controls.end()) return "the camera has no control of that name; it has " + format_names(controls);
  const auto value = control_value(*control, setting.value);
  if (!value) return value.reason();
  try {
    device.set_control(*control, *value);
    if (control->kind == Control::Kind::kButton) return std::nullopt;
    if (const auto now = device.control(*control); now != *value) return fmt::format("the camera set {} instead", now);
  } catch (const DeviceError& error) {
    if (error.kind() == DeviceError::Kind::kGone) throw;
    return error.what();
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> set_controls(VideoDevice& device, const std::vector<camera_group::DeviceSetting>& settings) {
  std::vector<std::string> refused;
  if (settings.empty()) return refused;
  const auto controls = device.controls();
  for (const auto& setting : settings) {
    if (const auto problem = set(device, controls, setting))
      refused.push_back(fmt::format("controls: {}={}: {}", setting.name, setting.value, *problem));
  }
  return refused;
}

Negotiated start(VideoDevice& device, const std::string& node, const CameraSettings& settings) {
  Negotiated negotiated;
  negotiated.refused = set_controls(device, settings.controls);
  const auto offered = device.offered_formats();
  const auto choice = choose_format(offered, device.format(), settings.format);
  if (!choice) throw DeviceError(DeviceError::Kind::kOther, node + ": " + choice.reason());
  negotiated.asked = *choice;
  negotiated.given = device.set_format(negotiated.asked);
  if (const auto problem = format_problem(negotiated.given, offered); !problem.empty())
    throw DeviceError(DeviceError::Kind::kOther, node + " " + problem);
  const double settable_hz = settings.format.rate_hz > 0.0 ? device.set_rate_hz(settings.format.rate_hz) : 0.0;
  negotiated.rate_hz = settable_hz > 0.0 ? settable_hz : device.rate_hz();
  for (auto& text : not_given(settings.format, negotiated.asked, negotiated.given, settable_hz))
    negotiated.refused.push_back(std::move(text));
  device.start(settings.buffers);
  return negotiated;
}

}  // namespace panvo::v4l2_camera
