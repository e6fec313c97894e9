// SPDX-License-Identifier: Apache-2.0
#include "panvo/aravis_camera/camera_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace panvo::aravis_camera {
namespace {

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

}  // namespace

std::vector<FeatureSetting> features_of(const std::vector<std::string>& lines, std::string_view role,
                                        const std::vector<std::string>& roles) {
  std::vector<FeatureSetting> settings;
  for (const auto& line : lines) {
    const auto equals = line.find('=');
    const auto colon = line.substr(0, equals).find(':');
    const bool has_role = colon != std::string::npos;
    const std::string name = trimmed(line.substr(0, equals).substr(has_role ? colon + 1 : 0));
    if (equals == std::string::npos || name.empty()) {
      throw SettingsError(
          fmt::format("features: '{}' is no setting; write Name=value, or {}:Name=value for one camera", line, role));
    }
    const std::string its_role = has_role ? trimmed(line.substr(0, colon)) : std::string(role);
    if (std::find(roles.begin(), roles.end(), its_role) == roles.end()) {
      throw SettingsError(fmt::format("features: '{}' is for '{}', which is no camera here; there are: {}", line,
                                      its_role, fmt::join(roles, ", ")));
    }
    if (its_role == role) settings.push_back({name, trimmed(line.substr(equals + 1))});
  }
  return settings;
}

}  // namespace panvo::aravis_camera
