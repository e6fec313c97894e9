// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace panvo::calibration {

/// An image topic and the name of its camera, which is also the output folder.
struct CameraTopic {
  std::string name;   ///< of the camera
  std::string topic;  ///< "/stereo/left/image_raw"
};

/// Parses "left:=/stereo/left/image_raw". Throws CalibrationError.
CameraTopic parse_named_topic(const std::string& text);

/// Camera name from a topic: "left" for "/stereo/left/image_raw" and "/stereo/left/image_raw/compressed"; empty if the
/// topic has no such form.
std::string camera_of(const std::string& topic);

/// Parses the topics of several cameras, each TOPIC or NAME:=TOPIC. `names`: the required camera names, assigned in
/// order to topics without NAME; if empty, camera_of() gives the names and two or more topics are accepted. Throws
/// CalibrationError.
std::vector<CameraTopic> parse_topics(const std::vector<std::string>& topics, const std::vector<std::string>& names);

/// Whether the type is sensor_msgs/msg/Image or CompressedImage.
bool is_image_type(const std::string& type);

}  // namespace panvo::calibration
