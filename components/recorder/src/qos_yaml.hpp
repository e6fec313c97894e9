// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <vector>

#include "panvo/recorder/qos_profile.hpp"

namespace panvo::recorder {

/// Profiles as a YAML sequence, nested in metadata.yaml since version 9.
YAML::Node to_node(const std::vector<QosProfile>& profiles, QosNotation notation);

/// Reads either notation. Throws YAML::Exception or std::out_of_range.
std::vector<QosProfile> profiles_from_node(const YAML::Node& node);

}  // namespace panvo::recorder
