// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/alignment.hpp"
#include "panvo/evaluation/association.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/evaluation/journey_revisits.hpp"

namespace panvo::evaluation {
namespace {

Eigen::Isometry3d start_of(const Trajectory& estimate, const Trajectory& truth) {
  const auto aligned = align(associate(estimate, truth).pairs, Alignment::kStart);
  if (!aligned) throw InputError(estimate.source, "cannot be laid on the truth", "record a journey that moves");
  return aligned->rigid;
}

}  // namespace

JourneyFrames journey_frames(const JourneyRun& run, const JourneyRecording& recording,
                             const JourneyRecording* earlier) {
  JourneyFrames frames{run, recording, earlier};
  frames.world_from_odom = start_of(run.binocular, recording.truth);
  frames.world_from_map = start_of(run.enhanced, recording.truth);
  if (earlier != nullptr) frames.world_from_map = earlier->truth.poses.front().world_from_base;
  return frames;
}

}  // namespace panvo::evaluation
