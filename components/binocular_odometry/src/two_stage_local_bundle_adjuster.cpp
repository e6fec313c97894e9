// SPDX-License-Identifier: Apache-2.0
#include "two_stage_local_bundle_adjuster.hpp"

#include <algorithm>
#include <cmath>

#include "disparity_offset.hpp"
#include "panvo/vision/stereo_geometry.hpp"

namespace panvo::binocular_odometry {
namespace {

constexpr double kContradiction2 = 25.0;          // whitened squared error, five standard deviations
constexpr double kMinInverseDepth = 1.0 / 200.0;  // 1/m; of farther ones a pair on a vehicle measures no useful depth
constexpr int kMinShared = 10;                    // points shared by head and window
// Lower bound of the residual variance, relative to the stated one: 1/40 of a standard deviation, less than grey levels
// resolve. At standstill the errors of all points repeat and do not show in the residuals.
constexpr double kMinVariance = 1.0 / (40.0 * 40.0);

Eigen::Vector3d inverse_sigma(const Observation& seen) {
  return {1.0 / seen.sigma_px, 1.0 / seen.sigma_px, seen.has_disparity ? 1.0 / seen.sigma_disparity_px : 0.0};
}

BundleObservation bundle_observation(const Observation& seen, size_t frame, size_t point) {
  return {static_cast<int>(frame), static_cast<int>(point), seen.pixel, inverse_sigma(seen)};
}

double root_mean_square_px(const vision::RectifiedStereo& stereo, const BundleProblem& problem) {
  double sum = 0.0, count = 0.0;
  for (const auto& observation : problem.observations) {
    const Eigen::Vector3d whitened = whitened_residual(
        stereo, problem.left_from_world[static_cast<size_t>(observation.frame)],
        problem.points[static_cast<size_t>(observation.point)], observation, problem.disparity_offset_px);
    if (whitened.squaredNorm() > kContradiction2) continue;
    sum += whitened.head<2>().cwiseQuotient(observation.inverse_sigma.head<2>()).squaredNorm();
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

/// nullopt if the point is too far to have a position.
std::optional<Eigen::Vector3d> position(const BundlePoint& point) {
  const double inverse_depth = point.inverse_depth.z();
  if (inverse_depth < kMinInverseDepth) return std::nullopt;
  const Eigen::Vector3d bearing(point.inverse_depth.x(), point.inverse_depth.y(), 1.0);
  return point.world_from_anchor * Eigen::Vector3d(bearing / inverse_depth);
}

}  // namespace

Eigen::Vector3d TwoStageLocalBundleAdjuster::point_of(const Observation& seen) const {
  return vision::inverse_depth_point(stereo_, {seen.pixel.x(), seen.pixel.y(), seen.pixel.z() - disparity_offset_px_});
}

MeasuredMotion TwoStageLocalBundleAdjuster::refine_motion(std::span<const Observation> previous,
                                                          std::span<const Observation> current,
                                                          const Eigen::Isometry3d& current_from_previous) const {
  BundleProblem problem;
  problem.left_from_world = {Eigen::Isometry3d::Identity(), current_from_previous};
  problem.disparity_offset_px = problem.expected_offset_px = disparity_offset_px_;
  for (size_t i = 0; i < previous.size(); ++i) {
    problem.points.push_back({Eigen::Isometry3d::Identity(), point_of(previous[i])});
    problem.observations.push_back(bundle_observation(previous[i], 0, i));
    problem.observations.push_back(bundle_observation(current[i], 1, i));
  }
  BundleOptions options;
  options.loss_scale = parameters_.loss_scale;
  options.max_iterations = 2;
  const BundleSummary summary = solve(stereo_, problem, options);
  MeasuredMotion motion;
  motion.current_from_previous = problem.left_from_world[1];
  if (summary.covariance.rows() == 6) motion.covariance = std::max(kMinVariance, summary.variance) * summary.covariance;
  motion.residual_px = root_mean_square_px(stereo_, problem);
  return motion;
}

BundleProblem TwoStageLocalBundleAdjuster::assemble(const Keyframe& head, std::vector<std::int64_t>& ids) const {
  BundleProblem problem;
  const size_t frames = keyframes_.size() + 1;
  std::vector<const std::vector<Observation>*> seen_by;
  for (const Keyframe& keyframe : keyframes_) {
    problem.left_from_world.push_back(keyframe.left_from_odom);
    seen_by.push_back(&keyframe.observations);
  }
  problem.left_from_world.push_back(head.left_from_odom);
  seen_by.push_back(&head.observations);
  // A new window has fewer keyframes: only the first is fixed.
  const int spare = static_cast<int>(keyframes_.size()) - (parameters_.window_keyframes - parameters_.fixed_keyframes);
  problem.fixed_frames = std::max(1, spare);
  problem.disparity_offset_px = problem.expected_offset_px = disparity_offset_px_;
  problem.offset_information = 1.0 / std::pow(parameters_.disparity_offset_step_px, 2);

  std::vector<size_t> next(frames, 0);  // observations and points are sorted by id: a single pass suffices
  for (const auto& [id, window_point] : points_) {
    if (window_point.is_refuted) continue;
    const size_t first = problem.observations.size();
    for (size_t frame = 0; frame < frames; ++frame) {
      const auto& seen = *seen_by[frame];
      while (next[frame] < seen.size() && seen[next[frame]].track_id < id) ++next[frame];
      if (next[frame] == seen.size() || seen[next[frame]].track_id != id) continue;
      const auto observation = bundle_observation(seen[next[frame]], frame, ids.size());
      if (!std::isfinite(whitened_residual(stereo_, problem.left_from_world[frame], window_point.point, observation)
                             .squaredNorm())) {
        continue;
      }
      problem.observations.push_back(observation);
    }
    if (problem.observations.size() < first + 2) {
      problem.observations.resize(first);
      continue;
    }
    problem.points.push_back(window_point.point);
    ids.push_back(id);
  }
  return problem;
}

std::optional<MeasuredMotion> TwoStageLocalBundleAdjuster::refine_window(Keyframe& head, int max_iterations) {
  if (keyframes_.empty()) return std::nullopt;
  std::vector<std::int64_t> ids;
  BundleProblem problem = assemble(head, ids);
  const int head_frame = static_cast<int>(keyframes_.size());
  const auto shared = std::count_if(problem.observations.begin(), problem.observations.end(),
                                    [head_frame](const auto& seen) { return seen.frame == head_frame; });
  if (shared < kMinShared) return std::nullopt;

  BundleOptions options;
  options.loss_scale = parameters_.loss_scale;
  options.max_iterations = max_iterations;
  const BundleSummary summary = solve(stereo_, problem, options);

  for (size_t frame = 0; frame < keyframes_.size(); ++frame) {
    keyframes_[frame].left_from_odom = problem.left_from_world[frame];
  }
  head.left_from_odom = problem.left_from_world.back();
  disparity_offset_px_ =
      std::clamp(problem.disparity_offset_px, -DisparityOffset::kMaxOffset_px, DisparityOffset::kMaxOffset_px);
  for (size_t i = 0; i < ids.size(); ++i) points_.at(ids[i]).point = problem.points[i];

  for (const auto& observation : problem.observations) {
    const double square = whitened_residual(stereo_, problem.left_from_world[static_cast<size_t>(observation.frame)],
                                            problem.points[static_cast<size_t>(observation.point)], observation,
                                            problem.disparity_offset_px)
                              .squaredNorm();
    if (square < kContradiction2 * std::max(1.0, summary.variance)) continue;
    const std::int64_t id = ids[static_cast<size_t>(observation.point)];
    auto& observations = observation.frame == head_frame
                             ? head.observations
                             : keyframes_[static_cast<size_t>(observation.frame)].observations;
    std::erase_if(observations, [id](const Observation& seen) { return seen.track_id == id; });
    WindowPoint& point = points_.at(id);
    if (++point.contradictions >= 2) point.is_refuted = true;
  }

  MeasuredMotion motion;
  const Keyframe& last = keyframes_.back();
  motion.current_from_previous = head.left_from_odom * last.left_from_odom.inverse();
  motion.residual_px = root_mean_square_px(stereo_, problem);
  const int size = static_cast<int>(summary.covariance.rows());
  if (size >= 6) {
    const vision::Matrix6d by_last = -vision::adjoint(motion.current_from_previous);
    motion.covariance = summary.covariance.bottomRightCorner<6, 6>();
    if (size >= 12) {
      const vision::Matrix6d last_last = summary.covariance.block<6, 6>(size - 12, size - 12);
      const vision::Matrix6d head_last = summary.covariance.block<6, 6>(size - 6, size - 12);
      motion.covariance +=
          by_last * last_last * by_last.transpose() + head_last * by_last.transpose() + by_last * head_last.transpose();
    }
    motion.covariance *= std::max(kMinVariance, summary.variance);
  }
  return motion;
}

void TwoStageLocalBundleAdjuster::add_keyframe(Keyframe frame) {
  const Eigen::Isometry3d odom_from_left = frame.left_from_odom.inverse();
  for (const Observation& seen : frame.observations) {
    if (seen.has_disparity) points_.try_emplace(seen.track_id, WindowPoint{{odom_from_left, point_of(seen)}});
    if (const auto known = points_.find(seen.track_id); known != points_.end()) ++known->second.keyframes;
  }
  keyframes_.push_back(std::move(frame));
  if (static_cast<int>(keyframes_.size()) > parameters_.window_keyframes) keyframes_.pop_front();
  forget_unseen_points();
}

std::optional<int> TwoStageLocalBundleAdjuster::standing(std::int64_t track_id) const {
  const auto known = points_.find(track_id);
  if (known == points_.end()) return 0;
  return known->second.is_refuted ? std::nullopt : std::optional(known->second.keyframes);
}

ScenePoint TwoStageLocalBundleAdjuster::scene_point(const Observation& seen,
                                                    const Eigen::Isometry3d& odom_from_left) const {
  using State = ScenePoint::State;
  ScenePoint point;
  point.track_id = seen.track_id;
  point.pixel = seen.pixel.head<2>();
  const auto keyframes = standing(seen.track_id);
  point.state = !keyframes ? State::kOutlier : *keyframes > 1 ? State::kInlier : State::kNew;
  const auto known = points_.find(seen.track_id);
  if (known != points_.end()) {
    point.in_odom = position(known->second.point);
  } else if (seen.has_disparity) {
    point.in_odom = position({odom_from_left, point_of(seen)});
  }
  return point;
}

void TwoStageLocalBundleAdjuster::forget_unseen_points() {
  // Refuted points are kept while their tracks may still be observed; tracks are never older than the oldest one in the
  // window.
  std::map<std::int64_t, WindowPoint> seen_points;
  for (const Keyframe& keyframe : keyframes_) {
    for (const Observation& seen : keyframe.observations) {
      if (const auto entry = points_.find(seen.track_id); entry != points_.end()) seen_points.insert(*entry);
    }
  }
  if (!seen_points.empty()) {
    for (const auto& [id, point] : points_) {
      if (point.is_refuted && id >= seen_points.begin()->first) seen_points.emplace(id, point);
    }
  }
  points_.swap(seen_points);
}

void TwoStageLocalBundleAdjuster::clear() {
  keyframes_.clear();
  points_.clear();
}

}  // namespace panvo::binocular_odometry
