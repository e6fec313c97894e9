// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "panvo/calibration/rig_file.hpp"

namespace panvo::calibration {

/// The cameras cam0, cam1, ... of a camchain YAML as Kalibr writes it, cam0 the reference. Read are pinhole cameras with radtan or equidistant
/// distortion or none, and omni ones with radtan. Throws CalibrationError, naming file, line and key.
std::vector<NamedCamera> read_camchain(const std::filesystem::path& file);

/// The opposite; the rational model Kalibr does not have is refused.
std::string camchain_text(const std::vector<NamedCamera>& cameras);

}  // namespace panvo::calibration
