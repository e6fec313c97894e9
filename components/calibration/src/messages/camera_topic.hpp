// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace panvo::calibration {

/// A topic of images and the folder they go to.
struct CameraTopic {
  std::string name;   ///< of the camera
  std::string topic;  ///< "/stereo/left/image_raw"
};

/// Reads "left:=/stereo/left/image_raw". Throws CalibrationError.
CameraTopic parse_named_topic(const std::string& text);

/// "/stereo/left/image_raw" and "/stereo/left/image_raw/compressed" are of "left"; empty: not told by the name.
std::string camera_of(const std::string& topic);

/// The topics of several cameras, each TOPIC or NAME:=TOPIC. `names`: of those that have none, in order, and no others may be; empty: each is
/// named by camera_of, and two or more will do. Throws CalibrationError.
std::vector<CameraTopic> parse_topics(const std::vector<std::string>& topics, const std::vector<std::string>& names);

/// Whether a topic of this type ("sensor_msgs/msg/Image") carries images, compressed ones too.
bool is_image_type(const std::string& type);

}  // namespace panvo::calibration
