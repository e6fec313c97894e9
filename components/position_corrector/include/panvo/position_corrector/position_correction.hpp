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
  kWeak,          ///< the same, but from few points: needs confirmation
  kRotationOnly,  ///< rotation of the vehicle; position unknown
  kRejected,      ///< looked like the landmark, but geometry determines no pose
};

/// Pose of the vehicle's base relative to the base at the landmark's panorama.
struct BasePose {
  Eigen::Isometry3d landmark_from_base = Eigen::Isometry3d::Identity();  ///< base frames, m
  vision::Matrix6d covariance = vision::Matrix6d::Zero();                ///< as vision::pose_error
};

/// Correction of the vehicle's pose from one panorama.
struct PositionCorrection {
  CorrectionState state = CorrectionState::kRejected;
  std::string reason;  ///< why rejected, weak or rotation only; empty when full
  std::int64_t stamp_ns = 0;
  std::uint32_t landmark_id = 0;
  int inliers = 0;
  BasePose pose;  ///< meaningless when rejected
};

/// Extrinsics of the panoramic camera when the landmark was built, and now.
struct Mountings {
  Eigen::Isometry3d base_from_panorama_then = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d base_from_panorama_now = Eigen::Isometry3d::Identity();
};

/// Converts a pose between panoramas to one between bases. The extrinsics are taken as exact; a rotation error is
/// propagated through the lever arm from the panorama to the base.
BasePose to_base(const PanoramaPose& pose, const Mountings& mountings);

/// Adds the effect of an uncertain stamp, i.e. of the vehicle's motion within the stamp error. `twist`: of the base in
/// its own axes, m/s and rad/s. The landmark's stamp is equally uncertain; its unknown twist is replaced by the current
/// one.
BasePose with_uncertain_stamp(const BasePose& pose, const vision::Vector6d& twist, double stamp_sigma_s);

/// Correction in metres from a match: the pose of a locked landmark in this panorama, or the rejection if it has none.
/// nullopt for other states: the pose of a matched landmark was returned with its own panorama.
std::optional<PositionCorrection> metric_correction(const LandmarkMatch& match, const Mountings& mountings);

}  // namespace panvo::position_corrector
