// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "panvo/calibration/rig_file.hpp"

namespace panvo::calibration {

/// Reads the cameras cam0, cam1, ... of a Kalibr camchain YAML; cam0 is the reference. Supports the models with a
/// KalibrForm (pinhole-radtan, pinhole-equidistant, omni-radtan), and no distortion. Throws
/// calibration_files::FileError with all problems.
std::vector<NamedCamera> read_camchain(const std::filesystem::path& file);

/// The cameras as camchain YAML. Throws CalibrationError for lenses that Kalibr lacks: rational, or plumb_bob with k3.
std::string camchain_text(const std::vector<NamedCamera>& cameras);

}  // namespace panvo::calibration
