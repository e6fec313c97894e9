// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

namespace panvo::position_corrector {

/// Unit bearings of one thing, from the landmark and from the panorama now, each in its own frame.
struct BearingPair {
  Eigen::Vector3d landmark;
  Eigen::Vector3d panorama;
};

struct EpipolarMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();    ///< landmark_from_panorama
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();      ///< unit, in the landmark's frame
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< of the rotation, whatever the direction is; rad^2
};

/// The rotation and direction that fit the epipolar planes of all pairs best, by their angular distances, robust (Cauchy).
/// Where the two panoramas were taken at one spot the direction means nothing and stays about where it was; the rotation is
/// determined all the same. At least five pairs.
EpipolarMotion refine_epipolar_motion(const EpipolarMotion& start, std::span<const BearingPair> pairs,
                                      double bearing_sigma_rad);

}  // namespace panvo::position_corrector
