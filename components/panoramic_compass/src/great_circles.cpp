// SPDX-License-Identifier: Apache-2.0
#include "great_circles.hpp"

#include <algorithm>

#include "panvo/vision/pose.hpp"

namespace panvo::panoramic_compass {
namespace {

constexpr double kNearPole = 0.05;  // sine

}  // namespace

Motion Motion::moved(const Vector5d& step) const {
  const auto [level, upright] = tangents();
  const Eigen::Vector3d turned = drift + step(3) * level + step(4) * upright;
  return {vision::so3_exp(step.head<3>()) * rotation, turned.normalized()};
}

std::optional<Deviation> deviation_of(const BearingPair& pair, const Motion& motion) {
  Deviation d;
  d.predicted = motion.rotation * pair.then;
  const Eigen::Vector3d cross = d.predicted.cross(motion.drift);
  d.sine = cross.norm();
  if (d.sine < kNearPole) return std::nullopt;
  d.normal = cross / d.sine;
  const double q = pair.now.dot(d.normal);
  d.across = std::asin(std::clamp(q, -1.0, 1.0));
  d.along = std::atan2(pair.now.dot(d.normal.cross(d.predicted)), pair.now.dot(d.predicted));
  d.lever = (pair.now - q * d.normal) / d.sine;
  const Eigen::Vector3d azimuth = Eigen::Vector3d::UnitZ().cross(pair.now).normalized();
  const Eigen::Vector3d elevation = pair.now.cross(azimuth);
  const Eigen::Vector3d forward = d.normal.cross(pair.now);
  const auto variance = [&](const Eigen::Vector3d& direction) {
    return pair.variance_rad2.x() * std::pow(direction.dot(azimuth), 2) +
           pair.variance_rad2.y() * std::pow(direction.dot(elevation), 2);
  };
  d.across_variance = variance(d.normal);
  d.along_variance = variance(forward);
  return d;
}

void orient(std::span<const BearingPair> pairs, Motion& motion) {
  double sum = 0.0;
  for (const BearingPair& pair : pairs) {
    const auto d = deviation_of(pair, motion);
    if (d && d->across * d->across < kAgreeing * d->across_variance) sum += std::clamp(d->along, -0.1, 0.1);
  }
  if (sum < 0.0) motion.drift = -motion.drift;
}

double disagreement(const Deviation& d, double noise) {
  const double across = d.across * d.across / (noise * d.across_variance);
  const double behind = d.along < 0.0 ? d.along * d.along / (noise * d.along_variance) : 0.0;
  return std::max(across, behind);
}

double total_disagreement(std::span<const BearingPair> pairs, const Motion& motion, double noise) {
  double total = 0.0;
  for (const BearingPair& pair : pairs) {
    if (const auto d = deviation_of(pair, motion)) total += std::min(disagreement(*d, noise), kAgreeing);
  }
  return total;
}

}  // namespace panvo::panoramic_compass
