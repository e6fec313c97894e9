// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/keypoint_triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "panvo/landmarks/keypoints.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::landmark_builder {
namespace {

using landmarks::Keypoint;

constexpr double kMatchWindow_rad = 40.0 * vision::kDegree;  // parallax of very near points
constexpr int kMaxSteps = 10;

/// A neighbour's bearing of the keypoint and the neighbour's position, in the landmark's frame.
struct Observation {
  Eigen::Vector3d bearing;
  Eigen::Vector3d from;
};

struct Range {
  double inverse = 0.0;
  double sigma = 0.0;
};

/// Reprojection error of the point bearing / inverse, perpendicular to the observed bearing, and its derivative.
struct Residual {
  Eigen::Vector3d value;
  Eigen::Vector3d by_inverse;
};

std::optional<Residual> residual(const Eigen::Vector3d& bearing, const Observation& seen, double inverse) {
  const Eigen::Vector3d away = bearing - inverse * seen.from;  // scaled by the inverse range
  const double length = away.norm();
  const Eigen::Vector3d expected = away / length;
  if (length < 1e-9 || expected.dot(seen.bearing) <= 0.0) return std::nullopt;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - seen.bearing * seen.bearing.transpose();
  const Eigen::Vector3d change = -(Eigen::Matrix3d::Identity() - expected * expected.transpose()) * seen.from / length;
  return Residual{across * expected, across * change};
}

std::optional<Range> fit(const Eigen::Vector3d& bearing, const std::vector<Observation>& seen, double sigma_rad) {
  Range range;
  double information = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int step = 0; step < kMaxSteps; ++step) {
    double gradient = 0.0;
    information = 0.0;
    sum.setZero();
    for (const auto& one : seen) {
      const auto term = residual(bearing, one, range.inverse);
      if (!term) return std::nullopt;
      information += term->by_inverse.squaredNorm();
      gradient += term->by_inverse.dot(term->value);
      sum += term->by_inverse;
    }
    if (information <= 0.0) return std::nullopt;
    const double change = -gradient / information;
    range.inverse += change;
    if (std::abs(change) < 1e-7) break;
  }
  if (!std::isfinite(range.inverse)) return std::nullopt;
  // the error of the landmark's own bearing is common to all terms; between neighbours on both sides it cancels
  range.sigma = sigma_rad * std::sqrt(1.0 / information + sum.squaredNorm() / (information * information));
  return range;
}

double max_error(const Eigen::Vector3d& bearing, const std::vector<Observation>& seen, double inverse,
                 std::size_t& worst) {
  double largest = -1.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto term = residual(bearing, seen[i], inverse);
    const double error = term ? term->value.norm() : std::numbers::pi;
    if (error <= largest) continue;
    largest = error;
    worst = i;
  }
  return largest;
}

double yaw_of(const Eigen::Matrix3d& rotation) { return -std::atan2(rotation(0, 2), rotation(2, 2)); }

}  // namespace

int triangulate_keypoints(std::span<Keypoint> landmark, std::span<const NeighbourPanorama> neighbours,
                          const TriangulationParameters& parameters) {
  const double sigma_rad = parameters.bearing_sigma_deg * vision::kDegree;
  const double gate_rad = parameters.gate_sigmas * std::numbers::sqrt2 * sigma_rad;
  std::vector<std::vector<Observation>> observations(landmark.size());
  for (const auto& neighbour : neighbours) {
    const Eigen::Matrix3d rotation = neighbour.landmark_from_neighbour.linear();
    const landmarks::AzimuthWindow window{yaw_of(rotation), kMatchWindow_rad};
    for (const auto& match :
         match_keypoints(neighbour.keypoints, landmark, static_cast<float>(parameters.descriptor_ratio), window)) {
      const auto& seen = neighbour.keypoints[static_cast<std::size_t>(match.query)];
      observations[static_cast<std::size_t>(match.landmark)].push_back(
          {rotation * seen.bearing.cast<double>().normalized(), neighbour.landmark_from_neighbour.translation()});
    }
  }

  int count = 0;
  for (std::size_t i = 0; i < landmark.size(); ++i) {
    auto& keypoint = landmark[i];
    auto& seen = observations[i];
    keypoint.has_point = false;
    const Eigen::Vector3d bearing = keypoint.bearing.cast<double>().normalized();
    auto range = fit(bearing, seen, sigma_rad);
    // drop outliers one by one, so that one wrong match does not cost the point
    std::size_t worst = 0;
    while (range && seen.size() > 2 && max_error(bearing, seen, range->inverse, worst) > gate_rad) {
      seen.erase(seen.begin() + static_cast<std::ptrdiff_t>(worst));
      range = fit(bearing, seen, sigma_rad);
    }
    if (!range || max_error(bearing, seen, range->inverse, worst) > gate_rad) continue;
    if (range->inverse < parameters.min_sigmas * range->sigma || range->inverse * parameters.max_range_m < 1.0) {
      continue;
    }
    keypoint.has_point = true;
    keypoint.point_in_panorama = (bearing / range->inverse).cast<float>();
    keypoint.inverse_range_sigma = static_cast<float>(range->sigma);
    ++count;
  }
  return count;
}

}  // namespace panvo::landmark_builder
