// SPDX-License-Identifier: Apache-2.0
#include "feature.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

namespace panvo::aravis_camera {
namespace {

template <class Number>
std::optional<Number> number_of(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string apply_integer(ArvDevice* device, const camera_group::DeviceSetting& setting) {
  const auto value = number_of<std::int64_t>(setting.value);
  if (!value) return "is not a whole number";
  ErrorSlot error;
  gint64 least = 0, most = 0;
  arv_device_get_integer_feature_bounds(device, setting.name.c_str(), &least, &most, error.slot());
  if (!error && (*value < least || *value > most)) return fmt::format("is out of range, {} to {}", least, most);
  const gint64 step = arv_device_get_integer_feature_increment(device, setting.name.c_str(), error.slot());
  if (!error && step > 1 && (*value - least) % step != 0)
    return fmt::format("is not a valid step: use {} plus a multiple of {}", least, step);
  arv_device_set_integer_feature_value(device, setting.name.c_str(), *value, error.slot());
  return error.text();
}

std::string apply_float(ArvDevice* device, const camera_group::DeviceSetting& setting) {
  const auto value = number_of<double>(setting.value);
  if (!value) return "is not a number";
  ErrorSlot error;
  double least = 0, most = 0;
  arv_device_get_float_feature_bounds(device, setting.name.c_str(), &least, &most, error.slot());
  if (!error && (*value < least || *value > most)) return fmt::format("is out of range, {} to {}", least, most);
  arv_device_set_float_feature_value(device, setting.name.c_str(), *value, error.slot());
  return error.text();
}

std::string apply_boolean(ArvDevice* device, const camera_group::DeviceSetting& setting) {
  const bool is_true = setting.value == "true" || setting.value == "1";
  if (!is_true && setting.value != "false" && setting.value != "0") return "is neither true nor false";
  ErrorSlot error;
  arv_device_set_boolean_feature_value(device, setting.name.c_str(), is_true, error.slot());
  return error.text();
}

std::string apply_choice(ArvDevice* device, const camera_group::DeviceSetting& setting) {
  ErrorSlot error;
  guint count = 0;
  const std::unique_ptr<const char*[], Free> choices(arv_device_dup_available_enumeration_feature_values_as_strings(
      device, setting.name.c_str(), &count, error.slot()));
  std::vector<std::string> names;
  for (guint i = 0; choices && i < count; ++i) names.emplace_back(choices[i]);
  if (!error && std::find(names.begin(), names.end(), setting.value) == names.end())
    return fmt::format("is not a valid choice; choices: {}", fmt::join(names, ", "));
  arv_device_set_string_feature_value(device, setting.name.c_str(), setting.value.c_str(), error.slot());
  return error.text();
}

std::string apply_known(ArvDevice* device, ArvGcNode* node, const camera_group::DeviceSetting& setting) {
  ErrorSlot error;
  if (ARV_IS_GC_COMMAND(node)) {
    arv_device_execute_command(device, setting.name.c_str(), error.slot());
    return error.text();
  }
  if (ARV_IS_GC_ENUMERATION(node)) return apply_choice(device, setting);  // before integer, which it also is
  if (ARV_IS_GC_BOOLEAN(node)) return apply_boolean(device, setting);
  if (ARV_IS_GC_FLOAT(node)) return apply_float(device, setting);
  if (ARV_IS_GC_INTEGER(node)) return apply_integer(device, setting);
  if (ARV_IS_GC_STRING(node)) {
    arv_device_set_string_feature_value(device, setting.name.c_str(), setting.value.c_str(), error.slot());
    return error.text();
  }
  return "has a type that cannot be set";
}

}  // namespace

std::string apply(ArvDevice* device, const camera_group::DeviceSetting& setting) {
  ArvGcNode* node = arv_device_get_feature(device, setting.name.c_str());
  const std::string problem = node == nullptr
                                  ? "the camera has no feature of that name (`arv-tool-0.8 features` lists all)"
                                  : apply_known(device, node, setting);
  return problem.empty() ? problem : fmt::format("{}={}: {}", setting.name, setting.value, problem);
}

}  // namespace panvo::aravis_camera
