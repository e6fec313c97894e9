// SPDX-License-Identifier: Apache-2.0
#include <linux/videodev2.h>

#include <optional>

#include "kernel/device_file.hpp"

namespace panvo::v4l2_camera::kernel {
namespace {

std::map<std::int64_t, std::string> choices_of(const DeviceFile& file, const v4l2_queryctrl& query) {
  std::map<std::int64_t, std::string> choices;
  v4l2_querymenu choice{};
  choice.id = query.id;
  for (std::int64_t index = query.minimum; index <= query.maximum; ++index) {
    choice.index = static_cast<std::uint32_t>(index);
    if (!file.try_request(VIDIOC_QUERYMENU, &choice)) continue;  // a gap in the menu
    choices[index] =
        query.type == V4L2_CTRL_TYPE_MENU ? text_of(choice.name, sizeof choice.name) : std::to_string(choice.value);
  }
  return choices;
}

/// Reads the range of a 64-bit control, which needs another request.
void with_64_bits(const DeviceFile& file, Control& control) {
  v4l2_query_ext_ctrl query{};
  query.id = control.id;
  if (!file.try_request(VIDIOC_QUERY_EXT_CTRL, &query)) return;
  control.is_64_bit = true;
  control.least = query.minimum;
  control.most = query.maximum;
  control.step = static_cast<std::int64_t>(query.step);
  control.standard = query.default_value;
}

/// nullopt for controls without a numeric value, and for headings.
std::optional<Control> control_of(const DeviceFile& file, const v4l2_queryctrl& query) {
  Control control;
  control.id = query.id;
  control.name = control_name(text_of(query.name, sizeof query.name));
  control.least = query.minimum;
  control.most = query.maximum;
  control.step = query.step;
  control.standard = query.default_value;
  control.is_read_only = (query.flags & V4L2_CTRL_FLAG_READ_ONLY) != 0;
  switch (query.type) {
    case V4L2_CTRL_TYPE_INTEGER:
    case V4L2_CTRL_TYPE_BITMASK:
      return control;
    case V4L2_CTRL_TYPE_INTEGER64:
      with_64_bits(file, control);
      return control;
    case V4L2_CTRL_TYPE_BOOLEAN:
      control.kind = Control::Kind::kSwitch;
      return control;
    case V4L2_CTRL_TYPE_BUTTON:
      control.kind = Control::Kind::kButton;
      return control;
    case V4L2_CTRL_TYPE_MENU:
    case V4L2_CTRL_TYPE_INTEGER_MENU:
      control.kind = Control::Kind::kMenu;
      control.choices = choices_of(file, query);
      return control;
    default:
      return std::nullopt;
  }
}

v4l2_ext_controls list_of(v4l2_ext_control& one) {
  v4l2_ext_controls all{};
  all.which = V4L2_CTRL_WHICH_CUR_VAL;
  all.count = 1;
  all.controls = &one;
  return all;
}

}  // namespace

std::vector<Control> controls_of(const DeviceFile& file) {
  std::vector<Control> controls;
  constexpr std::uint32_t kNext = V4L2_CTRL_FLAG_NEXT_CTRL;
  v4l2_queryctrl query{};
  for (query.id = kNext; file.try_request(VIDIOC_QUERYCTRL, &query); query.id |= kNext) {
    if ((query.flags & V4L2_CTRL_FLAG_DISABLED) != 0) continue;
    if (auto control = control_of(file, query)) controls.push_back(std::move(*control));
  }
  return controls;
}

void set_control(const DeviceFile& file, const Control& control, std::int64_t value) {
  v4l2_ext_control one{};
  one.id = control.id;
  control.is_64_bit ? one.value64 = value : one.value = static_cast<std::int32_t>(value);
  auto all = list_of(one);
  file.request(VIDIOC_S_EXT_CTRLS, &all, "VIDIOC_S_EXT_CTRLS");
}

std::int64_t get_control(const DeviceFile& file, const Control& control) {
  v4l2_ext_control one{};
  one.id = control.id;
  auto all = list_of(one);
  file.request(VIDIOC_G_EXT_CTRLS, &all, "VIDIOC_G_EXT_CTRLS");
  return control.is_64_bit ? std::int64_t{one.value64} : std::int64_t{one.value};
}

}  // namespace panvo::v4l2_camera::kernel
