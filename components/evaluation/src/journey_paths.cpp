// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/journey_paths.hpp"

#include <algorithm>
#include <cmath>

#include "panvo/evaluation/input_error.hpp"

namespace panvo::evaluation {
namespace {

/// Removes the poses in states "unlocated" and "starting" and adds their path length to `unlocated_m`.
std::vector<PosePair> located(const std::vector<PosePair>& pairs, const JourneyRun& run, double& unlocated_m) {
  std::vector<PosePair> kept;
  const auto way_m = distances_m(pairs);
  auto state = run.states.begin();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    while (state != run.states.end() && std::next(state) != run.states.end() &&
           std::next(state)->stamp_ns <= pairs[i].stamp_ns) {
      ++state;
    }
    const bool is_unlocated = state != run.states.end() && state->stamp_ns <= pairs[i].stamp_ns &&
                              (state->state == "unlocated" || state->state == "starting");
    if (!is_unlocated) kept.push_back(pairs[i]);
    if (is_unlocated && i + 1 < pairs.size()) unlocated_m += way_m[i + 1] - way_m[i];
  }
  if (kept.size() < kMinPairs) {
    throw InputError(run.folder / "states.csv", "the vehicle was never localised in the map",
                     "use a map of the same area, or none");
  }
  return kept;
}

PathScore score(const std::string& name, const std::vector<PosePair>& pairs, const Eigen::Isometry3d& world_from_map,
                const Trajectory& truth, double travelled_m) {
  PathScore score;
  score.name = name;
  score.errors = pose_errors(pairs, {1.0, world_from_map});
  const TruePath path(truth);
  const double before_m = path.travelled_m(pairs.front().stamp_ns);  // not 0 if the path starts later
  std::vector<double> flat, heading;
  for (auto& error : score.errors) {
    error.distance_m += before_m;
    flat.push_back(error.translation_m.head<2>().norm());
    heading.push_back(std::abs(error.yaw_rad));
  }
  score.final_m = flat.back();
  const auto worst = std::max_element(flat.begin(), flat.end());
  score.worst_m = *worst;
  score.worst_at_m = score.errors[static_cast<std::size_t>(worst - flat.begin())].distance_m;
  score.ate_m = *absolute_trajectory_error(score.errors);
  score.flat_m = *summarize(std::move(flat));
  score.heading_rad = *summarize(std::move(heading));
  if (const auto aligned = align(pairs, Alignment::kSe3)) {
    score.ate_se3_m = absolute_trajectory_error(pose_errors(pairs, *aligned));
  }
  score.percent_of_way = travelled_m > 0.0 ? 100.0 * score.flat_m.rmse / travelled_m : 0.0;
  return score;
}

}  // namespace

PathScores score_paths(const JourneyFrames& frames) {
  const auto binocular = associate(frames.run.binocular, frames.recording.truth);
  const auto enhanced = associate(frames.run.enhanced, frames.recording.truth);
  PathScores scores;
  const auto in_map = located(enhanced.pairs, frames.run, scores.unlocated_m);
  scores.travelled_m = distances_m(binocular.pairs).back();
  scores.duration_s = static_cast<double>(binocular.pairs.back().stamp_ns - binocular.pairs.front().stamp_ns) * 1e-9;
  scores.binocular =
      score("binocular", binocular.pairs, frames.world_from_odom, frames.recording.truth, scores.travelled_m);
  scores.enhanced = score("enhanced", in_map, frames.world_from_map, frames.recording.truth, scores.travelled_m);
  if (scores.binocular.flat_m.rmse > 0.0) scores.ratio = scores.enhanced.flat_m.rmse / scores.binocular.flat_m.rmse;
  if (frames.run.enhanced_covariances) {
    scores.consistency = pose_consistency(in_map, *frames.run.enhanced_covariances, frames.world_from_map);
  }
  return scores;
}

}  // namespace panvo::evaluation
