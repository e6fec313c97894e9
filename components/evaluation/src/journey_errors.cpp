// SPDX-License-Identifier: Apache-2.0
#include "journey_errors.hpp"

#include <numbers>

#include "panvo/vision/equirectangular.hpp"

namespace panvo::evaluation {
namespace {

FlatError error_of(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& truth) {
  return {estimate.translation().head<2>(), (estimate.translation() - truth.translation()).head<2>().norm(),
          vision::wrap(yaw_of(estimate) - yaw_of(truth), 2.0 * std::numbers::pi)};
}

}  // namespace

JourneyErrors::JourneyErrors(const JourneyFrames& frames)
    : frames_(frames),
      path_(frames.recording.truth),
      binocular_(frames.run.binocular),
      enhanced_(frames.run.enhanced),
      earlier_(frames.earlier != nullptr ? std::optional<TruePath>(frames.earlier->truth) : std::nullopt) {}

std::optional<Eigen::Isometry3d> JourneyErrors::truth(std::int64_t stamp_ns, bool earlier) const {
  if (!earlier) return path_.pose(stamp_ns);
  return earlier_ ? earlier_->pose(stamp_ns) : std::nullopt;
}

LandmarkTruth JourneyErrors::landmark(const RunLandmark& landmark) const {
  const auto stamp_ns = landmark.stamp_ns - frames_.recording.panorama_clock_offset_ns;
  LandmarkTruth found{stamp_ns, false, of_map(landmark.map_from_base, stamp_ns)};
  if (frames_.earlier == nullptr) return found;
  const auto earlier_ns = landmark.stamp_ns - frames_.earlier->panorama_clock_offset_ns;
  if (const auto then = truth(earlier_ns, true)) {
    const auto error = error_of(frames_.world_from_map * landmark.map_from_base, *then);
    if (!found.error || error.flat_m < found.error->flat_m) found = {earlier_ns, true, error};
  }
  return found;
}

std::optional<FlatError> JourneyErrors::of_map(const Eigen::Isometry3d& map_from_base, std::int64_t stamp_ns) const {
  const auto at = truth(stamp_ns);
  if (!at) return std::nullopt;
  return error_of(frames_.world_from_map * map_from_base, *at);
}

std::optional<FlatError> JourneyErrors::of_binocular(std::int64_t stamp_ns) const {
  const auto at = path_.pose(stamp_ns);
  const auto pose = binocular_.pose(stamp_ns);
  if (!at || !pose) return std::nullopt;
  return error_of(frames_.world_from_odom * *pose, *at);
}

std::optional<FlatError> JourneyErrors::of_enhanced(std::int64_t stamp_ns) const {
  const auto at = path_.pose(stamp_ns);
  const auto pose = enhanced_.pose(stamp_ns);
  if (!at || !pose) return std::nullopt;
  return error_of(frames_.world_from_map * *pose, *at);
}

}  // namespace panvo::evaluation
