// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "panvo/panorama_stitcher/panorama_rig.hpp"

namespace panvo::panorama_stitcher {

/// An invalid rig file. The message has a line for each problem with file, line, key and remedy.
class RigFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct RigFile {
  PanoramaRig rig;
  std::string seen_elevation_at;  ///< "rig.yaml:5: seen_elevation_deg": location for errors about uncovered elevations
};

/// Reads a rig file (examples in config/rigs, keys in the README) and the ROS camera_info files in its folder. Throws
/// RigFileError.
RigFile read_rig_file(const std::filesystem::path& file);

}  // namespace panvo::panorama_stitcher
