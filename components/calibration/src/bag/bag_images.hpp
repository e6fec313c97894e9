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
      cameras;  ///< frames are selected by the first one; empty: every */image_raw, named after its namespace
  std::filesystem::path out;
  std::int64_t every_ns = 0;      ///< least interval between frames
  std::int64_t tolerance_ns = 0;  ///< largest stamp difference of simultaneous frames
};

/// Writes OUT/NAME/STAMP.png; simultaneous frames have equal names. Fills empty `cameras`. Returns the number of frames
/// of each camera. Throws CalibrationError for missing topics, and recorder::BagError.
std::vector<std::size_t> write_images(BagImages& settings);

}  // namespace panvo::calibration
