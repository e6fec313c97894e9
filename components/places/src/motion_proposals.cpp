// SPDX-License-Identifier: Apache-2.0
#include "view_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "panvo/vision/angle.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::places {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kRotationSamples = 600;    // finds a rotation that a tenth of the pairs agrees with, with 99.7 %
constexpr int kHeadings = 72;            // every 5 degrees: refinement reaches farther
constexpr int kSamplesPerHeading = 60;   // finds a direction that a quarter of the pairs agrees with, with 98 %
constexpr std::size_t kPerHeading = 2;   // hypotheses
constexpr std::size_t kKept = 8;         // hypotheses of a model that are refined
constexpr double kMinAngle_rad = 0.1;    // between two bearings that define a rotation
constexpr double kMaxStretch_rad = 0.1;  // of the angle between them

Matrix3d turn_left(double heading_rad) { return vision::so3_exp(Vector3d(0.0, -heading_rad, 0.0)); }

/// The rotation that takes two query bearings to two bearings of the place, as well as their angle allows.
Matrix3d align(const BearingPair& a, const BearingPair& b) {
  const auto basis = [](const Vector3d& u, const Vector3d& v) {
    Matrix3d axes;
    axes.col(0) = (u + v).normalized();
    axes.col(1) = u.cross(v).normalized();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes;
  };
  return basis(a.landmark, b.landmark) * basis(a.panorama, b.panorama).transpose();
}

struct Scored {
  double evidence;
  ViewMotion motion;
};

void keep_best(std::vector<Scored>& scored) {
  std::stable_sort(scored.begin(), scored.end(), [](const auto& a, const auto& b) { return a.evidence > b.evidence; });
  if (scored.size() > kKept) scored.resize(kKept);
}

std::vector<Scored> propose_rotations(const std::vector<BearingPair>& pairs, std::mt19937_64& random) {
  std::vector<Scored> scored;
  const auto consider = [&](const Matrix3d& rotation) {
    const ViewMotion motion{ViewModel::kRotation, rotation, Vector3d::Zero()};
    scored.push_back({evidence(pairs, motion), motion});
  };
  for (const auto& pair : pairs) consider(turn_left(azimuth_of(pair.panorama) - azimuth_of(pair.landmark)));
  for (int i = 0; i < kRotationSamples; ++i) {
    const auto& a = pairs[random() % pairs.size()];
    const auto& b = pairs[random() % pairs.size()];
    const double between = std::acos(std::clamp(a.panorama.dot(b.panorama), -1.0, 1.0));
    const double there = std::acos(std::clamp(a.landmark.dot(b.landmark), -1.0, 1.0));
    const bool is_defined = between > kMinAngle_rad && between < std::numbers::pi - kMinAngle_rad;
    if (!is_defined || std::abs(between - there) > kMaxStretch_rad) continue;
    consider(align(a, b));
  }
  keep_best(scored);
  return scored;
}

std::vector<Scored> propose_epipolar(const std::vector<BearingPair>& pairs, const std::vector<Matrix3d>& bases,
                                     std::mt19937_64& random) {
  std::vector<Scored> scored;
  for (const Matrix3d& base : bases) {
    for (int i = 0; i < kHeadings; ++i) {
      const Matrix3d rotation = turn_left(2.0 * std::numbers::pi * i / kHeadings) * base;
      std::vector<Scored> here;
      for (int j = 0; j < kSamplesPerHeading; ++j) {
        const auto& a = pairs[random() % pairs.size()];
        const auto& b = pairs[random() % pairs.size()];
        Vector3d direction = a.landmark.cross(rotation * a.panorama).cross(b.landmark.cross(rotation * b.panorama));
        if (direction.norm() < 1e-3) continue;
        direction.normalize();
        if (!is_ahead(a.landmark, rotation * a.panorama, direction)) direction = -direction;
        const ViewMotion motion{ViewModel::kEpipolar, rotation, direction};
        here.push_back({evidence(pairs, motion), motion});
      }
      keep_best(here);
      if (here.size() > kPerHeading) here.resize(kPerHeading);
      scored.insert(scored.end(), here.begin(), here.end());
    }
  }
  keep_best(scored);
  return scored;
}

}  // namespace

std::vector<ViewMotion> propose_motions(const std::vector<BearingPair>& pairs) {
  std::vector<ViewMotion> proposed;
  if (pairs.size() < 3) return proposed;
  std::mt19937_64 random(1);
  const auto rotations = propose_rotations(pairs, random);
  for (const auto& scored : rotations) proposed.push_back(scored.motion);
  for (const auto& scored : rotations) {
    auto start = scored.motion;
    start.model = ViewModel::kEqualRange;
    proposed.push_back(refine_motion(start, pairs, 0.0));
  }
  for (const auto& scored : propose_epipolar(pairs, {Matrix3d::Identity()}, random)) proposed.push_back(scored.motion);
  return proposed;
}

}  // namespace panvo::places
