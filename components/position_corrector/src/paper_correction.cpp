// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/paper_correction.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace panvo::position_corrector {

PositionCorrection paper_correction(const LandmarkMatch& match, std::span<const landmarks::Keypoint> landmark,
                                    const Mountings& mountings, const PaperCorrectionParameters& parameters) {
  if (match.state != MatchState::kMatched || !match.pass) {
    throw std::invalid_argument("paper_correction: requires a matched landmark with its pass");
  }
  PositionCorrection correction;
  correction.stamp_ns = match.stamp_ns;
  correction.landmark_id = match.landmark_id;
  const auto found =
      estimate_five_point_motion(match.pass->keypoints, landmark, match.heading_rad, parameters.five_point);
  correction.inliers = found.inliers;
  if (!found.motion) {
    correction.reason = found.reason;
    return correction;
  }
  // both panoramas are assumed at the same position
  PanoramaPose pose;
  pose.landmark_from_panorama.linear() = found.motion->rotation;
  pose.covariance.bottomRightCorner<3, 3>() = found.motion->covariance;
  const bool steep = is_steep(match.pass->curve, parameters.steepness);
  const double variance_m2 = steep ? parameters.position_sigma_m * parameters.position_sigma_m : kUnknownPosition_m2;
  pose.covariance.topLeftCorner<3, 3>() = variance_m2 * Eigen::Matrix3d::Identity();
  correction.pose = to_base(pose, mountings);
  correction.state = steep ? CorrectionState::kFull : CorrectionState::kRotationOnly;
  if (steep) return correction;
  const auto slope = curve_slope(match.pass->curve, parameters.steepness.way_m);
  correction.reason = slope ? fmt::format("the distance curve is flat: it rises by {:.3f} per metre, {:.3f} needed",
                                          *slope, parameters.steepness.min_slope)
                            : "the distance curve is too short";
  return correction;
}

}  // namespace panvo::position_corrector
