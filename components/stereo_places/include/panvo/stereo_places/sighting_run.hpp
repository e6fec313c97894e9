// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>

namespace panvo::stereo_places {

struct RunParameters {
  int sightings = 3;
  double way_m = 2.0;
  int unlocated_sightings = 5;
  double unlocated_way_m = 6.0;
  double agree_m = 0.5;
  double agree_deg = 3.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = RunParameters;
    field(&P::sightings, "sightings", "1", "consecutive sightings that must agree before the pose is corrected", 1,
          100);
    field(&P::way_m, "way_m", "m", "path that they must span; ten degrees of turn count as one metre", 0.0, 100.0);
    field(&P::unlocated_sightings, "unlocated_sightings", "1",
          "the same while the position in a stored map is unknown: nothing else excludes an equal place elsewhere", 1,
          100);
    field(&P::unlocated_way_m, "unlocated_way_m", "m", "path that these must span", 0.0, 1000.0);
    field(&P::agree_m, "agree_m", "m",
          "largest distance between consecutive sightings that agree, besides 3 % of the path", 0.01, 10.0);
    field(&P::agree_deg, "agree_deg", "deg", "largest angle between them", 0.1, 30.0);
  }
};

/// Pose of the vehicle relative to a place, and its odometry.
struct Sighting {
  std::int64_t stamp_ns = 0;
  std::uint32_t landmark_id = 0;
  Eigen::Isometry3d landmark_from_base = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
  double way_m = 0.0;  ///< path length since the start
};

/// Consecutive sightings that agree with the odometry between them. A narrow view of an equal building deceives for a
/// moment; it does not as long as the vehicle drives.
class SightingRun {
 public:
  /// Current pose of a landmark's base in the map; nullopt if it is unknown.
  using PoseOf = std::function<std::optional<Eigen::Isometry3d>(std::uint32_t id)>;

  explicit SightingRun(const RunParameters& parameters) : parameters_(parameters) {}

  /// Continues the run, or begins another one if the sighting does not agree with the last.
  void add(const Sighting& sighting, const PoseOf& pose_of);

  /// Whether the run suffices; `is_located`: the position in the map is known.
  bool is_confirmed(bool is_located) const;

  /// The last sighting, if it is at most 15 m back; for the search of its landmark.
  std::optional<std::uint32_t> landmark(double way_m) const;

  int sightings() const noexcept { return count_; }
  double way_m() const noexcept { return progress_m_; }

 private:
  bool agrees(const Sighting& sighting, const PoseOf& pose_of) const;

  RunParameters parameters_;
  std::optional<Sighting> last_;
  int count_ = 0;
  double progress_m_ = 0.0;
};

}  // namespace panvo::stereo_places
