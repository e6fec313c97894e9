// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "panvo/evaluation/report.hpp"

namespace panvo::evaluation {

struct Span {
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
};

// From the first to the last pose of any estimate that has ground truth.
inline Span covered_span(const Report& report) {
  Span span{report.evaluations.front().errors.front().stamp_ns, report.evaluations.front().errors.back().stamp_ns};
  for (const Evaluation& e : report.evaluations) {
    span.first_ns = std::min(span.first_ns, e.errors.front().stamp_ns);
    span.last_ns = std::max(span.last_ns, e.errors.back().stamp_ns);
  }
  return span;
}

// Positions of the ground truth within that span; the rest would only shrink the plot.
inline std::vector<Eigen::Vector3d> true_positions(const Report& report) {
  const Span span = covered_span(report);
  std::vector<Eigen::Vector3d> positions;
  for (const StampedPose& pose : report.ground_truth.poses) {
    if (pose.stamp_ns < span.first_ns - kSameStampNs || pose.stamp_ns > span.last_ns + kSameStampNs) continue;
    positions.push_back(pose.world_from_base.translation());
  }
  return positions;
}

}  // namespace panvo::evaluation
