// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

namespace panvo::calibration_files {

/// The end of a message about an unknown key: "; did you mean blend_deg? Known keys: blend_deg, radius_m".
std::string known_keys(const std::string& wrong, const std::set<std::string>& known);

}  // namespace panvo::calibration_files
