// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/association.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <optional>
#include <sstream>

#include "panvo/evaluation/input_error.hpp"

namespace panvo::evaluation {
namespace {

struct Match {
  Eigen::Isometry3d map_from_base;
  std::int64_t difference_ns = 0;
};

// The last pose not after the stamp and the first pose after it; nullptr if there is none.
struct Neighbours {
  const StampedPose* before = nullptr;
  const StampedPose* after = nullptr;

  Neighbours(const Trajectory& trajectory, std::int64_t stamp_ns) {
    const auto& poses = trajectory.poses;
    const auto next = std::upper_bound(poses.begin(), poses.end(), stamp_ns,
                                       [](std::int64_t stamp, const StampedPose& p) { return stamp < p.stamp_ns; });
    if (next != poses.begin()) before = &*(next - 1);
    if (next != poses.end()) after = &*next;
  }

  std::optional<Match> nearest(std::int64_t stamp_ns, std::int64_t within_ns) const {
    const StampedPose* best = before;
    if (!best || (after && after->stamp_ns - stamp_ns < stamp_ns - before->stamp_ns)) best = after;
    if (!best || std::abs(best->stamp_ns - stamp_ns) > within_ns) return std::nullopt;
    return Match{best->world_from_base, std::abs(best->stamp_ns - stamp_ns)};
  }

  std::optional<Match> between(std::int64_t stamp_ns, std::int64_t widest_gap_ns) const {
    if (const auto same = nearest(stamp_ns, 0)) return same;
    if (before && after && after->stamp_ns - before->stamp_ns <= widest_gap_ns) {
      return Match{interpolate(*before, *after, stamp_ns),
                   std::min(stamp_ns - before->stamp_ns, after->stamp_ns - stamp_ns)};
    }
    return nearest(stamp_ns, kSameStampNs);
  }
};

std::string span_of(const Trajectory& trajectory) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << "from " << static_cast<double>(trajectory.poses.front().stamp_ns) * 1e-9
       << " to " << static_cast<double>(trajectory.poses.back().stamp_ns) * 1e-9 << " s";
  return text.str();
}

}  // namespace

Association associate(const Trajectory& estimate, const Trajectory& ground_truth, const AssociationOptions& options) {
  if (estimate.poses.empty()) throw InputError(estimate.source, "no poses", "give a trajectory with poses");
  if (ground_truth.poses.size() < 2) {
    throw InputError(ground_truth.source, "fewer than two poses", "ground truth must cover the estimate's time");
  }
  Association result;
  result.method = options.method;
  const double periods = options.method == AssociationMethod::kInterpolate ? 2.5 : 0.5;
  result.tolerance_ns = options.tolerance_ns > 0
                            ? options.tolerance_ns
                            : std::llround(periods * static_cast<double>(median_period_ns(ground_truth)));
  for (std::size_t i = 0; i < estimate.poses.size(); ++i) {
    const StampedPose& pose = estimate.poses[i];
    const Neighbours neighbours(ground_truth, pose.stamp_ns);
    const auto match = options.method == AssociationMethod::kInterpolate
                           ? neighbours.between(pose.stamp_ns, result.tolerance_ns)
                           : neighbours.nearest(pose.stamp_ns, result.tolerance_ns);
    if (!match) {
      ++result.unmatched;
      continue;
    }
    result.pairs.push_back({pose.stamp_ns, i, match->map_from_base, pose.world_from_base});
    result.max_difference_ns = std::max(result.max_difference_ns, match->difference_ns);
  }
  if (result.pairs.size() < kMinPairs) {
    throw InputError(estimate.source,
                     "only " + std::to_string(result.pairs.size()) + " of its " +
                         std::to_string(estimate.poses.size()) + " poses overlap the ground truth in time (it covers " +
                         span_of(estimate) + ", " + ground_truth.source.string() + " " + span_of(ground_truth) + ")",
                     "check that both belong to the same recording and use the same clock");
  }
  return result;
}

}  // namespace panvo::evaluation
