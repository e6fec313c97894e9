// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "panvo/localizer/estimate.hpp"
#include "panvo/localizer/gnss_fix.hpp"
#include "panvo/localizer/localizer_parameters.hpp"
#include "panvo/localizer/odometry_buffer.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::localizer {

class PoseGraph;

/// A landmark with known pose.
struct KnownLandmark {
  std::uint32_t id = 0;
  std::int64_t stamp_ns = 0;  ///< of its panorama
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
};

/// Pose of a panorama relative to a landmark: current base_link in the axes of base_link at the landmark.
struct LandmarkSighting {
  std::int64_t stamp_ns = 0;
  std::uint32_t landmark_id = 0;
  Eigen::Isometry3d landmark_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  bool stands_alone = true;                                ///< false: from few points, needs confirmation
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();  ///< of base_link, in its axes: what a wrong stamp changes
};

struct PoseInMap {
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
};

/// Pose graph of a journey with bounded size: its start, the landmarks built on it, the passes by known landmarks, and
/// the odometry between them. Solving it corrects landmarks and path [beyond Lu2015 5.2].
class LocalPoseGraph {
 public:
  /// Standard deviations of the initial pose of a map, and of the odometry's scale, which satellites correct.
  LocalPoseGraph(double start_sigma_m, double start_sigma_rad, double scale_sigma, const GnssParameters& fixes);

  /// The odometry's scale is known. Before the start.
  void expect_scale(const Estimate& scale);
  void start(const OdometrySample& at);
  void set_turn_errors(const TurnErrors& errors) { turn_errors_ = errors; }
  /// Standard deviation of the direction of the odometry's path relative to the vehicle.
  void set_direction_sigma(double sigma_rad) { direction_sigma_rad_ = sigma_rad; }
  bool has_started() const noexcept { return !nodes_.empty(); }
  /// Number of nodes: start, landmarks, passes.
  std::size_t size() const noexcept { return nodes_.size(); }
  /// Whether neither landmarks nor external poses joined the start.
  bool has_only_start() const;

  /// A landmark of an earlier journey. It enters the graph when it is seen.
  void add_known(const KnownLandmark& landmark) { known_.insert_or_assign(landmark.id, landmark); }
  bool has_known() const noexcept { return !known_.empty(); }
  bool is_known(std::uint32_t id) const { return known_.contains(id); }

  /// A landmark built from the panorama of a stamp, taken `at` that moment of the odometry.
  void add_built(std::uint32_t id, std::int64_t panorama_ns, const OdometrySample& at);
  /// An external pose of the vehicle.
  void set_initial_pose(const PoseInMap& pose, const OdometrySample& at);
  /// Adds a sighting; false if a pass by the same landmark within `same_pass_m` of path has a better one. Keeps the
  /// last and the most precise passes per landmark, 8 in all, which bounds the graph on repeated routes.
  bool add_pass(const LandmarkSighting& sighting, const OdometrySample& at, double same_pass_m);

  /// Begins the use of satellites, with the approximate pose of their frame in the map, or its pose and covariance from
  /// an earlier journey. Forgets earlier fixes.
  void set_enu(const Eigen::Isometry3d& map_from_enu, const std::optional<vision::Matrix6d>& covariance);
  bool has_enu() const noexcept { return enu_.has_value(); }
  /// Adds a fix. Keeps 64, evenly spaced along the path. Precondition: has_enu().
  void add_fix(const GnssFix& fix, const OdometrySample& at);
  /// Pose of the frame of the satellites in the map; precondition: has_enu().
  PoseInMap map_from_enu() const { return {enu_->map_from_enu, enu_->covariance}; }
  /// Measured over true length of the odometry, by satellites or as expected.
  const Estimate& scale() const noexcept { return scale_; }
  /// The same once satellites have halved its variance.
  std::optional<Estimate> measured_scale() const;
  /// Of the stamps of fixes behind the odometry's clock, s.
  const Estimate& fix_delay() const noexcept { return delay_; }
  /// enu_from_base of an odometry pose. Precondition: has_enu().
  PoseInMap in_enu(const OdometrySample& at) const;

  /// Current estimate; nullopt for an unknown id.
  std::optional<KnownLandmark> landmark(std::uint32_t id) const;
  /// Landmarks of this journey and those of earlier journeys that were seen, by ascending id.
  std::vector<KnownLandmark> landmarks() const;

  /// Pose in the map of an odometry pose, from the last node before it. Precondition: started. With satellites, the
  /// uncertainty of the scale counts from the last solution on.
  PoseInMap carried(const OdometrySample& at) const;

  /// Error common to all poses around one, which the graph cannot contain: that of the earlier journeys' map, as its
  /// landmark that was passed next has it, and since_known(); or else that of the scale and direction of this journey
  /// relative to its start or to an external pose. A single landmark of the earlier map is part of the graph.
  vision::Matrix6d common_covariance(const OdometrySample& at) const;
  /// The same for a landmark of this journey. Precondition: it was built.
  vision::Matrix6d common_covariance(std::uint32_t built_id) const {
    return common_covariance(landmark_node(built_id)->at);
  }
  /// Velocity of the vehicle, in the map, where the earlier journeys' map was seen next; zero if it was not.
  Eigen::Vector3d velocity_where_known(const OdometrySample& at) const;
  struct CommonErrors {
    vision::Matrix6d covariance;
    Eigen::Vector3d velocity_where_known_m_s;
  };
  /// Both, of each landmark of this journey alone, by id, in a time that hardly depends on the others.
  std::map<std::uint32_t, CommonErrors> common_errors() const;
  /// What scale and direction of the odometry add on the way from where the earlier journeys' map was seen next, or the
  /// pose was said; zero if neither.
  vision::Matrix6d since_known(const OdometrySample& at) const;

  /// Moves the whole journey, its start with it, to where it is assumed to have begun.
  void move(const Eigen::Isometry3d& map_from_former_map);
  /// The same once its place in the map is known by other means than its start, which from then on tells nothing.
  void place(const Eigen::Isometry3d& map_from_former_map);
  /// Cuts the odometry between the nodes around this time, as the vehicle was lifted.
  void cut(std::int64_t stamp_ns) { cuts_ns_.push_back(stamp_ns); }
  /// Updates the nodes after a time from the chain, whose poses have changed.
  void refresh(const OdometryBuffer& chain, std::int64_t since_ns);

  /// The stamps of panoramas after `since_ns` are ahead of the odometry's by so much: moves their nodes along the path,
  /// where the chain still covers them.
  void set_clock(const OdometryBuffer& chain, std::int64_t ahead_ns, std::int64_t since_ns);
  /// Shifts all stamps of this journey back.
  void set_clock_back(std::int64_t by_ns);

  /// False, without effect, if no solution was found. In a graph of more than 200 nodes only the covariances of the
  /// hundred nearest to the newest are renewed; those of others remain, which measurements elsewhere hardly change.
  bool solve();

 private:
  /// A moment of this journey, or a landmark of an earlier journey seen on it.
  struct Node {
    std::uint32_t landmark_id = 0;   ///< built or passed there; 0: the start
    bool is_pass = false;            ///< passed
    bool is_of_earlier_day = false;  ///< not on this journey's path
    OdometrySample at;               ///< odometry at that moment
    LandmarkSighting sighting;       ///< of a pass; of a built landmark only the stamp of its panorama
    std::optional<PoseInMap> said;   ///< external pose
    std::optional<GnssFix> fix;
    Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
    vision::Matrix6d covariance = vision::Matrix6d::Zero();
  };

  /// Nodes from which the errors common to all poses around one count: the last one before it, and those next to it that
  /// saw the map of earlier journeys, or the direction; or else, the external pose next to it. Null: none.
  struct From {
    const Node* anchor = nullptr;
    const Node* known_pass = nullptr;
    const Node* shown = nullptr;
    const Node* said = nullptr;
    bool is_of_one_landmark = false;
  };
  class Path;

  /// Frame of the satellites' positions. Errors of poses in it are smaller than the sum of its own and the pose's in the
  /// map: `cross` is the covariance of the two, of the journey's last node.
  struct Enu {
    Eigen::Isometry3d map_from_enu = Eigen::Isometry3d::Identity();
    vision::Matrix6d covariance = vision::Matrix6d::Zero(), cross = vision::Matrix6d::Zero();
    std::int64_t solved_ns = 0;      // of that node
    std::optional<PoseInMap> known;  // from an earlier journey
  };

  std::vector<std::size_t> wanted_covariances(const std::vector<Eigen::Isometry3d>& poses, std::size_t newest) const;
  void add_fixes(PoseGraph& graph, const std::vector<std::size_t>& order) const;
  void thin_out_fixes();
  bool is_cut(std::int64_t from_ns, std::int64_t to_ns) const;
  void forget_least_precise_pass(std::uint32_t landmark_id);
  const Node* landmark_node(std::uint32_t id) const;
  const Node& anchor(std::int64_t stamp_ns) const;
  const Node* solved_node() const;
  bool is_known_pass(const Node& node) const { return node.is_pass && known_.contains(node.landmark_id); }
  bool shows_direction(const Node& node) const;
  template <class Condition>
  const Node* next_on_way(const OdometrySample& at, Condition&& condition) const;
  PoseInMap reckoned(const OdometrySample& at) const;
  PoseInMap reckoned(const OdometrySample& at, const Node& from) const;
  const Node* nearer(const OdometrySample& at, const Node* before, const Node* after) const;
  From around(const OdometrySample& at) const;
  bool counts_from_said(const OdometrySample& at, const From& from) const;
  bool is_tied_over_cuts() const;
  bool is_of_one_landmark() const;
  vision::Matrix6d common_covariance(const OdometrySample& at, const From& from) const;
  static Eigen::Vector3d velocity_at(const From& from);
  vision::Matrix6d since(const Node& begin, const Eigen::Vector3d& position) const;
  vision::Matrix6d since_shown(const OdometrySample& at, const Node* from) const;
  /// `from`: solved_node()
  vision::Matrix6d since_solution(const OdometrySample& at, const Node* from) const;
  std::vector<std::size_t> journey_order() const;
  Eigen::Isometry3d way_between(const OdometryPose& from, const OdometryPose& to) const;
  vision::Matrix6d way_covariance(const OdometrySample& from, const OdometrySample& to) const;

  PoseInMap start_;  // what is known of the first node; its covariance is that of a new map
  double expected_scale_ = 1.0, scale_sigma_;
  GnssParameters fix_parameters_;
  TurnErrors turn_errors_;
  double direction_sigma_rad_ = 0.0;
  std::map<std::uint32_t, KnownLandmark> known_;
  std::vector<Node> nodes_;
  std::vector<std::int64_t> cuts_ns_;
  bool is_placed_ = false;  // the map is not the one that began with the journey
  std::optional<Enu> enu_;
  Estimate scale_{1.0, 0.0};  // of the odometry; without satellites as expected
  Estimate delay_{0.0, 0.0};  // of the fixes, s
};

}  // namespace panvo::localizer
