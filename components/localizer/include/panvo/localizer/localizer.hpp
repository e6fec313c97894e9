// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "panvo/localizer/azimuth_lean.hpp"
#include "panvo/localizer/azimuth_measurement.hpp"
#include "panvo/localizer/clock_offset.hpp"
#include "panvo/localizer/cross_check.hpp"
#include "panvo/localizer/dead_reckoning.hpp"
#include "panvo/localizer/doubt.hpp"
#include "panvo/localizer/journey_graph.hpp"
#include "panvo/localizer/localizer_parameters.hpp"
#include "panvo/localizer/mounting_check.hpp"
#include "panvo/localizer/odometry_chain.hpp"
#include "panvo/localizer/odometry_origin.hpp"
#include "panvo/localizer/turn_scale.hpp"

namespace panvo::localizer {

enum class State {
  kStarting,     ///< no odometry yet
  kUnlocated,    ///< odometry, but a map of earlier days in which the start is not known
  kTracking,     ///< in the map
  kCompassOnly,  ///< the odometry cannot be relied on; the panoramas say how the vehicle turns, nobody how far it goes
  kLost,         ///< neither can be relied on, or the position has become too uncertain
  kRelocalised,  ///< a sighting has just said where the vehicle is, after it was unlocated or lost
  kStale,        ///< no odometry arrives any more; told by who sees time pass
};

/// starting, unlocated, tracking, compass_only, lost, relocalised or stale
std::string to_text(State state);

struct LocalizedPose {
  std::int64_t stamp_ns = 0;
  State state = State::kStarting;
  std::string reason;                                                ///< of the state; may be empty
  Eigen::Isometry3d map_from_odom = Eigen::Isometry3d::Identity();   ///< jumps when a place corrects the position
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();  ///< never jumps
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();  ///< of map_from_base, as of vision::pose_error
};

/// What became of a pose of the odometry.
struct OdometryOutcome {
  bool is_taken = false;
  bool has_begun_anew = false;  ///< elsewhere: the pose in the map goes on from where it was
  std::string reason;           ///< why it was not taken
};

enum class CorrectionKind { kApplied, kBetterKnown, kRejected };

struct Correction {
  CorrectionKind kind = CorrectionKind::kRejected;
  std::string reason;       ///< why it was not applied
  double chi_square = 0.0;  ///< of the sighting against what was expected; 6 degrees of freedom
  Eigen::Isometry3d map_from_base_before = Eigen::Isometry3d::Identity();  ///< at the sighting's time
  Eigen::Isometry3d map_from_base_after = Eigen::Isometry3d::Identity();
};

enum class AzimuthUse {
  kFused,         ///< with the odometry's own, by their variances
  kContradicted,  ///< the odometry's own was too far off to be right: it was taken for wrong
  kDoubted,       ///< it turned as no vehicle does, and the odometry went on steadily: it was left out
  kNotUsed,       ///< no odometry of that time, or no finite number
};

/// One pose from odometry, compass and places: odometry carries it; the compass straightens its azimuth, most where odometry
/// is least sure; sightings of landmarks correct it at their own stamp, and pull the landmarks and the way between them straight.
/// Stamps of panoramas may be off by a constant, which it finds by itself.
class Localizer {
 public:
  explicit Localizer(const Parameters& parameters);

  /// In order of stamps; one that is not after the last, has a fault (fault_of), or that no vehicle reaches (OdometryOrigin) changes nothing.
  OdometryOutcome add(const OdometryPose& told);

  AzimuthUse add(const AzimuthMeasurement& azimuth);

  /// A landmark of an earlier day, with its pose and uncertainty; before any sighting of it. The first of them at the start of the journey makes
  /// the start unknown; later, the journey goes on in its own map until two panoramas agree where it lies in that of the landmarks. False, and
  /// nothing is changed, where it has a fault.
  bool add_known(const KnownLandmark& landmark);

  /// The journey did not begin where its map does: it is unlocated, for this reason, until a place is recognised or somebody says
  /// where it is. `last`: where it was last known to be, which is told meanwhile.
  void forget_start(const std::optional<PoseInMap>& last, std::string reason);

  /// A landmark that was built on this journey of the panorama of `stamp_ns`. False when odometry of that time is not remembered.
  bool add_built(std::uint32_t id, std::int64_t stamp_ns);

  Correction add(const LandmarkSighting& told);

  /// Somebody says where the vehicle is at a time (in the odometry's clock), and with what certainty; what he leaves open, a variance
  /// of 0, is not known. Where the vehicle was known to be, he says that it was moved. False when odometry of that time is not
  /// remembered, or the pose has a fault; nothing is changed then.
  bool add_said(const PoseInMap& pose, std::int64_t stamp_ns);

  /// The odometry's clock was set back: all that is remembered is of so much earlier a time by it.
  void set_clock_back(std::int64_t by_ns);

  const LocalizedPose& latest() const noexcept { return latest_; }
  /// The latest pose, as uncertain as it is so long after the last odometry.
  LocalizedPose after_silence(double silence_s) const;
  /// What speaks against the latest pose.
  std::vector<Doubt> doubts() const;
  /// Way of the odometry since the start, m.
  double way_m() const { return chain_.empty() ? 0.0 : chain_.latest().way_m; }
  /// True when odometry reaches as far as a panorama's stamp: what is to be said of it can be said.
  bool reaches(std::int64_t panorama_stamp_ns) const;
  /// Where the landmarks of this journey, and those seen on it, are by now; by ascending id.
  std::vector<KnownLandmark> landmarks() const;
  const ClockOffset& panorama_clock() const noexcept { return clock_; }
  const MountingCheck& mounting() const noexcept { return mounting_; }
  const DirectionOffset& direction_offset() const noexcept { return check_.direction_offset(); }

 private:
  struct Asking {  // a sighting that was not believed
    LandmarkSighting sighting;
    Eigen::Isometry3d map_from_odom;
    double way_m;
    double off_m;  // horizontally, of where the vehicle was expected
    bool is_far;   // by the gate
    std::int64_t at_ns;
  };

  struct TurnSeen {  // by odometry and compass
    double disagreement_rad, turn_rad, variance_rad2;
  };

  std::int64_t in_odometry_time(std::int64_t panorama_stamp_ns) const;
  LocalizedPose localized(const OdometryPose& odometry) const;
  void tell_state(LocalizedPose& pose) const;
  PoseInMap expected(const OdometryPose& odometry) const;
  vision::Matrix6d common_covariance(const Eigen::Vector3d& position) const;
  std::string doubt(const LandmarkSighting& sighting, const KnownLandmark& landmark, const Remembered& at,
                    Correction& correction);
  bool agree(const Asking& before, const Asking& now) const;
  LandmarkSighting with_uncertain_clock(const LandmarkSighting& sighting) const;
  void fuse(std::int64_t from_ns, std::int64_t to_ns, double change_rad, double variance_rad2);
  void slew(const Eigen::Isometry3d& step);

  const Parameters parameters_;
  OdometryOrigin origin_;
  OdometryChain chain_;
  ClockOffset clock_;
  TurnScale turn_scale_;
  AzimuthLean lean_;
  CrossCheck check_;
  DeadReckoning dead_reckoning_;
  JourneyGraph graph_;
  MountingCheck mounting_;

  Eigen::Isometry3d last_raw_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d smooth_ = Eigen::Isometry3d::Identity();  // odom_from_base as it is told
  double owed_rad_ = 0.0;                                     // turn that it has yet to make up for

  bool is_located_ = true;
  bool is_joined_ = true;  // the map is that of the known landmarks, if there are any
  std::string unlocated_reason_ = "no place of earlier days was recognised yet";
  std::optional<std::int64_t> unreliable_since_ns_;  // odometry, up to now
  std::optional<std::int64_t> doubtful_ns_;   // the last time since a correction that odometry may have missed a move
  std::optional<std::int64_t> azimuth_ns_;    // the last that was used
  std::optional<std::int64_t> last_from_ns_;  // the panorama that it was measured against
  std::optional<TurnSeen> turn_seen_;         // against that panorama, last
  std::optional<double> found_at_way_m_;      // where the vehicle was found last, after it was not known where
  std::optional<Asking> asking_;              // the last sighting that was not believed
  std::optional<Asking> dissent_;             // the last pair of them, of another landmark
  LocalizedPose latest_;
};

}  // namespace panvo::localizer
