// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "panvo/localizer/azimuth_measurement.hpp"
#include "panvo/localizer/clock_offset.hpp"
#include "panvo/localizer/cross_check.hpp"
#include "panvo/localizer/dead_reckoning.hpp"
#include "panvo/localizer/doubt.hpp"
#include "panvo/localizer/extrinsics_monitor.hpp"
#include "panvo/localizer/gnss_trial.hpp"
#include "panvo/localizer/local_pose_graph.hpp"
#include "panvo/localizer/localizer_parameters.hpp"
#include "panvo/localizer/mounting_history.hpp"
#include "panvo/localizer/odometry_buffer.hpp"
#include "panvo/localizer/odometry_origin.hpp"
#include "panvo/localizer/self_calibration.hpp"
#include "panvo/localizer/turn_error_filter.hpp"
#include "panvo/localizer/yaw_bias_detector.hpp"
#include "panvo/vision/clock_search.hpp"

namespace panvo::localizer {

enum class State {
  kStarting,     ///< no odometry yet
  kUnlocated,    ///< odometry, but the start in the loaded map is unknown
  kTracking,     ///< localised in the map
  kCompassOnly,  ///< odometry unreliable; panoramas give the rotation, nothing gives the distance
  kLost,         ///< neither is reliable, or the position is too uncertain
  kRelocalised,  ///< just located by a sighting, after being unlocated or lost
  kStale,        ///< odometry timeout; set by callers that track time
};

/// starting, unlocated, tracking, compass_only, lost, relocalised or stale
std::string to_text(State state);

struct LocalizedPose {
  std::int64_t stamp_ns = 0;
  State state = State::kStarting;
  std::string reason;                                                ///< of the state; may be empty
  Eigen::Isometry3d map_from_odom = Eigen::Isometry3d::Identity();   ///< jumps at corrections
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();  ///< never jumps
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();  ///< of map_from_base, as vision::pose_error
};

/// Result of adding an odometry pose.
struct OdometryOutcome {
  bool is_taken = false;
  bool has_begun_anew = false;  ///< odometry restarted from another origin; the pose in the map continues
  std::string reason;           ///< why it was rejected
};

enum class CorrectionKind { kApplied, kBetterKnown, kRejected };

struct Correction {
  CorrectionKind kind = CorrectionKind::kRejected;
  std::string reason;       ///< why it was not applied
  double chi_square = 0.0;  ///< of the sighting against the expected pose; 6 degrees of freedom
  Eigen::Isometry3d map_from_base_before = Eigen::Isometry3d::Identity();  ///< at the sighting's stamp
  Eigen::Isometry3d map_from_base_after = Eigen::Isometry3d::Identity();
};

enum class FixUse {
  kUsed,
  kBegun,     ///< the first that are used, or used again, from now on
  kTooClose,  ///< to the one before, along the path
  kOnTrial,   ///< the path is too short to compare, or its shape differs: see the reason
  kRejected,
};

struct FixOutcome {
  FixUse use = FixUse::kRejected;
  std::string reason;  ///< why it was not used; may be empty
};

enum class AzimuthUse {
  kFused,         ///< with odometry's turn, weighted by variances
  kContradicted,  ///< odometry's turn was considered wrong
  kDoubted,       ///< not used: implausible turn while odometry continued steadily
  kUnclear,       ///< not used: a wrong turn, or one at another time because a clock is wrong
  kTooEarly,      ///< not used: it began before the odometry
  kNotUsed,       ///< no odometry for its stamps, or not finite
};

/// Fuses odometry, compass and landmark sightings into one pose. Odometry propagates it; the compass corrects the
/// azimuth, mostly where odometry is least certain; sightings correct it at their own stamps, together with the
/// landmarks and the path between them. Estimates a constant offset of the panorama stamps.
class Localizer {
 public:
  explicit Localizer(const Parameters& parameters);

  /// Begins with what an earlier journey measured of the sensors, until this one measures it. Before the first odometry.
  void set_self_calibration(const SelfCalibration& measured);
  /// What this journey has measured of them.
  SelfCalibration self_calibration() const;

  /// Poses in order of stamps. Without effect: a stamp not later than the last, a pose with a fault (fault_of), or one
  /// that no vehicle can reach (OdometryOrigin).
  OdometryOutcome add(const OdometryPose& received);

  AzimuthUse add(const AzimuthMeasurement& azimuth);

  /// Adds a landmark of an earlier journey, with pose and covariance, before any sighting of it. If the first one
  /// arrives at the start of the journey, the start becomes unknown; later, the journey keeps its own map until two
  /// panoramas agree on its place in the map of the landmarks. Returns false, without effect, if the landmark has a
  /// fault.
  bool add_known(const KnownLandmark& landmark);

  /// Declares the start in the map unknown: the state is unlocated, with this reason, until a landmark is recognised or
  /// an external pose arrives. `last`: last known pose, published meanwhile.
  void forget_start(const std::optional<PoseInMap>& last, std::string reason);

  /// A landmark built on this journey from the panorama of `stamp_ns`. False if odometry of that time is no longer
  /// stored.
  bool add_built(std::uint32_t id, std::int64_t stamp_ns);

  Correction add(const LandmarkSighting& received);

  /// Position by satellites. Used once the fixes of some path have the shape of the odometry's; unused if the pose
  /// contradicts it. Corrects the path, and shows the scale of the odometry and where on earth the map is.
  FixOutcome add(const GnssFix& fix);
  /// Where the frame of the satellites is in the map of the known landmarks, from an earlier journey: then fixes show
  /// where the vehicle is in that map before any landmark is seen.
  void set_known_enu(const PoseInMap& map_from_enu) { known_enu_ = map_from_enu; }
  /// Those that are not used yet, as they are in another frame than the next ones.
  void forget_trial_of_fixes() { fix_trial_.clear(); }
  /// Whether there is a frame of the satellites.
  bool has_enu() const noexcept { return graph_.has_enu(); }
  /// Latest enu_from_base, and the map in that frame. Precondition: has_enu().
  PoseInMap latest_in_enu() const;
  PoseInMap map_from_enu() const { return graph_.map_from_enu(); }
  /// Odometry's length over the true one, by satellites of this journey or an earlier one; 1 without them.
  const Estimate& scale() const noexcept { return graph_.scale(); }
  /// Of the stamps of fixes behind the odometry's clock, s.
  const Estimate& fix_delay() const noexcept { return graph_.fix_delay(); }

  /// External pose of the vehicle at a time (odometry clock); variances of 0 mean unknown. If the vehicle was
  /// localised, it means that the vehicle was moved. Returns false, without effect, if odometry of that time is no
  /// longer stored or the pose has a fault.
  bool set_initial_pose(const PoseInMap& pose, std::int64_t stamp_ns);

  /// The odometry's clock was set back, or forward if negative: shifts all stored stamps by this much. The path goes on.
  /// Which of the two times is right is unknown, and so is where the vehicle is at the stamp of a pose: until the clock is
  /// set to the former time again, or turns show that the panoramic camera's clock was set alike.
  void set_clock_back(std::int64_t by_ns);
  /// It was set back by so much less, or forward by so much more.
  void correct_set_back(std::int64_t less_ns);
  /// The odometry's stamps, and those of the panoramas against them, are right all the same.
  void trust_stamps();

  const LocalizedPose& latest() const noexcept { return latest_; }
  /// The latest pose with the uncertainty gained since the last odometry.
  LocalizedPose after_silence(double silence_s) const;
  /// Doubts about the latest pose.
  std::vector<Doubt> doubts() const;
  /// Path length of the odometry since the start, m.
  double way_m() const { return chain_.empty() ? 0.0 : chain_.latest().way_m; }
  /// Whether odometry covers a panorama's stamp, so that its measurements can be added.
  bool reaches(std::int64_t panorama_stamp_ns) const;
  /// Current poses of the landmarks of this journey and of those seen on it, by ascending id.
  std::vector<KnownLandmark> landmarks() const;
  const ClockOffset& panorama_clock() const noexcept { return clock_; }
  /// Whether a large offset of it is excluded or was found.
  bool is_clock_known() const { return parameters_.clock_sigma_s == 0.0 || clock_search_.has_found(); }
  const ExtrinsicsMonitor& mounting() const noexcept { return mounting_; }
  const DirectionOffset& direction_offset() const noexcept { return check_.direction_offset(); }

 private:
  /// Standard deviation of a panoramic camera's clock before the search, or if it may have been stepped: latency of a
  /// video stream.
  static constexpr double kUnknownClock_s = 0.3;

  struct PendingRelocalization {  // a sighting that was not accepted
    LandmarkSighting sighting;
    Eigen::Isometry3d map_from_odom;
    double way_m;
    double off_m;  // horizontally, from the expected position
    bool is_far;   // outside the gate
    std::int64_t at_ns;
  };

  struct Verdict {                                 // on a sighting
    std::string objection;                         // why it is not to be applied; empty if it is
    double chi_square = 0.0;                       // against the expected pose; 0 if that is unknown
    double off_m = 0.0;                            // the same, horizontally
    std::optional<PendingRelocalization> asking;   // asking_ from now on
    std::optional<PendingRelocalization> dissent;  // conflicting_ from now on
    std::optional<std::int64_t> cut_ns;            // odometry missed a motion at this time
  };

  /// Turns from before the clock was known, the longest against each reference panorama, and what was known before them.
  struct Early {
    std::deque<AzimuthMeasurement> turns;
    TurnErrorFilter turn_error;
    DirectionOffset direction_offset;
  };

  struct TurnSeen {  // by odometry and compass
    double disagreement_rad, turn_rad, way_m, variance_rad2;
  };

  FixOutcome try_fixes(const GnssTrial::Sample& sample, double least_m);
  bool is_expected(const GnssFix& fix, const OdometrySample& at) const;
  std::int64_t in_odometry_time(std::int64_t panorama_stamp_ns) const;
  LocalizedPose localized(const OdometrySample& at) const;
  void set_state(LocalizedPose& pose) const;
  PoseInMap expected(const OdometrySample& at) const;
  Verdict judge(const LandmarkSighting& sighting, const KnownLandmark& landmark, const OdometrySample& at) const;
  Verdict judge_far(Verdict verdict, const PendingRelocalization& now, bool is_confirmed) const;
  void take(const Verdict& verdict);
  bool confirms(const PendingRelocalization& now, const PendingRelocalization& before) const;
  bool follows(const PendingRelocalization& now, const PendingRelocalization& before) const;
  bool vouches(const PendingRelocalization& before, const PendingRelocalization& now) const;
  bool agree(const PendingRelocalization& before, const PendingRelocalization& now) const;
  double clock_sigma_s() const;
  vision::Matrix6d by_time(const OdometrySample& at, double time_s) const;
  void judge_stamps(double panoramas_ahead_s);
  vision::Matrix6d by_clock(const Eigen::Vector3d& velocity_m_s) const;
  LandmarkSighting with_uncertain_clock(const LandmarkSighting& sighting) const;
  LandmarkSighting with_uncertain_mount(const LandmarkSighting& sighting) const;
  AzimuthMeasurement unwrapped(AzimuthMeasurement azimuth) const;
  AzimuthUse use(const AzimuthMeasurement& received);
  void keep_early(const AzimuthMeasurement& azimuth);
  void use_early_again(std::int64_t fused_ahead_ns);
  void search_clock(const AzimuthMeasurement& azimuth);
  void set_clock(const vision::ClockSearch::Found& found, std::int64_t panorama_stamp_ns);
  void agree(std::int64_t panorama_stamp_ns, double disagreement_rad, double rate_change_rad_s, double sigma_rad);
  bool may_be_of_another_time(const AzimuthMeasurement& azimuth, double within_rad);
  vision::ClockSearch::Reference turns_of_odometry() const;
  void take_reference(std::int64_t panorama_stamp_ns);
  std::optional<YawBiasDetector::Bias> add_to_lean(YawBiasDetector::Stretch turn);
  void straighten(const YawBiasDetector::Bias& lean);
  void inflate(std::int64_t from_ns, std::int64_t to_ns, double disagreement_rad);
  void fuse(std::int64_t from_ns, std::int64_t to_ns, double change_rad, double variance_rad2);
  double in_sums(double compass_variance_rad2) const {
    return parameters_.compass_correlation_ratio * compass_variance_rad2;
  }
  void doubt_step(const Eigen::Isometry3d& step);
  void slew(const Eigen::Isometry3d& step);

  const Parameters parameters_;
  OdometryOrigin origin_;
  OdometryBuffer chain_;
  ClockOffset clock_;
  vision::ClockSearch clock_search_;
  vision::ClockDoubt clock_doubt_;
  bool is_clock_doubtful_ = false;            // it may have been stepped
  std::int64_t clock_found_ns_ = INT64_MIN;   // odometry before that was corrected at the wrong times
  bool was_clock_set_ = false;                // of the odometry, since its last pose
  double set_back_s_ = 0.0;                   // the odometry's clock, in all; 0 if its stamps are right all the same
  double last_set_s_ = 0.0;                   // the same, last, unless panoramas have shown their clock since
  std::int64_t clock_proven_ns_ = INT64_MIN;  // stamp of the last panorama whose turn agreed, but not at other times
  TurnErrorFilter turn_error_;
  YawBiasDetector lean_;
  CrossCheck check_;
  DeadReckoning dead_reckoning_;
  LocalPoseGraph graph_;
  std::optional<Early> early_;
  bool is_using_again_ = false;  // the turns of early_: the graph follows when all are fused
  ExtrinsicsMonitor mounting_;
  MountingHistory mounts_;
  std::map<std::uint32_t, vision::Vector6d> built_twists_;  // of the vehicle at its landmarks, in its axes
  GnssTrial fix_trial_;                                     // of fixes that are not used
  std::optional<double> last_fix_at_way_m_;                 // used or on trial
  std::optional<PoseInMap> known_enu_;

  Eigen::Isometry3d last_raw_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d smooth_ = Eigen::Isometry3d::Identity();  // published odom_from_base
  double pending_yaw_correction_rad_ = 0.0;                   // yaw correction not yet applied to it

  bool is_located_ = true;
  bool is_joined_ = true;  // the map is that of the known landmarks, if any
  std::string unlocated_reason_ = "not localised in the loaded map yet";
  std::optional<std::int64_t> unreliable_since_ns_;  // odometry, up to now
  std::optional<std::int64_t> doubtful_ns_;      // last time since a correction when odometry may have missed a motion
  std::optional<std::int64_t> azimuth_ns_;       // last one used
  std::optional<std::int64_t> last_from_ns_;     // its reference panorama
  std::optional<TurnSeen> turn_seen_;            // last, against that panorama
  std::optional<double> found_at_way_m_;         // where it was last located after being unlocated or lost
  std::optional<PendingRelocalization> asking_;  // last sighting not accepted
  std::optional<PendingRelocalization> conflicting_;  // last one seen twice, but beyond the second-look gate
  LocalizedPose latest_;
};

}  // namespace panvo::localizer
