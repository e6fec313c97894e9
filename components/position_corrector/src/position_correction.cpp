// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/position_correction.hpp"

namespace panvo::position_corrector {

BasePose to_base(const PanoramaPose& pose, const Mountings& mountings) {
  const vision::Matrix6d exact = vision::Matrix6d::Zero();
  const Eigen::Isometry3d base_from_panorama = mountings.base_from_panorama_then * pose.landmark_from_panorama;
  const auto covariance = vision::compose_covariance(mountings.base_from_panorama_then, exact,
                                                     pose.landmark_from_panorama, pose.covariance);
  const Eigen::Isometry3d panorama_from_base = mountings.base_from_panorama_now.inverse();
  return {base_from_panorama * panorama_from_base,
          vision::compose_covariance(base_from_panorama, covariance, panorama_from_base, exact)};
}

BasePose with_uncertain_stamp(const BasePose& pose, const vision::Vector6d& twist, double stamp_sigma_s) {
  BasePose wider = pose;
  wider.covariance += 2.0 * vision::stamp_covariance(pose.landmark_from_base, twist, stamp_sigma_s);  // both stamps
  return wider;
}

std::optional<PositionCorrection> metric_correction(const LandmarkMatch& match, const Mountings& mountings) {
  if (match.state != MatchState::kLocked && match.state != MatchState::kRejected) return std::nullopt;
  PositionCorrection correction;
  correction.stamp_ns = match.stamp_ns;
  correction.landmark_id = match.landmark_id;
  correction.inliers = match.inliers;
  if (match.state == MatchState::kLocked && match.pose) {
    correction.state = CorrectionState::kFull;
    correction.pose = to_base(*match.pose, mountings);
  } else {
    correction.reason = match.reason;
    if (match.weak_pose) {
      correction.state = CorrectionState::kWeak;
      correction.pose = to_base(*match.weak_pose, mountings);
    }
  }
  return correction;
}

}  // namespace panvo::position_corrector
