// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/view_overlap.hpp"

#include <algorithm>
#include <cmath>

#include "panvo/vision/angle.hpp"

namespace panvo::stereo_places {
namespace {

using landmarks::Keypoint;

constexpr double kMaxZoom = 1.5;
constexpr double kStayed = 0.4 * vision::kDegree;  // noise of keypoints and vibration of the bodywork
constexpr double kMoved = 1.5 * vision::kDegree;   // things that are not on the vehicle
constexpr int kSameDescriptor = 200 * 200;         // squared distance; of different things it is about 400

int squared_distance(const Keypoint& a, const Keypoint& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.descriptor.size(); ++i) {
    const int difference = static_cast<int>(a.descriptor[i]) - static_cast<int>(b.descriptor[i]);
    sum += difference * difference;
  }
  return sum;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

double shared_view(std::span<const Eigen::Vector3d> points, const vision::PinholeCamera& camera,
                   const Eigen::Isometry3d& place_from_view) {
  if (points.empty()) return 0.0;
  const Eigen::Isometry3d view_from_place = place_from_view.inverse();
  const auto is_shared = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d seen = view_from_place * point;
    const double zoom = seen.norm() / point.norm();
    return seen.z() > 0.0 && zoom < kMaxZoom && zoom > 1.0 / kMaxZoom && camera.contains(camera.project(seen));
  };
  return static_cast<double>(std::count_if(points.begin(), points.end(), is_shared)) /
         static_cast<double>(points.size());
}

std::vector<Keypoint> without_own_body(std::span<const Keypoint> keypoints, std::span<const Keypoint> before,
                                       const Eigen::Isometry3d& before_from_now) {
  std::vector<Keypoint> kept;
  for (const auto& keypoint : keypoints) {
    const Eigen::Vector3d bearing = keypoint.bearing.cast<double>();
    const Eigen::Vector3d expected = before_from_now * keypoint.point_in_panorama.cast<double>();
    const bool would_move = keypoint.has_point && angle_between(bearing, expected) > kMoved;
    const bool has_stayed = would_move && std::any_of(before.begin(), before.end(), [&](const Keypoint& other) {
                              return angle_between(bearing, other.bearing.cast<double>()) < kStayed &&
                                     squared_distance(keypoint, other) < kSameDescriptor;
                            });
    if (!has_stayed) kept.push_back(keypoint);
  }
  return kept;
}

}  // namespace panvo::stereo_places
