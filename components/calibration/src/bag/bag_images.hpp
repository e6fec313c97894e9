// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "messages/camera_topic.hpp"

namespace panvo::calibration {

struct BagImages {
  std::filesystem::path bag;
  std::vector<CameraTopic>
      cameras;  ///< the first is the one whose frames are chosen; empty: every */image_raw, named by the folder it is in
  std::filesystem::path out;
  std::int64_t every_ns = 0;      ///< between frames
  std::int64_t tolerance_ns = 0;  ///< between frames that were taken at once
};

/// Writes OUT/NAME/STAMP.png; frames taken at once have the same name. Returns how many of each camera. Throws CalibrationError for topics that
/// are not there, and recorder::BagError.
std::vector<std::size_t> write_images(BagImages& settings);

}  // namespace panvo::calibration
