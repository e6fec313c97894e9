// SPDX-License-Identifier: Apache-2.0
#include "coarse_motion.hpp"

#include <array>

#include "motion_ransac.hpp"

namespace panvo::binocular_odometry {
namespace {

constexpr int kMinPatchInliers = 8;
constexpr double kMinPatchRatio = 0.4;  // of inliers to points

}  // namespace

std::vector<FramePair> seen_twice(std::span<const Track> before, std::span<const Track> now) {
  std::vector<FramePair> points;
  auto known = before.begin();
  for (const Track& track : now) {
    while (known != before.end() && known->id < track.id) ++known;
    if (known == before.end()) break;
    if (known->id == track.id && known->seen.has_disparity) points.push_back({known->seen, track.seen});
  }
  return points;
}

std::optional<Eigen::Isometry3d> coarse_motion(const vision::RectifiedStereo& stereo, std::span<const FramePair> points,
                                               const DisparityOffset& offset, const Eigen::Isometry3d& expected,
                                               const MotionParameters& parameters) {
  std::vector<PointPair> pairs;
  for (const auto& [previous, current] : points) {
    pairs.push_back({offset.without(previous.pixel), offset.without(current.pixel), current.has_disparity});
  }
  const std::array guesses{expected, Eigen::Isometry3d::Identity()};
  const auto motion = estimate_motion(stereo, pairs, guesses, parameters);
  if (!motion || motion->inliers < kMinPatchInliers) return std::nullopt;
  if (static_cast<double>(motion->inliers) < kMinPatchRatio * static_cast<double>(pairs.size())) return std::nullopt;
  return motion->current_from_previous;
}

}  // namespace panvo::binocular_odometry
