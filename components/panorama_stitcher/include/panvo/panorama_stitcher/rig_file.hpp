// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "panvo/panorama_stitcher/panorama_rig.hpp"

namespace panvo::panorama_stitcher {

/// A rig file that cannot be used: a line for each problem, naming file, line, key and what to do.
class RigFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct RigFile {
  PanoramaRig rig;
  std::string
      seen_elevation_at;  ///< "rig.yaml:5: seen_elevation_deg": what to name when a part of it is seen by no head
};

/// Reads a rig (config/rigs shows some, the README every key). Calibrations are ROS camera_info files beside it. Throws RigFileError.
RigFile read_rig_file(const std::filesystem::path& file);

}  // namespace panvo::panorama_stitcher
