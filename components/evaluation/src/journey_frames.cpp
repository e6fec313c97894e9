// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/alignment.hpp"
#include "panvo/evaluation/association.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/journey_revisits.hpp"

namespace panvo::evaluation {
namespace {

Eigen::Isometry3d start_of(const Trajectory& estimate, const Trajectory& truth) {
  const auto aligned = align(associate(estimate, truth).pairs, Alignment::kStart);
  if (!aligned) throw InputError(estimate.source, "cannot be aligned with ground truth", "the vehicle must move");
  return aligned->rigid;
}

/// Converts the stamps of panorama results from the panoramic camera's clock to that of the ground truth.
void to_clock_of_truth(JourneyRun& run, std::int64_t panorama_clock_offset_ns) {
  for (auto& match : run.matches) match.stamp_ns -= panorama_clock_offset_ns;
  for (auto& correction : run.corrections) correction.stamp_ns -= panorama_clock_offset_ns;
  for (auto& outcome : run.outcomes) outcome.stamp_ns -= panorama_clock_offset_ns;
  for (auto& azimuth : run.azimuths) {
    azimuth.stamp_ns -= panorama_clock_offset_ns;
    azimuth.from_ns -= panorama_clock_offset_ns;
  }
}

}  // namespace

JourneyFrames journey_frames(const JourneyRun& run, const JourneyRecording& recording,
                             const JourneyRecording* earlier) {
  JourneyFrames frames{run, recording, earlier};
  to_clock_of_truth(frames.run, recording.panorama_clock_offset_ns);
  frames.world_from_odom = start_of(run.binocular, recording.truth);
  frames.world_from_map = start_of(run.enhanced, recording.truth);
  if (earlier != nullptr) frames.world_from_map = earlier->truth.poses.front().world_from_base;
  return frames;
}

}  // namespace panvo::evaluation
