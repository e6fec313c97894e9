// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

namespace panvo::position_corrector {

/// Unit bearings of one point from the landmark and from the current panorama, each in its own frame.
struct BearingPair {
  Eigen::Vector3d landmark;
  Eigen::Vector3d panorama;
};

struct EpipolarMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();    ///< landmark_from_panorama
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();      ///< unit, in the landmark's frame
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< of the rotation, for unknown direction; rad^2
};

/// Rotation and direction that best fit the epipolar planes of all pairs, by angular distance, robust (Cauchy). If both
/// panoramas were taken at one position, the direction is meaningless and stays near the start; the rotation is still
/// determined. Needs at least five pairs.
EpipolarMotion refine_epipolar_motion(const EpipolarMotion& start, std::span<const BearingPair> pairs,
                                      double bearing_sigma_rad);

}  // namespace panvo::position_corrector
