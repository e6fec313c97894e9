// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "panvo/panorama_stitcher/panorama_rig.hpp"

namespace panvo::panorama_stitcher {

struct RigFile {
  PanoramaRig rig;
  std::string
      seen_elevation_at;  ///< "rig.yaml:5: panorama.seen_elevation_deg": location for errors about uncovered elevations
};

/// Reads a rig file (examples in config/rigs, keys in the README) and the ROS camera_info files in its folder. Throws
/// calibration_files::FileError with all problems.
RigFile read_rig_file(const std::filesystem::path& file);

}  // namespace panvo::panorama_stitcher
