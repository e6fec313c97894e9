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

/// Conversion of ROS CameraInfo of a stereo pair: K and D of the raw image, R from the raw to the rectified frame, P of
/// the rectified image, whose last column contains -fx * baseline for the right camera.
namespace panvo::conversions {

/// One camera of a pair.
struct PairedCamera {
  vision::LensCamera raw;
  Eigen::Matrix3d rectified_from_raw = Eigen::Matrix3d::Identity();
  vision::PinholeCamera rectified;
  double baseline_m = 0.0;  ///< from the left camera along its +X; 0 for the left camera

  bool operator==(const PairedCamera& other) const;
};

/// Whether the raw images are already rectified: perspective lens without distortion, no rotation, K equal to P.
bool is_rectified(const PairedCamera& camera);

PairedCamera left_camera(const vision::StereoCalibration& calibration, const vision::RectifiedStereo& rectified);
PairedCamera right_camera(const vision::StereoCalibration& calibration, const vision::RectifiedStereo& rectified);

sensor_msgs::msg::CameraInfo to_camera_info(const PairedCamera& camera, std::int64_t stamp_ns,
                                            const std::string& frame_id);

/// Reads a camera. The reason states what is missing (K, R or P are zero), not finite or unsupported (binning, region
/// of interest, lens model).
Result<PairedCamera> to_camera(const sensor_msgs::msg::CameraInfo& info);

/// Combines two cameras to a pair. The reason states why they do not form one: P or sizes differ, or the baseline is
/// invalid.
Result<vision::RectifiedStereo> to_stereo(const PairedCamera& left, const PairedCamera& right);

}  // namespace panvo::conversions
