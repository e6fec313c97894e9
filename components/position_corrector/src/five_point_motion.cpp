// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/five_point_motion.hpp"

#include <fmt/format.h>

#include <cmath>
#include <opengv/relative_pose/CentralRelativeAdapter.hpp>
#include <opengv/sac/Ransac.hpp>
#include <opengv/sac_problems/relative_pose/CentralRelativePoseSacProblem.hpp>
#include <vector>

#include "panvo/landmarks/keypoints.hpp"
#include "panvo/position_corrector/epipolar_refinement.hpp"
#include "panvo/vision/angle.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::position_corrector {
namespace {

constexpr int kSample = 8;  // five for the motion, three to choose among its solutions

double angle_of(const Eigen::Matrix3d& rotation) { return vision::so3_log(rotation).norm(); }

/// Five-point problem that rejects samples with a large rotation.
class SmallRotation final : public opengv::sac_problems::relative_pose::CentralRelativePoseSacProblem {
 public:
  SmallRotation(adapter_t& adapter, double max_rad)
      : CentralRelativePoseSacProblem(adapter, STEWENIUS, false),  // own, constant seed
        max_rad_(max_rad) {}

  bool computeModelCoefficients(const std::vector<int>& indices, model_t& model) const override {
    return CentralRelativePoseSacProblem::computeModelCoefficients(indices, model) && model.allFinite() &&
           angle_of(vision::nearest_rotation(model.leftCols<3>())) <= max_rad_;
  }

 private:
  double max_rad_;
};

struct Consensus {
  EpipolarMotion motion;
  std::vector<BearingPair> inliers;
};

/// RANSAC over roughly aligned pairs.
std::optional<Consensus> five_point_ransac(const std::vector<BearingPair>& aligned,
                                           const FivePointParameters& parameters) {
  opengv::bearingVectors_t landmark, panorama;
  for (const auto& pair : aligned) {
    landmark.push_back(pair.landmark);
    panorama.push_back(pair.panorama);
  }
  opengv::relative_pose::CentralRelativeAdapter adapter(landmark, panorama);
  opengv::sac::Ransac<SmallRotation> ransac;
  ransac.sac_model_.reset(new SmallRotation(adapter, parameters.max_rotation_deg * vision::kDegree));
  // the distance measure of opengv adds the terms of both bearings
  ransac.threshold_ = 2.0 * (1.0 - std::cos(parameters.inlier_angle_deg * vision::kDegree));
  ransac.max_iterations_ = parameters.iterations;
  if (!ransac.computeModel()) return std::nullopt;
  Consensus found;
  found.motion.rotation = vision::nearest_rotation(ransac.model_coefficients_.leftCols<3>());
  found.motion.direction = ransac.model_coefficients_.col(3).normalized();
  if (!found.motion.direction.allFinite()) return std::nullopt;
  for (const int i : ransac.inliers_) found.inliers.push_back(aligned[static_cast<std::size_t>(i)]);
  return found;
}

}  // namespace

FivePointResult estimate_five_point_motion(std::span<const landmarks::Keypoint> panorama,
                                           std::span<const landmarks::Keypoint> landmark, double heading_rad,
                                           const FivePointParameters& parameters) {
  // a left turn by the heading is a rotation about -Y, as Y points down
  const Eigen::Matrix3d turn = vision::so3_exp(Eigen::Vector3d(0.0, -heading_rad, 0.0));
  const landmarks::AzimuthWindow window{heading_rad, parameters.azimuth_window_deg * vision::kDegree};
  std::vector<BearingPair> aligned;
  for (const auto& match :
       match_keypoints(panorama, landmark, static_cast<float>(parameters.descriptor_ratio), window)) {
    const auto& then = landmark[static_cast<std::size_t>(match.landmark)].bearing;
    const auto& now = panorama[static_cast<std::size_t>(match.query)].bearing;
    aligned.push_back({then.cast<double>().normalized(), turn * now.cast<double>().normalized()});
  }
  FivePointResult result;
  result.matches = static_cast<int>(aligned.size());
  const auto few = [&](std::string_view what, int count) {
    result.reason = fmt::format("{} {} of {} needed", count, what, parameters.min_inliers);
    return result;
  };
  if (result.matches < std::max(parameters.min_inliers, kSample)) return few("matched keypoints", result.matches);
  const auto found = five_point_ransac(aligned, parameters);
  result.inliers = found ? static_cast<int>(found->inliers.size()) : 0;
  if (result.inliers < parameters.min_inliers) return few("inliers", result.inliers);

  const auto refined =
      refine_epipolar_motion(found->motion, found->inliers, parameters.bearing_sigma_deg * vision::kDegree);
  if (const double angle_deg = angle_of(refined.rotation) / vision::kDegree; angle_deg > parameters.max_rotation_deg) {
    result.reason = fmt::format("rotated by {:.0f} deg beyond the heading, at most {:.0f} allowed", angle_deg,
                                parameters.max_rotation_deg);
    return result;
  }
  result.motion = FivePointMotion{refined.rotation * turn, refined.direction, refined.covariance};
  return result;
}

}  // namespace panvo::position_corrector
