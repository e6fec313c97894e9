// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "panvo/localizer/pose_graph.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::localizer {

struct Parameters {
  double gate_chi_square = 22.5;
  double second_look_m = 0.7;
  double second_look_deg = 3.0;
  double same_pass_m = 40.0;
  double history_s = 60.0;
  double start_sigma_m = 0.01;
  double start_sigma_deg = 0.1;

  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field(&P::gate_chi_square, "gate_chi_square", "1",
          "squared Mahalanobis distance up to which a correction is believed at once: 99.9 % of six degrees of freedom",
          1.0, 1e6);
    field(&P::second_look_m, "second_look_m", "m",
          "a correction beyond the gate is believed when the next panorama asks for the same within this", 0.01, 100.0);
    field(&P::second_look_deg, "second_look_deg", "deg", "and within this angle", 0.01, 180.0);
    field(&P::same_pass_m, "same_pass_m", "m",
          "panoramas of one landmark within this way are one pass: they err alike, and only the best of them counts",
          1.0, 1000.0);
    field(&P::history_s, "history_s", "s", "how late a correction may come", 1.0, 3600.0);
    field(&P::start_sigma_m, "start_sigma_m", "m", "of the pose that the map begins with", 1e-6, 10.0);
    field(&P::start_sigma_deg, "start_sigma_deg", "deg", "of the pose that the map begins with", 1e-6, 90.0);
  }
};

/// A pose that the stereo odometry published; covariance as of vision::pose_error, growing from the start.
struct OdometryPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
};

/// Odometry with the way behind it.
struct Remembered {
  OdometryPose pose;
  double way_m = 0.0;
};

/// A known place.
struct KnownLandmark {
  std::uint32_t id = 0;
  std::int64_t stamp_ns = 0;  ///< of its panorama
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
};

/// Where a panorama was taken, seen from a landmark: base_link now in the axes of base_link then.
struct LandmarkSighting {
  std::int64_t stamp_ns = 0;
  std::uint32_t landmark_id = 0;
  Eigen::Isometry3d landmark_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
};

enum class CorrectionKind { kApplied, kBetterKnown, kRejected };

struct Correction {
  CorrectionKind kind = CorrectionKind::kRejected;
  std::string reason;       ///< why it was not applied
  double chi_square = 0.0;  ///< of the sighting against what was expected
  Eigen::Isometry3d map_from_base_before = Eigen::Isometry3d::Identity();  ///< at the sighting's stamp
  Eigen::Isometry3d map_from_base_after = Eigen::Isometry3d::Identity();
};

enum class State {
  kStarting,     ///< no odometry yet
  kUnlocated,    ///< odometry, but a map of earlier days in which the start is not known
  kTracking,     ///< in the map
  kRelocalised,  ///< in a map of earlier days, since a first sighting
};

struct LocalizedPose {
  std::int64_t stamp_ns = 0;
  State state = State::kStarting;
  Eigen::Isometry3d map_from_odom = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();  ///< of map_from_base, as of vision::pose_error
};

/// One pose from odometry and places: odometry carries it, sightings of landmarks correct it, at their own stamp, and pull the
/// landmarks and the way between them straight [beyond Lu2015 5.2]. The graph has a node for each landmark of this journey and one
/// for each pass by a known one; it stays small.
class Localizer {
 public:
  explicit Localizer(const Parameters& parameters);

  /// In order of stamps; one that is not after the last, or not finite, changes nothing.
  LocalizedPose add(const OdometryPose& odometry);

  /// A landmark of an earlier day, with its pose and uncertainty; before any sighting of it.
  void add_known(const KnownLandmark& landmark);

  /// A landmark that was built on this journey at `stamp_ns`. Returns where it is, by all that is known; nullopt when odometry of
  /// that time is not remembered.
  std::optional<KnownLandmark> add_built(std::uint32_t id, std::int64_t stamp_ns);

  Correction add(const LandmarkSighting& sighting);

  const LocalizedPose& latest() const { return latest_; }
  /// All landmarks as they are known by now, in the order in which they were added.
  std::vector<KnownLandmark> landmarks() const;

 private:
  /// A moment of this journey, or a landmark of an earlier day.
  struct Node {
    std::uint32_t landmark_id = 0;   ///< built or passed there; 0: the start
    bool is_sighting = false;        ///< passed
    bool is_of_earlier_day = false;  ///< no part of this journey's way
    Remembered at;                   ///< odometry then
    LandmarkSighting sighting;
    KnownLandmark known;  ///< of an earlier day's landmark
    Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
    vision::Matrix6d covariance = vision::Matrix6d::Zero();
  };
  struct Pending {
    LandmarkSighting sighting;
    Eigen::Isometry3d map_from_odom;
  };

  std::optional<Remembered> remembered(std::int64_t stamp_ns) const;
  const Node* landmark(std::uint32_t id) const;
  const Node& anchor(std::int64_t stamp_ns) const;
  LocalizedPose carried(const OdometryPose& odometry) const;
  bool is_asked_for_twice(const LandmarkSighting& sighting, const Eigen::Isometry3d& map_from_odom);
  std::string doubt(const LandmarkSighting& sighting, const Node& landmark, const OdometryPose& odometry,
                    Correction& correction);
  void place_journey(const Eigen::Isometry3d& map_from_odom);
  bool take(const LandmarkSighting& sighting, const Remembered& at);
  std::vector<std::size_t> journey_order() const;
  void solve();

  const Parameters parameters_;
  std::deque<Remembered> history_;
  std::vector<Node> nodes_;
  std::optional<Pending> pending_;
  bool is_located_ = true;
  bool has_relocalised_ = false;
  LocalizedPose latest_;
};

}  // namespace panvo::localizer
