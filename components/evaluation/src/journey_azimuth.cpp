// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/journey_azimuth.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "journey_errors.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::evaluation {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kSameEpisode_ns = 2 * kSecond_ns;  // shorter reliable intervals do not end an episode
constexpr std::int64_t kAround_ns = 3 * kSecond_ns;       // shown by a curve before and after the episode

/// Intervals of consecutive unreliable frames; each starts at the frame before, where the first unreliable motion
/// starts.
std::vector<Disturbance> unreliable_stretches(const std::vector<RunQuality>& qualities) {
  std::vector<Disturbance> stretches;
  for (std::size_t i = 0; i < qualities.size(); ++i) {
    if (qualities[i].reliable) continue;
    const auto from_ns = i == 0 ? qualities[i].stamp_ns : qualities[i - 1].stamp_ns;
    if (!stretches.empty() && from_ns - stretches.back().to_ns <= kSameEpisode_ns) {
      stretches.back().to_ns = qualities[i].stamp_ns;
    } else {
      stretches.push_back({from_ns, qualities[i].stamp_ns, "unreliable"});
    }
  }
  return stretches;
}

/// The part of an interval covered by ground truth and both odometries.
std::optional<Disturbance> covered(Disturbance stretch, const JourneyFrames& frames) {
  for (const auto* path : {&frames.recording.truth, &frames.run.binocular, &frames.run.enhanced}) {
    stretch.from_ns = std::max(stretch.from_ns, path->poses.front().stamp_ns);
    stretch.to_ns = std::min(stretch.to_ns, path->poses.back().stamp_ns);
  }
  if (stretch.to_ns <= stretch.from_ns) return std::nullopt;
  return stretch;
}

std::optional<double> gained(const std::optional<FlatError>& before, const std::optional<FlatError>& after) {
  if (!before || !after) return std::nullopt;
  return vision::wrapped(after->heading_rad - before->heading_rad);
}

double true_change(const TruePath& truth, std::int64_t from_ns, std::int64_t to_ns) {
  const auto from = truth.pose(from_ns);
  const auto to = truth.pose(to_ns);
  return from && to ? vision::wrapped(yaw_of(*to) - yaw_of(*from)) : 0.0;
}

/// Adds the errors of the compass changes within the episode, each over its own time span. Missing changes are skipped.
void add_compass(AzimuthEpisode& episode, const JourneyFrames& frames, const TruePath& truth) {
  double error_rad = 0.0;
  std::int64_t told_ns = 0;
  for (const auto& azimuth : frames.run.azimuths) {
    if (!azimuth.change_rad || azimuth.from_ns < episode.from_ns || azimuth.stamp_ns > episode.to_ns) continue;
    error_rad += vision::wrapped(*azimuth.change_rad - true_change(truth, azimuth.from_ns, azimuth.stamp_ns));
    told_ns += azimuth.stamp_ns - azimuth.from_ns;
  }
  if (told_ns == 0) return;
  episode.compass_rad = error_rad;
  episode.compass_share = static_cast<double>(told_ns) / static_cast<double>(episode.to_ns - episode.from_ns);
}

/// RMS and largest value of one quantity over all episodes of a kind.
struct Collected {
  double squares = 0.0, worst = 0.0;
  int count = 0;

  void add(const std::optional<double>& value) {
    if (!value) return;
    squares += *value * *value;
    worst = std::max(worst, std::abs(*value));
    ++count;
  }
  std::optional<double> rms() const { return count == 0 ? std::nullopt : std::optional(std::sqrt(squares / count)); }
  std::optional<double> largest() const { return count == 0 ? std::nullopt : std::optional(worst); }
};

std::vector<AzimuthKind> by_kind(const std::vector<AzimuthEpisode>& episodes) {
  struct Parts {
    AzimuthKind kind;
    Collected binocular, compass, enhanced;
  };
  std::map<std::string, Parts> parts;
  for (const auto& episode : episodes) {
    auto& part = parts[episode.kind];
    part.kind.kind = episode.kind;
    ++part.kind.episodes;
    part.kind.duration_s += static_cast<double>(episode.to_ns - episode.from_ns) * 1e-9;
    part.binocular.add(episode.binocular_rad);
    part.compass.add(episode.compass_rad);
    part.enhanced.add(episode.enhanced_rad);
  }
  std::vector<AzimuthKind> kinds;
  for (auto& [name, part] : parts) {
    part.kind.binocular_rms_rad = part.binocular.rms();
    part.kind.compass_rms_rad = part.compass.rms();
    part.kind.enhanced_rms_rad = part.enhanced.rms();
    part.kind.binocular_worst_rad = part.binocular.largest();
    part.kind.compass_worst_rad = part.compass.largest();
    part.kind.enhanced_worst_rad = part.enhanced.largest();
    kinds.push_back(part.kind);
  }
  return kinds;
}

/// Unwrapped yaw of a path around the episode, 0 at its start.
std::vector<AzimuthCurve::Point> curve_of(const Trajectory& path, const Eigen::Isometry3d& world_from_path,
                                          const TruePath& truth, const AzimuthEpisode& episode) {
  std::vector<AzimuthCurve::Point> points;
  const TruePath times(path);
  const auto zero = times.pose(episode.from_ns);
  const auto true_zero = truth.pose(episode.from_ns);
  if (!zero || !true_zero) return points;
  const double offset_rad = yaw_of(world_from_path * *zero) - yaw_of(*true_zero);
  double true_azimuth_rad = 0.0;
  std::optional<double> last_rad;
  for (const auto& pose : path.poses) {
    if (pose.stamp_ns < episode.from_ns - kAround_ns || pose.stamp_ns > episode.to_ns + kAround_ns) continue;
    const auto now = truth.pose(pose.stamp_ns);
    if (!now) continue;
    const double true_yaw_rad = yaw_of(*now);
    true_azimuth_rad = last_rad ? true_azimuth_rad + vision::wrapped(true_yaw_rad - *last_rad)
                                : vision::wrapped(true_yaw_rad - yaw_of(*true_zero));
    last_rad = true_yaw_rad;
    const double error_rad =
        vision::wrapped(yaw_of(world_from_path * pose.world_from_base) - true_yaw_rad - offset_rad);
    points.push_back(
        {static_cast<double>(pose.stamp_ns - episode.from_ns) * 1e-9, true_azimuth_rad + error_rad, error_rad});
  }
  return points;
}

/// The true turn since the start of the episode, plus the errors of the compass. What it does not report is a gap.
std::vector<AzimuthCurve::Point> compass_curve(const JourneyFrames& frames, const TruePath& truth,
                                               const AzimuthEpisode& episode) {
  std::vector<AzimuthCurve::Point> points;
  double true_azimuth_rad = 0.0;
  double error_rad = 0.0;
  std::int64_t last_ns = episode.from_ns;
  for (const auto& azimuth : frames.run.azimuths) {
    if (azimuth.from_ns < episode.from_ns || azimuth.stamp_ns > episode.to_ns + kAround_ns) continue;
    true_azimuth_rad += true_change(truth, std::exchange(last_ns, azimuth.stamp_ns), azimuth.stamp_ns);
    if (!azimuth.change_rad) continue;
    error_rad += vision::wrapped(*azimuth.change_rad - true_change(truth, azimuth.from_ns, azimuth.stamp_ns));
    points.push_back(
        {static_cast<double>(azimuth.stamp_ns - episode.from_ns) * 1e-9, true_azimuth_rad + error_rad, error_rad});
  }
  return points;
}

}  // namespace

AzimuthScore score_azimuth(const JourneyFrames& frames) {
  const JourneyErrors errors(frames);
  const TruePath truth(frames.recording.truth);
  auto stretches = unreliable_stretches(frames.run.qualities);
  stretches.insert(stretches.end(), frames.recording.disturbances.begin(), frames.recording.disturbances.end());
  AzimuthScore score;
  for (const auto& stretch : stretches) {
    const auto part = covered(stretch, frames);
    if (!part) continue;
    AzimuthEpisode episode;
    episode.kind = part->kind;
    episode.from_ns = part->from_ns;
    episode.to_ns = part->to_ns;
    episode.travelled_m = truth.travelled_m(part->from_ns);
    episode.turned_rad = true_change(truth, part->from_ns, part->to_ns);
    episode.binocular_rad = gained(errors.of_binocular(part->from_ns), errors.of_binocular(part->to_ns));
    episode.enhanced_rad = gained(errors.of_enhanced(part->from_ns), errors.of_enhanced(part->to_ns));
    add_compass(episode, frames, truth);
    score.episodes.push_back(episode);
  }
  score.kinds = by_kind(score.episodes);
  return score;
}

std::optional<AzimuthCurve> worst_episode(const JourneyFrames& frames, const AzimuthScore& score) {
  const auto astray = [](const AzimuthEpisode& episode) { return std::abs(episode.binocular_rad.value_or(0.0)); };
  const auto worst = std::max_element(score.episodes.begin(), score.episodes.end(),
                                      [&](const auto& a, const auto& b) { return astray(a) < astray(b); });
  if (worst == score.episodes.end()) return std::nullopt;
  const TruePath truth(frames.recording.truth);
  AzimuthCurve curve;
  curve.episode = *worst;
  curve.truth = curve_of(frames.recording.truth, Eigen::Isometry3d::Identity(), truth, *worst);
  curve.binocular = curve_of(frames.run.binocular, frames.world_from_odom, truth, *worst);
  curve.enhanced = curve_of(frames.run.enhanced, frames.world_from_map, truth, *worst);
  curve.compass = compass_curve(frames, truth, *worst);
  return curve;
}

}  // namespace panvo::evaluation
