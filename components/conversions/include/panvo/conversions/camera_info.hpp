// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "panvo/conversions/result.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/lens.hpp"
#include "panvo/vision/stereo_calibration.hpp"
#include "sensor_msgs/msg/CameraInfo.h"

/// ROS's description of a camera in a rectified pair: K and D of the raw image, R from the raw to the rectified
/// frame, P of the rectified image, whose last column holds -fx * baseline for the right camera.
namespace panvo::conversions {

/// One camera of a pair.
struct PairedCamera {
  vision::LensCamera raw;
  Eigen::Matrix3d rectified_from_raw = Eigen::Matrix3d::Identity();
  vision::PinholeCamera rectified;
  double baseline_m = 0.0;  ///< from the left camera along its +X; 0 for the left one itself

  bool operator==(const PairedCamera& other) const;
};

/// Whether its raw images are rectified as they are: a perspective lens without distortion, no rotation, one camera matrix for both.
bool is_rectified(const PairedCamera& camera);

PairedCamera left_camera(const vision::StereoCalibration& calibration, const vision::RectifiedStereo& rectified);
PairedCamera right_camera(const vision::StereoCalibration& calibration, const vision::RectifiedStereo& rectified);

sensor_msgs::msg::CameraInfo to_camera_info(const PairedCamera& camera, std::int64_t stamp_ns,
                                            const std::string& frame_id);

/// The reason says what is not calibrated (K, R or P are zero), not a number, or of a lens model that vision::lens_camera does not
/// know.
Result<PairedCamera> to_camera(const sensor_msgs::msg::CameraInfo& info);

/// The pair of two cameras. The reason says why they are none: sizes or focal lengths of the rectified images differ,
/// no baseline.
Result<vision::RectifiedStereo> to_stereo(const PairedCamera& left, const PairedCamera& right);

}  // namespace panvo::conversions
