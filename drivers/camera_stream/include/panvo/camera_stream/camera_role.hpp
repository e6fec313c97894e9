// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "panvo/interfaces/topics.hpp"

namespace panvo::camera_stream {

/// How the cameras of a driver belong together.
enum class Layout {
  kMono,      ///< one camera by itself
  kPanorama,  ///< one that sends a ready-made panorama
  kStereo,    ///< left, right
  kRig,       ///< the heads of a panoramic camera, up to six
};

inline constexpr interfaces::Topic<sensor_msgs::msg::Image> kCameraImageRaw{"camera/image_raw",
                                                                            interfaces::qos::kSensorData};
inline constexpr interfaces::Topic<sensor_msgs::msg::CameraInfo> kCameraInfo{"camera/camera_info",
                                                                             interfaces::qos::kSensorData};

/// What a camera is in its layout.
struct CameraRole {
  std::string name;      ///< "camera", "panorama", "left", "right", "head_0"
  std::string frame_id;  ///< of its optical frame: "stereo_left_optical"
  interfaces::Topic<sensor_msgs::msg::Image> images;
  interfaces::Topic<sensor_msgs::msg::CameraInfo> infos;
};

/// "mono", "panorama", "stereo", "rig"; throws std::invalid_argument for another.
Layout layout_of(std::string_view name);

/// The cameras of a layout, in order. Throws std::invalid_argument, saying how many there may be.
std::vector<CameraRole> roles_of(Layout layout, std::size_t cameras);

}  // namespace panvo::camera_stream
