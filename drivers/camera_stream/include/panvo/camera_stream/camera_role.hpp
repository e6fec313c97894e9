// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "panvo/interfaces/topics.hpp"

namespace panvo::camera_stream {

/// The arrangement of a driver's cameras.
enum class Layout {
  kMono,      ///< a single camera
  kPanorama,  ///< a single camera that sends stitched panoramas
  kStereo,    ///< left, right
  kRig,       ///< up to six heads of a panoramic camera
};

inline constexpr interfaces::Topic<sensor_msgs::msg::Image> kCameraImageRaw{"camera/image_raw",
                                                                            interfaces::qos::kSensorData};
inline constexpr interfaces::Topic<sensor_msgs::msg::CameraInfo> kCameraInfo{"camera/camera_info",
                                                                             interfaces::qos::kSensorData};

/// The role of a camera in its layout.
struct CameraRole {
  std::string name;      ///< "camera", "panorama", "left", "right", "head_0"
  std::string frame_id;  ///< optical frame: "stereo_left_optical"
  interfaces::Topic<sensor_msgs::msg::Image> images;
  interfaces::Topic<sensor_msgs::msg::CameraInfo> infos;
};

/// "mono", "panorama", "stereo" or "rig"; throws std::invalid_argument for any other name.
Layout layout_of(std::string_view name);

/// The cameras of a layout, in order. Throws std::invalid_argument with the allowed number of cameras.
std::vector<CameraRole> roles_of(Layout layout, std::size_t cameras);

}  // namespace panvo::camera_stream
