// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "panvo/fleet/byte_budget.hpp"
#include "panvo/fleet/common_frame.hpp"
#include "panvo/fleet/evidence.hpp"
#include "panvo/fleet/fleet_pose.hpp"
#include "panvo/fleet/map_join.hpp"
#include "panvo/fleet/members.hpp"
#include "panvo/fleet/pose_trail.hpp"
#include "panvo/fleet/recognition.hpp"
#include "panvo/fleet/shared_map.hpp"
#include "panvo/landmarks/landmark_source.hpp"

namespace panvo::fleet {

struct SharingParameters {
  double max_kb_per_s = 20.0;
  double burst_s = 5.0;
  double moved_m = 0.05;
  double moved_deg = 0.2;
  double step_m = 0.5;

  template <class Field>
  static void describe(Field&& field) {
    using P = SharingParameters;
    field(&P::max_kb_per_s, "max_kb_per_s", "kB/s", "largest mean rate of what is sent to other robots", 1.0, 1e6);
    field(&P::burst_s, "burst_s", "s", "seconds of that rate that may be sent at once after a pause", 0.1, 600.0);
    field(&P::moved_m, "moved_m", "m", "a place that moves less in the own map is not sent again", 0.0, 100.0);
    field(&P::moved_deg, "moved_deg", "deg", "the same of its rotation", 0.0, 180.0);
    field(&P::step_m, "step_m", "m", "path between panoramas that are compared with places of other robots", 0.0,
          100.0);
  }
};

struct FleetParameters {
  SharingParameters sharing;
  MemberParameters members;
  RecognitionParameters recognition;
  JoinParameters join;
};

/// Asks the owner of a map for what is missing.
struct Request {
  MapId map = 0;
  std::optional<std::uint64_t> from_version;  ///< changes after it were missed
  std::vector<std::uint32_t> keypoints;       ///< of these places
};

struct KeypointAnswer {
  MapId map = 0;
  std::uint32_t place = 0;
  std::vector<landmarks::Keypoint> keypoints;
};

using FleetMessage = std::variant<Announcement, Request, KeypointAnswer, MapChanges>;

/// One robot of a fleet: shares its places, follows the maps of others, recognises their places, and finds the frame that
/// the joined maps have in common. Without messages, clocks or threads: what it has to send is fetched by next(), and
/// times are of any monotonic clock. Not thread-safe.
class Fleet {
 public:
  /// `own_keypoints`: of the own places, given on request.
  Fleet(const FleetParameters& parameters, std::string robot, const landmarks::KeypointParameters& keypoints,
        const landmarks::PanoramaDescriber& describer, landmarks::DescriptionSettings settings,
        std::shared_ptr<const landmarks::LandmarkSource> own_keypoints, vision::StageObserver* observer = nullptr);

  // The own map and pose.
  void add_pose(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_base, const vision::Matrix6d& covariance,
                double speed_m_per_s);
  void add_place(landmarks::PanoramicLandmark place);
  void move_places(const std::vector<landmarks::LandmarkPose>& poses);
  /// Whether the pose at this stamp is known, so that a panorama can be used; false also if it has not arrived yet.
  bool has_pose_at(std::int64_t stamp_ns) const { return trail_.at(stamp_ns).has_value(); }
  /// Looks for places of others in a panorama (CV_8UC1, 2:1). The reason if it cannot be described.
  std::optional<std::string> add_panorama(std::int64_t stamp_ns, const cv::Mat& panorama,
                                          const Eigen::Isometry3d& base_from_panorama);

  // Messages of other robots; the reason if one is refused.
  std::optional<std::string> hear(const Announcement& said, std::int64_t now_ns);
  std::optional<std::string> take(const std::string& robot, const MapChanges& changes, std::int64_t now_ns);
  std::optional<std::string> answer(const std::string& robot, const Request& request, std::int64_t now_ns);
  std::optional<std::string> take(const std::string& robot, KeypointAnswer answer);

  /// Decides on joins, to be called a few times a second.
  void advance(std::int64_t now_ns);

  /// The next message to send; nullopt if there is none now or the rate is used up. Report its size by sent().
  std::optional<FleetMessage> next(std::int64_t now_ns);
  void sent(std::size_t bytes) { budget_.take(bytes); }

  const std::string& robot() const noexcept { return robot_; }
  /// The own map; nullptr before its first place and first pose.
  const SharedMap* own() const noexcept { return own_ ? &*own_ : nullptr; }
  const Members& members() const noexcept { return members_; }
  const Evidence& evidence() const noexcept { return evidence_; }
  const CommonFrame& frame() const noexcept { return frame_; }
  /// Of the own map in the common frame, as it fits near the vehicle.
  const Eigen::Isometry3d& common_from_own() const noexcept { return common_from_own_; }
  /// Covariance of a pose in the common frame, given that in the own map.
  vision::Matrix6d covariance_in_common(const vision::Matrix6d& covariance_in_own) const;
  const Recognition::Counts& counts() const noexcept { return recognition_.counts(); }
  std::vector<std::string> take_news();

 private:
  /// Slots of the sightings of one map.
  struct Ring {
    std::uint32_t index = 0, used = 0;
  };

  void begin();
  void share(Sighting sighting);
  void use_ready_views();
  std::optional<ViewPoint> view_point(const PoseSample& pose) const;
  std::vector<const SharedMap*> maps() const;
  std::vector<ForeignPlace> foreign_places() const;
  std::optional<Request> next_request(std::int64_t now_ns);
  void share_moves(std::int64_t now_ns);
  void find_frame();
  void find_pose();
  Announcement announcement() const;

  const FleetParameters parameters_;
  const std::string robot_;
  const landmarks::DescriptionSettings settings_;
  const std::string settings_text_;
  std::shared_ptr<const landmarks::LandmarkSource> own_keypoints_;
  Members members_;
  Recognition recognition_;
  Evidence evidence_;
  CommonFrame frame_;
  FleetPose pose_;  ///< the own one, at the last decision
  Eigen::Isometry3d common_from_own_ = Eigen::Isometry3d::Identity();
  ByteBudget budget_;

  PoseTrail trail_;
  std::optional<std::int64_t> first_stamp_ns_;
  std::vector<landmarks::PanoramicLandmark> early_;  ///< places before the first pose
  std::optional<SharedMap> own_;
  std::map<std::uint32_t, landmarks::LandmarkPose> poses_;  ///< of own places, as the localizer has them
  std::map<MapId, Ring> sighted_;
  std::optional<double> searched_at_m_;

  std::uint64_t sent_version_ = 0, highest_sent_ = 0;
  std::map<std::string, std::int64_t> repeated_ns_;  ///< when changes were last repeated for a robot
  std::deque<std::uint32_t> asked_for_;              ///< own places whose keypoints were requested
  std::optional<std::int64_t> announced_ns_, moved_ns_, posed_ns_;
  bool has_moved_ = false;  ///< poses_ holds poses that are not shared yet
  std::vector<std::string> news_;
};

}  // namespace panvo::fleet
