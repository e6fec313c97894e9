// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/disparity_offset.hpp"

#include <algorithm>
#include <cmath>

#include "panvo/landmarks/keypoints.hpp"
#include "panvo/vision/robust_loss.hpp"

namespace panvo::stereo_places {
namespace {

constexpr double kPrior_px = 0.5;       // of a calibration months ago
constexpr double kStep_px = 0.005;      // random walk per view: temperature
constexpr double kDisparity_px = 0.25;  // of a single disparity
constexpr double kPathError = 0.012;    // of the odometry over a few metres, relative
constexpr double kMinPath_m = 0.5, kMaxPath_m = 10.0;
constexpr double kAstray = 4.0;  // standard deviations across the direction in which a point moves
constexpr double kAlike = 3.0;   // views of one place share its disparities: three count as one
constexpr std::size_t kMinMatches = 15;
constexpr double kLossScale = 2.0;  // standard deviations
constexpr float kRatio = 0.8F;

Eigen::Vector3d bearing_of(const Eigen::Isometry3d& view_from_place, const Eigen::Vector3d& ray, double depth_m) {
  return (view_from_place * (depth_m * ray)).normalized();
}

}  // namespace

DisparityOffset::DisparityOffset(const vision::RectifiedStereo& stereo, double bearing_sigma_rad)
    : focal_baseline_(stereo.camera.fx * stereo.baseline_m),
      bearing_sigma_rad_(bearing_sigma_rad),
      variance_px2_(kPrior_px * kPrior_px) {}

double DisparityOffset::sigma_px() const noexcept { return std::sqrt(variance_px2_); }

void DisparityOffset::begin(std::vector<landmarks::Keypoint> place, const Eigen::Isometry3d& odom_from_place) {
  place_ = Place{std::move(place), odom_from_place, offset_px_};
}

/// The offset beyond that of the place at which the point is seen where it is; first order. nullopt if it is not on the
/// line on which offsets move it.
std::optional<DisparityOffset::Measured> DisparityOffset::measure(const landmarks::Keypoint& known,
                                                                  const landmarks::Keypoint& seen,
                                                                  const Eigen::Isometry3d& view_from_place) const {
  constexpr double kDelta_px = 0.02;
  const Eigen::Vector3d point = known.point_in_panorama.cast<double>();
  const Eigen::Vector3d ray = point / point.z();
  const double disparity_px = focal_baseline_ / point.z();
  if (disparity_px < 4.0 * kDelta_px) return std::nullopt;
  const Eigen::Vector3d expected = bearing_of(view_from_place, ray, point.z());
  const Eigen::Vector3d moved = bearing_of(view_from_place, ray, focal_baseline_ / (disparity_px - kDelta_px));
  const Eigen::Vector3d by_offset = (moved - expected) / kDelta_px;
  const Eigen::Vector3d error = seen.bearing.cast<double>() - expected;
  const double squared = by_offset.squaredNorm();
  if (squared < 1e-12) return std::nullopt;
  const double offset_px = error.dot(by_offset) / squared;
  const double bearing_variance = 2.0 * bearing_sigma_rad_ * bearing_sigma_rad_;  // at the place and in the view
  if ((error - offset_px * by_offset).squaredNorm() > kAstray * kAstray * bearing_variance) return std::nullopt;
  const double path_px = kPathError * disparity_px;
  return Measured{offset_px, bearing_variance / squared + kDisparity_px * kDisparity_px + path_px * path_px};
}

void DisparityOffset::add(std::span<const landmarks::Keypoint> view, const Eigen::Isometry3d& odom_from_view) {
  if (!place_) return;
  const Eigen::Isometry3d view_from_place = odom_from_view.inverse() * place_->odom_from_place;
  const double path_m = view_from_place.translation().norm();
  if (path_m < kMinPath_m || path_m > kMaxPath_m) return;
  std::vector<Measured> measured;
  for (const auto& match : landmarks::match_keypoints(view, place_->keypoints, kRatio)) {
    const auto one = measure(place_->keypoints[static_cast<std::size_t>(match.landmark)],
                             view[static_cast<std::size_t>(match.query)], view_from_place);
    if (one) measured.push_back(*one);
  }
  if (measured.size() < kMinMatches) return;
  variance_px2_ += kStep_px * kStep_px;
  const vision::CauchyLoss loss(kLossScale);
  double mean_px = offset_px_ - place_->offset_px, information = 0.0;
  for (int i = 0; i < 5; ++i) {
    double sum = 0.0;
    information = 0.0;
    for (const auto& one : measured) {
      const double off_px = one.offset_px - mean_px;
      // Includes the uncertainty of the filter, so that the first views are not taken for outliers.
      const double weight = loss.weight(off_px * off_px / (one.variance_px2 + variance_px2_)) / one.variance_px2;
      information += weight;
      sum += weight * one.offset_px;
    }
    mean_px = sum / information;
  }
  const double variance_px2 = kAlike / information;
  const double gain = variance_px2_ / (variance_px2_ + variance_px2);
  offset_px_ += gain * (place_->offset_px + mean_px - offset_px_);
  variance_px2_ *= 1.0 - gain;
}

}  // namespace panvo::stereo_places
