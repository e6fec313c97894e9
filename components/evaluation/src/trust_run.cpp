// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/trust_run.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "csv_table.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/trajectory.hpp"
#include "panvo/evaluation/trajectory_files.hpp"
#include "text_file.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

/// Values valid from a stamp on. Of several values with one stamp the first counts, because it was published with the
/// pose.
template <class Said>
using Timeline = std::map<std::int64_t, Said>;

template <class Said>
const Said* latest(const Timeline<Said>& timeline, std::int64_t stamp_ns) {
  const auto after = timeline.upper_bound(stamp_ns);
  return after == timeline.begin() ? nullptr : &std::prev(after)->second;
}

struct Integrity {
  bool is_usable;
  double level_m;
};

/// Like read_tum, but for stamps in any order; returns sorted poses. Of several poses with one stamp, the first is
/// used.
std::vector<StampedPose> read_poses(const fs::path& file) {
  std::map<std::int64_t, StampedPose> poses;
  for (const auto& line : read_lines(file)) {
    const Fields fields(file, line, ' ');
    fields.expect(8, false, "t x y z qx qy qz qw");
    StampedPose pose{fields.seconds_as_ns(0), Eigen::Isometry3d::Identity()};
    pose.world_from_base.translation() = Eigen::Vector3d(fields.number(1), fields.number(2), fields.number(3));
    const Eigen::Quaterniond q(fields.number(7), fields.number(4), fields.number(5), fields.number(6));
    pose.world_from_base.linear() = q.normalized().toRotationMatrix();
    poses.emplace(pose.stamp_ns, pose);
  }
  std::vector<StampedPose> sorted;
  for (const auto& [stamp_ns, pose] : poses) sorted.push_back(pose);
  return sorted;
}

Timeline<Eigen::Matrix2d> read_covariances(const fs::path& file) {
  Timeline<Eigen::Matrix2d> covariances;
  for (const auto& row : read_csv(file, {"stamp_ns", "p00", "p01", "p10", "p11"})) {
    Eigen::Matrix2d covariance;
    covariance << row.number(1), row.number(2), row.number(3), row.number(4);
    covariances.emplace(row.integer(0), covariance);
  }
  return covariances;
}

Timeline<bool> read_tracking(const fs::path& file) {
  Timeline<bool> tracking;
  for (const auto& row : read_csv(file, {"stamp_ns", "state"})) {
    tracking.emplace(row.integer(0), row.text(1) == "tracking" || row.text(1) == "relocalised");
  }
  return tracking;
}

Timeline<Integrity> read_integrity(const fs::path& file) {
  Timeline<Integrity> integrity;
  if (!fs::exists(file)) return integrity;
  for (const auto& row : read_csv(file, {"stamp_ns", "usable", "hpl_m"})) {
    // Without a number there is no protection level.
    const auto level = row.optional_number(2);
    integrity.emplace(row.integer(0), Integrity{row.flag(1), level.value_or(std::numeric_limits<double>::infinity())});
  }
  return integrity;
}

/// Ground truth at a stamp, interpolated over gaps of at most one second; nullopt outside its time span.
std::optional<Eigen::Isometry3d> truth_at(const std::vector<StampedPose>& truth, std::int64_t stamp_ns) {
  constexpr std::int64_t kMaxGap_ns = 1'000'000'000;
  const auto after = std::lower_bound(truth.begin(), truth.end(), stamp_ns,
                                      [](const StampedPose& pose, std::int64_t ns) { return pose.stamp_ns < ns; });
  if (after == truth.end()) return std::nullopt;
  if (after->stamp_ns == stamp_ns) return after->world_from_base;
  if (after == truth.begin() || after->stamp_ns - std::prev(after)->stamp_ns > kMaxGap_ns) return std::nullopt;
  return interpolate(*std::prev(after), *after, stamp_ns);
}

/// sqrt(e' C^-1 e); nullopt for an invalid covariance.
std::optional<double> over_sigma(const Eigen::Vector2d& error, const Eigen::Matrix2d* covariance) {
  if (covariance == nullptr) return std::nullopt;
  const Eigen::LLT<Eigen::Matrix2d> factor(*covariance);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const double squared = error.dot(factor.solve(error));
  if (!std::isfinite(squared) || squared < 0.0) return std::nullopt;
  return std::sqrt(squared);
}

}  // namespace

TrustRun read_trust_run(const fs::path& folder) {
  const auto truth = read_poses(folder / "ground_truth.tum");
  const auto poses = read_poses(folder / "odometry_enhanced.tum");
  const auto covariances = read_covariances(folder / "odometry_enhanced_covariance.csv");
  const auto tracking = read_tracking(folder / "states.csv");
  const auto integrity = read_integrity(folder / "integrity.csv");

  TrustRun run;
  std::optional<Eigen::Isometry3d> map_from_world;
  for (const auto& [stamp_ns, map_from_base] : poses) {
    const auto world_from_base = truth_at(truth, stamp_ns);
    if (!world_from_base) {
      ++run.without_truth;
      continue;
    }
    if (!map_from_world) map_from_world = map_from_base * world_from_base->inverse();
    const Eigen::Vector2d error =
        (map_from_base.translation() - *map_from_world * world_from_base->translation()).head<2>();
    const auto covariance = covariances.find(stamp_ns);
    const auto sigmas = over_sigma(error, covariance != covariances.end() ? &covariance->second : nullptr);
    if (!sigmas) {
      ++run.without_sigma;
      continue;
    }
    TrustSample sample{stamp_ns, error.norm(), *sigmas, false, false, std::nullopt};
    if (const bool* said = latest(tracking, stamp_ns)) sample.is_tracking = *said;
    sample.is_usable = sample.is_tracking;
    if (const Integrity* said = latest(integrity, stamp_ns)) {
      sample.is_usable = said->is_usable;
      if (std::isfinite(said->level_m)) sample.protection_level_m = said->level_m;
    }
    run.samples.push_back(sample);
  }
  if (run.samples.empty()) {
    throw InputError(folder / "odometry_enhanced.tum", "has no pose within the time span of the ground truth",
                     "play a recording with ground truth (ground_truth.tum)");
  }
  return run;
}

}  // namespace panvo::evaluation
