// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/trajectory.hpp"

namespace panvo::evaluation {

/// A panorama of a recording with its true pose.
struct RecordedPanorama {
  std::int64_t stamp_ns = 0;  ///< in the clock of the ground truth
  std::filesystem::path file;
  Eigen::Isometry3d world_from_base = Eigen::Isometry3d::Identity();
  double travelled_m = 0.0;  ///< since the first panorama
};

/// A junction of the route, as listed in sequence.yaml.
struct JourneyPlace {
  std::string name;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< in the world frame of the ground truth
  int roads = 0;                                         ///< that meet there; 0 if not listed
};

struct JourneyVisit {
  int place = 0;
  std::int64_t stamp_ns = 0;    ///< of the closest approach
  std::int64_t in_ns = 0;       ///< time of entering the junction
  std::int64_t out_ns = 0;      ///< time of leaving it
  double heading_in_rad = 0.0;  ///< of the vehicle on entering, left positive, 0 along the x axis of the world
};

/// A time interval with degraded vision. Kinds: "movers", "illumination", "weak texture".
struct Disturbance {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  std::string kind;
};

/// Ground truth, events and panoramas of a journey. Everything except `truth` is optional.
struct JourneyRecording {
  std::filesystem::path folder;
  Trajectory truth;  ///< world_from_base, world of the recording
  std::string route;
  std::string seed;
  std::vector<std::string> effects;
  std::map<int, JourneyPlace> places;         ///< by number
  std::vector<JourneyVisit> visits;           ///< in order of time
  std::vector<Disturbance> disturbances;      ///< adjacent intervals of one kind are merged
  std::int64_t panorama_clock_offset_ns = 0;  ///< clock of the panoramic camera minus clock of the ground truth
  std::vector<RecordedPanorama> panoramas;    ///< in order of time
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
};

/// Reads a data set in EuRoC/ASL layout, with sequence.yaml and cam2 if present; a run folder, of which only
/// ground_truth.tum is used; or a trajectory. Throws InputError (file, line, remedy).
JourneyRecording read_journey_recording(const std::filesystem::path& folder);

/// Panoramas with the stamps of their own camera, each with the true pose `late_ns` after its stamp; only those for which
/// the ground truth has one. Throws InputError if there are none.
std::vector<RecordedPanorama> panoramas_as_stamped(const JourneyRecording& recording, std::int64_t late_ns = 0);

/// Ground truth with the distance travelled along it.
class TruePath {
 public:
  explicit TruePath(const Trajectory& truth);

  /// nullopt outside the time span of the ground truth.
  std::optional<Eigen::Isometry3d> pose(std::int64_t stamp_ns) const;
  /// Distance since the first pose, m; outside the time span, clamped to its ends.
  double travelled_m(std::int64_t stamp_ns) const;
  const Trajectory& trajectory() const { return truth_; }

 private:
  const Trajectory& truth_;
  std::vector<double> way_m_;
};

double yaw_of(const Eigen::Isometry3d& world_from_base);  ///< left positive, (-pi, pi]

}  // namespace panvo::evaluation
