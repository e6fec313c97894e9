// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/gnss_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace panvo::localizer {
namespace {

constexpr std::size_t kLeastSamples = 5;      // two determine the alignment, the others test it
constexpr double kLengthSigmas = 10.0;        // then the direction is known to 0.1 rad
constexpr double kWayRatio = 2.0;             // of a path with bends over its length
constexpr double kOdometryDriftRatio = 0.02;  // of odometry over the path, twice that of a poor calibration
constexpr double kMaxMeanSquare = 4.0;        // of the errors over their standard deviation: stated twice too small

double horizontal_variance(const GnssFix& fix) { return 0.5 * (fix.covariance(0, 0) + fix.covariance(1, 1)); }

Eigen::Vector3d antenna_in_odom(const GnssTrial::Sample& sample) {
  return sample.at.pose.odom_from_base * sample.fix.antenna_in_base_m;
}

/// Rotation about the vertical and translation with the least squared error.
Eigen::Isometry3d aligned(const std::deque<GnssTrial::Sample>& samples) {
  Eigen::Vector3d mean_enu = Eigen::Vector3d::Zero(), mean_odom = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (const auto& sample : samples) {
    const double weight = 1.0 / horizontal_variance(sample.fix);
    mean_enu += weight * sample.fix.enu_m;
    mean_odom += weight * antenna_in_odom(sample);
    weights += weight;
  }
  mean_enu /= weights;
  mean_odom /= weights;
  double cosine = 0.0, sine = 0.0;
  for (const auto& sample : samples) {
    const double weight = 1.0 / horizontal_variance(sample.fix);
    const Eigen::Vector3d e = sample.fix.enu_m - mean_enu, o = antenna_in_odom(sample) - mean_odom;
    cosine += weight * (e.x() * o.x() + e.y() * o.y());
    sine += weight * (e.x() * o.y() - e.y() * o.x());
  }
  Eigen::Isometry3d odom_from_enu = Eigen::Isometry3d::Identity();
  odom_from_enu.linear() = Eigen::AngleAxisd(std::atan2(sine, cosine), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  odom_from_enu.translation() = mean_odom - odom_from_enu.linear() * mean_enu;
  return odom_from_enu;
}

}  // namespace

void GnssTrial::add(const Sample& sample, double least_m) {
  samples_.push_back(sample);
  if (samples_.size() <= kMaxSamples) return;
  const double needed_m = std::max(least_m, kWayRatio * kLengthSigmas * std::sqrt(horizontal_variance(sample.fix)));
  if (way_m(1) >= needed_m) return samples_.pop_front();
  // Without the sample that leaves the smallest gap, but neither the first nor the last.
  std::size_t least = 1;
  const auto gap_m = [&](std::size_t k) { return samples_[k + 1].at.way_m - samples_[k - 1].at.way_m; };
  for (std::size_t k = 2; k + 1 < samples_.size(); ++k) {
    if (gap_m(k) < gap_m(least)) least = k;
  }
  samples_.erase(samples_.begin() + static_cast<std::ptrdiff_t>(least));
}

void GnssTrial::refresh(const OdometryBuffer& chain) {
  for (auto& sample : samples_) {
    if (const auto at = chain.at(sample.fix.stamp_ns)) sample.at = *at;
  }
}

std::optional<GnssTrial::Result> GnssTrial::result(double least_m) const {
  if (samples_.size() < kLeastSamples) return std::nullopt;
  const Eigen::Vector3d first = antenna_in_odom(samples_.front());
  double length_m = 0.0, largest_variance = 0.0, enu_length_m = 0.0;
  for (const auto& sample : samples_) {
    length_m = std::max(length_m, (antenna_in_odom(sample) - first).head<2>().norm());
    enu_length_m = std::max(enu_length_m, (sample.fix.enu_m - samples_.front().fix.enu_m).head<2>().norm());
    largest_variance = std::max(largest_variance, horizontal_variance(sample.fix));
  }
  if (way_m(0) < least_m || length_m < kLengthSigmas * std::sqrt(largest_variance)) return std::nullopt;

  Result result;
  result.odom_from_enu = aligned(samples_);
  const double middle_m = samples_.front().at.way_m + 0.5 * way_m(0);
  double sum = 0.0;
  for (const auto& sample : samples_) {
    const Eigen::Vector3d apart = result.odom_from_enu * sample.fix.enu_m - antenna_in_odom(sample);
    const double drift_m = kOdometryDriftRatio * (sample.at.way_m - middle_m);
    sum += 0.5 * apart.head<2>().squaredNorm() / (horizontal_variance(sample.fix) + drift_m * drift_m);
  }
  const double mean_square = sum / static_cast<double>(samples_.size());
  result.agrees = mean_square <= kMaxMeanSquare;
  if (!result.agrees) {
    result.reason = fmt::format(
        "their path differs from the odometry's: over {:.0f} m by {:.1f} of their standard deviations; {:.0f} m long",
        length_m, std::sqrt(mean_square), enu_length_m);
  }
  return result;
}

}  // namespace panvo::localizer
