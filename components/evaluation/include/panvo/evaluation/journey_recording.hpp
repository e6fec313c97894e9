// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/place_recording.hpp"
#include "panvo/evaluation/trajectory.hpp"

namespace panvo::evaluation {

/// A crossing of the route, as the recording's author lists it.
struct JourneyPlace {
  std::string name;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< world of the truth
};

struct JourneyVisit {
  int place = 0;
  std::int64_t stamp_ns = 0;    ///< of the closest approach
  std::int64_t in_ns = 0;       ///< when the crossing was entered
  std::int64_t out_ns = 0;      ///< and left
  double heading_in_rad = 0.0;  ///< of the vehicle on entering, left positive, 0 along the world's x
};

/// A stretch in which something was made hard for the cameras: "movers", "illumination", "weak texture".
struct Disturbance {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  std::string kind;
};

/// What is true of a journey, and what it looked like. All but the truth may be missing.
struct JourneyRecording {
  std::filesystem::path folder;
  Trajectory truth;  ///< world_from_base, world of the recording
  std::string route;
  std::string seed;
  std::vector<std::string> effects;
  std::map<int, JourneyPlace> places;         ///< by number
  std::vector<JourneyVisit> visits;           ///< in order of time
  std::vector<Disturbance> disturbances;      ///< stretches of one kind that touch are one
  std::int64_t panorama_clock_offset_ns = 0;  ///< what the panoramic camera's clock is ahead of the truth's
  std::vector<RecordedPanorama> panoramas;
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
};

/// Of a data set in the EuRoC/ASL layout, with sequence.yaml and cam2 where they are there; of the folder of a run, whose
/// ground_truth.tum is then all that is known; or of a trajectory. Throws InputError (file, line, what to do).
JourneyRecording read_journey_recording(const std::filesystem::path& folder);

/// Truth with the way along it.
class TruePath {
 public:
  explicit TruePath(const Trajectory& truth);

  /// nullopt outside of the truth's time.
  std::optional<Eigen::Isometry3d> pose(std::int64_t stamp_ns) const;
  /// Way since the first pose, m; the ends' outside of the truth's time.
  double travelled_m(std::int64_t stamp_ns) const;
  const Trajectory& trajectory() const { return truth_; }

 private:
  const Trajectory& truth_;
  std::vector<double> way_m_;
};

double yaw_of(const Eigen::Isometry3d& world_from_base);  ///< left positive, (-pi, pi]

}  // namespace panvo::evaluation
