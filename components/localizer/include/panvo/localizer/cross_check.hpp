// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "panvo/localizer/azimuth_measurement.hpp"
#include "panvo/localizer/dead_reckoning.hpp"
#include "panvo/localizer/direction_offset.hpp"
#include "panvo/localizer/dispute.hpp"
#include "panvo/localizer/doubt.hpp"
#include "panvo/localizer/estimate.hpp"
#include "panvo/localizer/localizer_parameters.hpp"
#include "panvo/localizer/mounting_history.hpp"
#include "panvo/localizer/odometry_buffer.hpp"
#include "panvo/localizer/speed_witness.hpp"

namespace panvo::localizer {

/// Checks whether odometry and panoramas agree on the vehicle's motion, decides which one is wrong if not, and inflates
/// the odometry's covariance accordingly. Never changes the odometry's poses.
class CrossCheck {
 public:
  /// Interval between two panoramas; the earlier one is the reference for several.
  struct Stretch {
    std::int64_t reference_ns;    ///< stamp of the earlier panorama
    std::int64_t from_ns, to_ns;  ///< in the odometry's clock
  };

  /// Between the turns of a stretch.
  struct Disagreement {
    double rad;        ///< panoramas minus odometry
    bool is_too_much;  ///< more than the errors of both
    bool is_of_mount;  ///< see shows_turned_mount()
  };

  explicit CrossCheck(const Parameters& parameters);

  /// Processes the latest odometry step.
  void add_step(const OdometryBuffer& chain);

  /// Whether the direction of motion shows that one of the mounts was turned: a camera that is rotated on its mount sees
  /// the vehicle turn, and its motion turned back by as much. A vehicle that turns goes on ahead. `turned_rad`: turn by
  /// panoramas minus that by odometry; `way_variance_m2`: as below.
  bool shows_turned_mount(const OdometryBuffer& chain, const Stretch& stretch, const AzimuthMeasurement& azimuth,
                          double turned_rad, double way_variance_m2) const;

  /// The following measurements have a new reference panorama.
  void begin_reference();

  /// Adds the turns of a stretch. Returns which one is wrong; nullopt if neither.
  std::optional<Wrong> add_turns(const OdometryBuffer& chain, const Stretch& stretch, const Disagreement& turns);

  /// Adds the ways of a stretch, after add_turns and its consequences. `way_variance_m2`: odometry's variance, summed over both
  /// axes. Returns the time since which the vehicle may have moved differently from odometry; nullopt if it has not.
  std::optional<std::int64_t> add_ways(OdometryBuffer& chain, const Stretch& stretch, const AzimuthMeasurement& azimuth,
                                       double way_variance_m2);

  /// A place confirmed the pose at this time, so that what odometry missed before no longer matters. For systems without
  /// a compass.
  void confirm_pose(std::int64_t stamp_ns);

  /// A place that corrects the pose.
  struct Place {
    std::int64_t stamp_ns;  ///< in the odometry's clock
    double off_m, sigma_m;  ///< horizontally: from where it was expected; of the sighting
    std::int64_t built_ns;  ///< the same; INT64_MIN on an earlier journey
  };
  void add_place(const Place& place);
  /// Something else corrected the pose at this time: how far odometry was off before, no place tells.
  void add_correction(std::int64_t stamp_ns);

  /// Discards measurements of the former clock, except the mounting angles.
  void forget();

  /// Why odometry is unreliable at `now_ns`; nullopt if it is reliable.
  std::optional<std::string> fault_of_odometry(std::int64_t now_ns) const;
  std::vector<Doubt> doubts(std::int64_t now_ns) const;

  /// Standard deviation of the direction of the whole path.
  double direction_sigma_rad() const;
  /// Of the two mounts, with what has lasted for some panoramas; nullopt while it is not measured.
  std::optional<MountDirection> mount_direction() const;
  const DirectionOffset& direction_offset() const noexcept { return direction_offset_; }
  /// As an earlier journey found it, unless the first panoramas show another one.
  void remember_direction(const Estimate& rad) { direction_offset_.remember(rad.value, rad.sigma * rad.sigma); }
  /// Of the two mounts as they are now, once it is certain.
  std::optional<Estimate> settled_direction() const;
  /// As it was before panoramas that are added again.
  void set_direction_offset(const DirectionOffset& offset) { direction_offset_ = offset; }
  /// Whether a panorama of this time tells something of now: at slow cameras, the next one is not due yet.
  bool is_fresh(std::int64_t stamp_ns, std::int64_t now_ns) const;

 private:
  struct TurnAndWay {  // in the plane
    double turn_rad;
    Eigen::Vector2d way_m;  // in the axes at its end
  };

  struct GoneOn {  // deviation from constant motion since odometry and panoramas last agreed
    TurnAndWay more;
    double turn_sigma_rad, way_sigma_m;  // of usual vehicle motion in that time
  };

  struct Seen {  // difference of directions, panoramas minus odometry
    double difference_rad, variance_rad2;
  };

  struct Lasting {  // difference between the directions
    std::int64_t reference_ns;
    double seen_rad;
    double way_m;
  };

  struct WayVerdict {                         // on odometry's path along a stretch
    std::optional<double> off_m;              // deviation from the panoramas; nullopt if they agree
    std::optional<Seen> seen;                 // a difference of directions within the errors
    bool is_other_mounting = false;           // than what is remembered
    std::optional<Lasting> lasting;           // lasting_ from now on
    std::optional<Seen> new_offset;           // of the mounting
    std::optional<double> camera_turned_rad;  // camera_turned_rad_ from now on
  };

  struct Jump {                                     // of the odometry's speed
    std::int64_t since_ns;                          // last image before it
    std::int64_t shown_ns;                          // last image that shows it
    double speed_m_s;                               // change
    bool is_from_agreement = false;                 // odometry was right before
    std::optional<std::int64_t> contradicted_ns{};  // last panorama that contradicts it
    bool is_agreeing = false;                       // the last panorama confirmed it
    std::int64_t corrected_ns = INT64_MIN;          // up to which the pose was corrected

    std::int64_t last_ns() const { return std::max(shown_ns, contradicted_ns.value_or(shown_ns)); }
  };

  struct Unjumped {   // a stretch, if the vehicle went on as before the jump
    double length_m;  // of the whole stretch
    double off_m;     // from odometry
    double time_s;    // since the jump
  };

  struct Off {  // in a dispute on the way
    std::int64_t stamp_ns;
    double total_m;
  };

  struct Break {  // of the odometry, between two measured images
    std::int64_t from_ns, to_ns;
    std::int64_t vouched_ns;  // up to which panoramas confirm odometry
    bool is_over;
  };

  static std::optional<TurnAndWay> moved(const OdometryBuffer& chain, std::int64_t from_ns, std::int64_t to_ns);
  std::optional<GoneOn> gone_on(const OdometryBuffer& chain, std::int64_t to_ns) const;
  bool goes_on_steadily(const OdometryBuffer& chain, std::int64_t to_ns) const;
  Seen seen_directions(const AzimuthMeasurement& azimuth, const TurnAndWay& odometry, double way_variance_m2) const;
  Blame judge_turn(const OdometryBuffer& chain, std::int64_t to_ns, const Disagreement& turns) const;
  DirectionOffset latest_offset() const;
  double allowed_rad(double variance_rad2, const DirectionOffset& offset) const;
  DirectionOffset offset_before(const Seen& seen) const;
  WayVerdict judge_way(const AzimuthMeasurement& azimuth, const TurnAndWay& odometry, double way_variance_m2) const;
  void take(const WayVerdict& verdict);
  void look_for_jump(const OdometryBuffer& chain);
  std::optional<Unjumped> unless_it_jumped(const OdometryBuffer& chain, std::int64_t from_ns, std::int64_t to_ns) const;
  bool goes_on_as_before(const Stretch& stretch, const Unjumped& unjumped) const;
  std::optional<double> settle_jump(OdometryBuffer& chain, const Stretch& stretch, double said_m,
                                    double side_parallax_rad);
  std::optional<double> settle_old_jump(const Stretch& stretch, double said_m, double side_parallax_rad);
  void catch_up(OdometryBuffer& chain, const Stretch& stretch);
  bool is_old_jump(std::int64_t now_ns) const;
  void end_jump();
  void drop_old_jump(std::int64_t now_ns);
  Lasting lasting_with(std::int64_t reference_ns, double seen_rad, double length_m) const;
  std::optional<std::int64_t> settle_break(OdometryBuffer& chain, const Stretch& stretch);
  bool is_disputed() const noexcept { return turn_dispute_.is_on() || way_dispute_.is_on(); }
  bool is_camera_turned() const noexcept {
    return turn_dispute_.is_on() && turn_dispute_.blame().wrong == Wrong::kPanoramas;
  }
  void dispute_way(const Stretch& stretch, double off_m);
  void end_way_dispute();
  double total_off_m(std::int64_t stamp_ns) const;
  void note_panorama(std::int64_t stamp_ns);

  // Probability that the side considered right in a dispute is wrong: then the pose is off by three standard deviations.
  static constexpr double kDoubt = 1.0 / 9.0;
  static constexpr double kSteady_s = 0.2;          // interval over which the current motion is measured
  static constexpr double kOdometryError_m = 0.03;  // over some tenths of a second
  static constexpr double kSteady = 3.0;            // standard deviations of usual vehicle motion

  const double contradiction_sigmas_, patience_s_;
  const MotionPrior motion_;
  const double stereo_mounting_sigma_rad_;
  DirectionOffset direction_offset_;
  double camera_turned_rad_ = 0.0;  // accumulated rotation of the panoramic camera on its mount
  Dispute turn_dispute_, way_dispute_;
  std::deque<Off> off_;                    // since the dispute on the way began
  std::optional<std::int64_t> agreed_ns_;  // last panorama that agreed with odometry
  std::optional<Seen> seen_;               // last, against the current reference
  std::optional<Lasting> lasting_;         // while the directions differ
  std::optional<Jump> jump_;               // not yet confirmed by a panorama
  Dispute unsure_;                         // while panoramas neither confirm nor contradict it
  SpeedWitness witness_;
  std::optional<std::int64_t> speed_agreed_ns_;   // panorama that confirmed the speed after the last jump
  std::optional<Break> break_;                    // not yet confirmed by a panorama
  std::optional<std::int64_t> panorama_ns_;       // last one
  std::array<double, 2> panorama_intervals_s_{};  // the last ones
};

}  // namespace panvo::localizer
