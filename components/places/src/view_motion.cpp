// SPDX-License-Identifier: Apache-2.0
#include "view_motion.hpp"

#include <algorithm>
#include <cmath>

#include "panvo/vision/angle.hpp"

namespace panvo::places {
namespace {

using Eigen::Vector3d;

constexpr double kNoted = 0.1;         // a larger probability by chance is no evidence
constexpr double kMaxAtPlane = 0.25;   // the same for a plane, which many bearings are near
constexpr double kMostEvidence = 5.0;  // nats of one pair: less than p = 0.001 says more of the pair than of the motion
constexpr double kMaxEpipolar_rad = 5.0 * vision::kDegree;  // from the plane: farther is a contradiction
constexpr double kAlike_rad = 1.0 * vision::kDegree;        // between bearings: below, the sign of the range is noise

}  // namespace

/// Whether the point lies ahead along both bearings; true if it is too far to tell.
bool is_ahead(const Vector3d& place, const Vector3d& turned_query, const Vector3d& baseline) {
  const Vector3d normal = place.cross(turned_query);
  if (normal.norm() < std::sin(kAlike_rad)) return true;
  return baseline.cross(turned_query).dot(normal) > 0.0 && baseline.cross(place).dot(normal) > 0.0;
}

int sample_size(ViewModel model) {
  switch (model) {
    case ViewModel::kRotation:
      return 2;
    case ViewModel::kEqualRange:
      return 3;
    default:
      return 5;
  }
}

namespace {

double probability_of_residual(const BearingPair& pair, const ViewMotion& motion) {
  if (motion.model != ViewModel::kEpipolar) {
    const Vector3d expected = (motion.rotation.transpose() * (pair.landmark - motion.translation)).normalized();
    return probability_at_angle(pair.panorama, expected);
  }
  const Vector3d normal = pair.landmark.cross(motion.translation);
  const double length = normal.norm();
  if (length < kNearEpipole) return 1.0;
  const Vector3d in_query = motion.rotation.transpose() * normal / length;
  if (std::abs(pair.panorama.dot(in_query)) > std::sin(kMaxEpipolar_rad)) return 1.0;
  if (!is_ahead(pair.landmark, motion.rotation * pair.panorama, motion.translation)) return 1.0;
  return probability_at_plane(pair.panorama, in_query);
}

}  // namespace

double probability(const BearingPair& pair, const ViewMotion& motion) {
  const double p = probability_of_residual(pair, motion);
  // Many weak agreements would add up wherever the model of chance is a little wrong.
  return p <= (motion.model == ViewModel::kEpipolar ? kMaxAtPlane : kNoted) ? p : 1.0;
}

std::vector<double> probabilities(const std::vector<BearingPair>& pairs, const ViewMotion& motion) {
  std::vector<double> values;
  values.reserve(pairs.size());
  for (const auto& pair : pairs) values.push_back(probability(pair, motion));
  return values;
}

double evidence(const std::vector<BearingPair>& pairs, const ViewMotion& motion) {
  double sum = 0.0;
  for (const auto& pair : pairs) {
    const double p = probability(pair, motion);
    if (p < kNoted) sum += std::min(kMostEvidence, std::log(kNoted / std::max(p, 1e-9)));
  }
  return sum;
}

}  // namespace panvo::places
