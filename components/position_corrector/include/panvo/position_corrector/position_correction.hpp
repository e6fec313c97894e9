// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>

#include "panvo/position_corrector/landmark_matcher.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::position_corrector {

enum class CorrectionState {
  kFull,          ///< all six degrees of freedom
  kWeak,          ///< the same, but of so few points that it must not stand alone
  kRotationOnly,  ///< how the vehicle is turned; of its position nothing is said
  kRejected,      ///< it looked like the landmark, and geometry says it is not seen so that anything could be said
};

/// Where the vehicle's base is, seen from where it was when the landmark was made.
struct BasePose {
  Eigen::Isometry3d landmark_from_base = Eigen::Isometry3d::Identity();  ///< base frames, then and now; m
  vision::Matrix6d covariance = vision::Matrix6d::Zero();                ///< as of vision::pose_error
};

/// What one panorama says about the vehicle's pose.
struct PositionCorrection {
  CorrectionState state = CorrectionState::kRejected;
  std::string reason;  ///< why rejected, or why only the rotation; empty when full
  std::int64_t stamp_ns = 0;
  std::uint32_t landmark_id = 0;
  int inliers = 0;
  BasePose pose;  ///< of no meaning when rejected
};

/// Where the panoramic camera sat on the vehicle when the landmark was made, and where it sits now.
struct Mountings {
  Eigen::Isometry3d base_from_panorama_then = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d base_from_panorama_now = Eigen::Isometry3d::Identity();
};

/// A pose between panoramas as one between bases. The mountings count as exact; an error of the rotation swings the arm from the
/// panorama to the base.
BasePose to_base(const PanoramaPose& pose, const Mountings& mountings);

/// The same where the panorama's stamp is uncertain: where the vehicle is by then is not where it was. `twist`: of its base in its own
/// axes, m/s and rad/s. The landmark's panorama had as uncertain a stamp; the twist of then is not known, that of now stands for it.
BasePose with_uncertain_stamp(const BasePose& pose, const vision::Vector6d& twist, double stamp_sigma_s);

/// The correction in metres that a match carries: of a locked landmark that has a pose in this panorama, or the rejection of one
/// that has none. Nothing for other states: the pose of a matched one was told when its panorama came.
std::optional<PositionCorrection> metric_correction(const LandmarkMatch& match, const Mountings& mountings);

}  // namespace panvo::position_corrector
