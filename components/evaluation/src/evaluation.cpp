// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/evaluation.hpp"

#include <numbers>

#include "panvo/evaluation/input_error.hpp"

namespace panvo::evaluation {
namespace {

// For shorter paths, errors in percent of the path length are meaningless.
constexpr double kMinPathM = 1e-3;

std::optional<std::vector<PoseError>> aligned_errors(std::span<const PosePair> pairs, Alignment alignment) {
  const auto map_from_odom = align(pairs, alignment);
  if (!map_from_odom) return std::nullopt;
  return pose_errors(pairs, *map_from_odom);
}

void evaluate_absolute(Evaluation& evaluation, std::span<const PosePair> pairs) {
  if (const auto errors = aligned_errors(pairs, Alignment::kStart)) {
    evaluation.ate_start_m = absolute_trajectory_error(*errors);
    evaluation.rotation_start_deg = absolute_rotation_error_deg(*errors);
    evaluation.end_error_m = errors->back().translation_m.norm();
    evaluation.end_rotation_deg = errors->back().rotation_rad.norm() * 180.0 / std::numbers::pi;
    if (evaluation.path_length_m > kMinPathM) {
      evaluation.end_error_percent = 100.0 * *evaluation.end_error_m / evaluation.path_length_m;
    }
  }
  if (const auto errors = aligned_errors(pairs, Alignment::kSe3)) {
    evaluation.ate_se3_m = absolute_trajectory_error(*errors);
  }
  if (const auto map_from_odom = align(pairs, Alignment::kSim3); map_from_odom && map_from_odom->scale > 0.0) {
    evaluation.scale_error_percent = 100.0 * (1.0 / map_from_odom->scale - 1.0);
  }
}

std::optional<Consistency> evaluate_consistency(const Estimate& estimate, const Trajectory& ground_truth,
                                                const Options& options) {
  if (!estimate.covariances) return std::nullopt;
  const Association association = associate(estimate.odometry, ground_truth, options.association);
  return consistency(association.pairs, *estimate.covariances, options.consistency);
}

}  // namespace

Evaluation evaluate(const Estimate& estimate, const Trajectory& ground_truth, const Options& options) {
  const Association association = associate(estimate.trajectory, ground_truth, options.association);
  const std::vector<PosePair>& pairs = association.pairs;

  Evaluation evaluation;
  evaluation.name = estimate.name;
  evaluation.source = estimate.trajectory.source;
  evaluation.poses = estimate.trajectory.poses.size();
  evaluation.pairs = pairs.size();
  evaluation.association = association.method;
  evaluation.tolerance_ns = association.tolerance_ns;
  evaluation.max_difference_ns = association.max_difference_ns;
  evaluation.duration_s = static_cast<double>(pairs.back().stamp_ns - pairs.front().stamp_ns) * 1e-9;
  evaluation.path_length_m = distances_m(pairs).back();
  const double whole_length_m = path_length_m(ground_truth);
  evaluation.coverage_percent = whole_length_m > 0.0 ? 100.0 * evaluation.path_length_m / whole_length_m : 100.0;

  evaluate_absolute(evaluation, pairs);
  evaluation.segments = segment_errors(pairs, options.segments);
  evaluation.per_frame = relative_error_per_frame(pairs);
  evaluation.per_metre = relative_error_per_metre(pairs);
  evaluation.nees = evaluate_consistency(estimate, ground_truth, options);
  evaluation.timing = estimate.timing;
  evaluation.unreliable = estimate.unreliable;

  evaluation.alignment = options.alignment;
  auto errors = aligned_errors(pairs, options.alignment);
  if (!errors) {
    throw InputError(estimate.trajectory.source,
                     "cannot be aligned by " + std::string(to_string(options.alignment)) +
                         ", because it or the ground truth does not move",
                     "use --align start");
  }
  evaluation.errors = std::move(*errors);
  return evaluation;
}

}  // namespace panvo::evaluation
