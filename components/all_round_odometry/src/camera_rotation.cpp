// SPDX-License-Identifier: Apache-2.0
#include "panvo/all_round_odometry/camera_rotation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "panvo/vision/median.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/robust_loss.hpp"

namespace panvo::all_round_odometry {
namespace {

constexpr double kMinWay_m = 0.5;       // for a direction
constexpr std::size_t kMinPoints = 20;  // fewer may agree by chance
constexpr double kPoint_rad = 1e-3;     // of a bearing, besides its stated error: lens, stitching
constexpr double kCommon_rad = 0.005;   // of all points of a panorama, with the motion
constexpr double kDrift_rad = 2e-4;     // between two panoramas
constexpr double kFloor_rad = 0.003;    // error that lasts: of the stereo camera's own direction
constexpr double kKnock = 6.0;          // standard deviations
constexpr int kMaxKnocked = 5;          // panoramas: then the camera was rotated on its mount
constexpr double kUnknown_rad = 0.5;    // standard deviation after that

/// Deviation of a point's bearings from the plane that contains the motion.
struct Deviation {
  double error;
  Eigen::Vector3d by_rotation;  // derivative by a small rotation of both bearings
  double variance;
};

Deviation deviation_of(const Sighting& sighting, const Eigen::Matrix3d& base_from_stated,
                       const Eigen::Matrix3d& then_from_now, const Eigen::Vector3d& way) {
  const Eigen::Vector3d then = base_from_stated * sighting.then;
  const Eigen::Vector3d now = then_from_now * (base_from_stated * sighting.now);
  const double cosine = then.dot(now);
  return {way.dot(then.cross(now)),
          way.dot(then) * now - cosine * way + then_from_now.transpose() * (cosine * way - way.dot(now) * then),
          sighting.variance_rad2.mean() + kPoint_rad * kPoint_rad};
}

}  // namespace

Eigen::Matrix3d CameraRotation::covariance() const {
  return covariance_ + kFloor_rad * kFloor_rad * Eigen::Matrix3d::Identity();
}

void CameraRotation::add(const PointTracks& tracks, const Eigen::Isometry3d& then_from_now) {
  const double way_m = then_from_now.translation().norm();
  if (way_m < kMinWay_m || tracks.sightings.size() < kMinPoints) return;
  const Eigen::Vector3d way = then_from_now.translation() / way_m;
  std::vector<Deviation> deviations;
  std::vector<double> sizes;
  for (const Sighting& sighting : tracks.sightings) {
    deviations.push_back(deviation_of(sighting, base_from_stated_, then_from_now.linear(), way));
    sizes.push_back(std::abs(deviations.back().error) / std::sqrt(deviations.back().variance));
  }
  // The loss is as wide as most deviations, so that a large rotation is seen, too.
  const vision::CauchyLoss loss(std::max(2.0, 2.0 * vision::median(sizes)));
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (const Deviation& deviation : deviations) {
    const double weight = loss.weight(deviation.error * deviation.error / deviation.variance) / deviation.variance;
    information += weight * deviation.by_rotation * deviation.by_rotation.transpose();
    gradient -= weight * deviation.error * deviation.by_rotation;
  }
  // With the common error, the covariance inverse(information) becomes that plus kCommon_rad^2.
  const Eigen::Matrix3d with_common = (Eigen::Matrix3d::Identity() + kCommon_rad * kCommon_rad * information).inverse();
  const Eigen::Matrix3d predicted = covariance_ + kDrift_rad * kDrift_rad * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d posterior = (predicted.inverse() + with_common * information).inverse();
  const Eigen::Vector3d rotation = posterior * (with_common * gradient);
  const Eigen::Matrix3d change = predicted - posterior;  // covariance of what the panorama changes
  const Eigen::LDLT<Eigen::Matrix3d> changes(change + 1e-12 * Eigen::Matrix3d::Identity());
  if (rotation.dot(changes.solve(rotation)) > kKnock * kKnock) {
    if (++contradicted_ >= kMaxKnocked) {
      covariance_ = kUnknown_rad * kUnknown_rad * Eigen::Matrix3d::Identity();
      contradicted_ = 0;
    }
    return;
  }
  contradicted_ = 0;
  covariance_ = 0.5 * (posterior + posterior.transpose());
  base_from_stated_ = vision::nearest_rotation(vision::so3_exp(rotation) * base_from_stated_);
}

}  // namespace panvo::all_round_odometry
