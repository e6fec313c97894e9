// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/bearing_pair.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "panvo/landmarks/keypoints.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::places {
namespace {

constexpr double kPi = std::numbers::pi;

/// Share of a full turn for which low <= A cos(a) + B <= high.
double share_between(double a, double b, double low, double high) {
  if (a < 1e-9) return b >= low && b <= high ? 1.0 : 0.0;
  const auto angle = [&](double value) { return std::acos(std::clamp((value - b) / a, -1.0, 1.0)); };
  return (angle(low) - angle(high)) / kPi;
}

/// Radius about the vertical axis.
double flat(const Eigen::Vector3d& bearing) { return std::hypot(bearing.x(), bearing.z()); }

}  // namespace

std::vector<BearingPair> pair_bearings(std::span<const landmarks::Keypoint> query,
                                       std::span<const landmarks::Keypoint> place, double descriptor_ratio,
                                       double same_object_deg) {
  auto matches = landmarks::match_keypoints(query, place, static_cast<float>(descriptor_ratio));
  std::stable_sort(matches.begin(), matches.end(),
                   [](const auto& a, const auto& b) { return a.distance < b.distance; });
  const double close = std::cos(same_object_deg * vision::kDegree);
  std::vector<BearingPair> pairs;
  for (const auto& match : matches) {
    const BearingPair pair{place[static_cast<std::size_t>(match.landmark)].bearing.cast<double>().normalized(),
                           query[static_cast<std::size_t>(match.query)].bearing.cast<double>().normalized()};
    const bool is_known = std::any_of(pairs.begin(), pairs.end(), [&](const BearingPair& other) {
      return other.panorama.dot(pair.panorama) > close && other.landmark.dot(pair.landmark) > close;
    });
    if (!is_known) pairs.push_back(pair);
  }
  return pairs;
}

double probability_at_angle(const Eigen::Vector3d& query, const Eigen::Vector3d& expected) {
  const double radius = flat(expected);
  return share_between(radius * radius, expected.y() * expected.y(), query.dot(expected), 1.0);
}

double probability_at_plane(const Eigen::Vector3d& query, const Eigen::Vector3d& normal) {
  const double distance = std::abs(query.dot(normal));
  return std::max(distance, share_between(flat(query) * flat(normal), query.y() * normal.y(), -distance, distance));
}

}  // namespace panvo::places
