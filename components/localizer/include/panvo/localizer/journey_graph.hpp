// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "panvo/localizer/odometry_chain.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::localizer {

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
  bool stands_alone = true;  ///< false: of so few points that another must agree
};

struct PoseInMap {
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
};

/// A journey as a graph that stays small: its start, the landmarks built on it, the passes by known landmarks, and the odometry between
/// them. Solving it pulls landmarks and way straight [beyond Lu2015 5.2].
class JourneyGraph {
 public:
  /// Standard deviations of the pose that a map begins with.
  JourneyGraph(double start_sigma_m, double start_sigma_rad);

  void start(const Remembered& at);
  bool has_started() const noexcept { return !nodes_.empty(); }
  /// Nodes: the start, landmarks, passes.
  std::size_t size() const noexcept { return nodes_.size(); }
  /// Whether nothing hangs on where the map began.
  bool is_bare() const noexcept { return nodes_.size() == 1; }

  /// A landmark of an earlier day. It enters the graph when it is seen.
  void add_known(const KnownLandmark& landmark) { known_.insert_or_assign(landmark.id, landmark); }
  bool has_known() const noexcept { return !known_.empty(); }
  bool is_known(std::uint32_t id) const { return known_.contains(id); }

  void add_built(std::uint32_t id, const Remembered& at);
  /// Where somebody says that the vehicle is.
  void add_said(const PoseInMap& pose, const Remembered& at);
  /// A sighting; false where a pass by the same landmark within `same_pass_m` of way has a better one. Of the passes by one landmark the last and the
  /// most precise are kept, 8 in all: a route that is driven all day keeps the graph as small as it was after the eighth time.
  bool add_pass(const LandmarkSighting& sighting, const Remembered& at, double same_pass_m);

  /// As known by now; nullopt for an id that is not there.
  std::optional<KnownLandmark> landmark(std::uint32_t id) const;
  /// Those of this journey, and those of earlier days that were seen, by ascending id.
  std::vector<KnownLandmark> landmarks() const;

  /// A pose of the odometry, from the last node before it. Precondition: started.
  PoseInMap carried(const OdometryPose& odometry) const;

  /// What all poses err alike, and the graph cannot know of: the error of the earlier days' map, here, as the landmark of them that
  /// was seen last has it, and of the scale and the direction of this journey, seen from where it began.
  vision::Matrix6d common_covariance(const Eigen::Vector3d& position, double scale_sigma,
                                     double direction_sigma_rad) const;

  /// The journey moves in the map as one piece, once it is known where it lies.
  void place(const Eigen::Isometry3d& map_from_former_map);
  /// Between the nodes around this time odometry says nothing any more: the vehicle was lifted.
  void cut(std::int64_t stamp_ns) { cuts_ns_.push_back(stamp_ns); }
  /// Odometry that is still remembered has changed since a time.
  void refresh(const OdometryChain& chain, std::int64_t since_ns);

  /// All stamps of this journey become so much earlier.
  void set_clock_back(std::int64_t by_ns);

  /// False where no poses were found that fit; it may have changed then and must not be used any more.
  bool solve();

 private:
  /// A moment of this journey, or a landmark of an earlier day that was seen on it.
  struct Node {
    std::uint32_t landmark_id = 0;   ///< built or passed there; 0: the start
    bool is_pass = false;            ///< passed
    bool is_of_earlier_day = false;  ///< no part of this journey's way
    Remembered at;                   ///< odometry then
    LandmarkSighting sighting;       ///< of a pass
    std::optional<PoseInMap> said;   ///< where somebody said that the vehicle was
    Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
    vision::Matrix6d covariance = vision::Matrix6d::Zero();
  };

  bool is_cut(std::int64_t from_ns, std::int64_t to_ns) const;
  void forget_least_precise_pass(std::uint32_t landmark_id);
  const Node* landmark_node(std::uint32_t id) const;
  const Node& anchor(std::int64_t stamp_ns) const;
  std::vector<std::size_t> journey_order() const;
  vision::Matrix6d way_covariance(const OdometryPose& from, const OdometryPose& to) const;

  double start_sigma_m_, start_sigma_rad_;
  std::map<std::uint32_t, KnownLandmark> known_;
  std::vector<Node> nodes_;
  std::vector<std::int64_t> cuts_ns_;
  bool is_placed_ = false;  // the map is another than that which began with the journey
};

}  // namespace panvo::localizer
