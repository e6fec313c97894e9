// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "panvo/localizer/turn_error_filter.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::localizer {

/// A published odometry pose; covariance as vision::pose_error, growing from the start.
struct OdometryPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  bool is_reliable = true;            ///< false: extrapolated without measurement
  double lean_sigma_rad_per_m = 0.0;  ///< of a constant turn per metre, not in the covariance; 0 if unknown
};

/// Odometry pose with what was travelled up to it. Systematic errors of the odometry's turns act only on that part of way
/// and turns which no compass measured: each step counts by the weight that odometry has in its turn.
struct OdometrySample {
  OdometryPose pose;
  double way_m = 0.0;
  double turn_rad = 0.0;  ///< sum of the steps' yaws, left positive, not wrapped
  double unmeasured_way_m = 0.0;
  double unmeasured_turn_rad = 0.0;  ///< left positive, not wrapped
  /// Integrals of both over the path, in the odometry's frame.
  Eigen::Vector2d way_moment = Eigen::Vector2d::Zero(), turn_moment = Eigen::Vector2d::Zero();
};

/// Rotation of the vehicle, left positive, not wrapped: a vehicle that turns in place may turn by more than 180 degrees
/// between two panoramas.
struct Turn {
  double change_rad = 0.0;
  double variance_rad2 = 0.0;
};

/// Buffer of the recent odometry steps. Late information, such as another measurement of a turn, is applied where it
/// belongs, distributed over the steps by their uncertainty.
class OdometryBuffer {
 public:
  explicit OdometryBuffer(double history_s) : history_s_(history_s) {}

  /// Appends a pose; false, without effect, if its stamp is not later than the last or it is not finite.
  /// `turn_error_rad`: what odometry turned too much since the last pose; `least`: lower bound of the step's covariance,
  /// in the vehicle's axes; `turn_variance_rad2`: added to that of its yaw.
  bool add(const OdometryPose& odometry, double turn_error_rad = 0.0,
           const vision::Matrix6d& least = vision::Matrix6d::Zero(), double turn_variance_rad2 = 0.0);

  bool empty() const noexcept { return entries_.empty(); }
  /// Precondition: not empty.
  const OdometrySample& latest() const { return entries_.back().now; }
  /// Stamp of the pose that is so many poses before the latest; nullopt if it is not stored.
  std::optional<std::int64_t> stamp_before_latest(std::size_t poses) const;
  /// Interpolated between the two poses around a time, or extrapolated by up to 5 ms after the last; nullopt outside
  /// the buffer.
  std::optional<OdometrySample> at(std::int64_t stamp_ns) const;

  /// Turn between two stored times.
  std::optional<Turn> turn(std::int64_t from_ns, std::int64_t to_ns) const;
  /// The same for the odometry as received, without corrections.
  std::optional<double> raw_turn(std::int64_t from_ns, std::int64_t to_ns) const;
  /// Linear (m/s), then angular (rad/s) velocity in the vehicle's axes; nullopt if no step is stored.
  std::optional<vision::Vector6d> twist(std::int64_t stamp_ns) const;

  /// Increases the uncertainty of a stretch: multiplies the yaw variance by `factor`, and the other variances by
  /// `factor`, limited to `max_total` in total over repeated calls.
  void inflate_covariance(std::int64_t from_ns, std::int64_t to_ns, double factor, double max_total);
  /// Rotates a stretch by an additional angle that a compass measured, distributed over the steps by variance, and
  /// multiplies the yaw variance.
  void apply_yaw_correction(std::int64_t from_ns, std::int64_t to_ns, double by_rad, double variance_factor);

  /// Corrects all turns, as far as no compass measured them, by what has become known of the odometry's errors.
  void correct_turns(const TurnErrorChange& learned);

  /// Undoes all corrections of turns since a time: those by a compass, and those for what odometry turned too much beyond
  /// what was known of it then.
  void undo_turns(std::int64_t from_ns, const TurnErrorFilter& known);

  /// Adds variance to a stretch, distributed over the steps by time: to both axes of the plane, and to the yaw.
  void allow(std::int64_t from_ns, std::int64_t to_ns, double way_variance_m2, double yaw_variance_rad2);

  /// Shifts all stamps back.
  void set_clock_back(std::int64_t by_ns);

  /// Saves the steps after a time ...
  void mark(std::int64_t from_ns);
  /// ... and restores them, undoing the corrections since then, for a better measurement.
  void revert();

 private:
  struct Step {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();  // previous pose from this one
    vision::Matrix6d covariance = vision::Matrix6d::Zero();    // in the axes of the previous pose
    double widened = 1.0;          // factor on the variances other than yaw, relative to the odometry's
    double odometry_weight = 1.0;  // of the odometry in the turn, the rest is a compass'

    double yaw_variance_rad2() const { return covariance(vision::kYaw, vision::kYaw); }
  };
  struct Entry {
    OdometryPose raw;           // as received
    double raw_turn_rad = 0.0;  // sum of the yaws of its steps, not wrapped
    Step step;
    Step marked;         // the step to restore
    OdometrySample now;  // composition of all steps up to this one
  };

  /// A time between an entry and the previous one: 0 at the previous, 1 at the entry, more after the last.
  struct Place {
    std::size_t after;
    double share;
  };

  struct RawPose {
    Eigen::Isometry3d odom_from_base;
    double turn_rad;
  };

  std::optional<Place> place_of(std::int64_t stamp_ns) const;
  std::size_t first_after(std::int64_t stamp_ns) const;
  std::optional<RawPose> raw_at(std::int64_t stamp_ns) const;
  double share(std::size_t index, std::int64_t from_ns, std::int64_t to_ns) const;
  void compose_from(std::size_t index);

  const double history_s_;
  std::deque<Entry> entries_;
  std::int64_t marked_from_ns_ = 0;
};

/// Covariance of a_from_b gained by odometry between a and b, in the axes of a; at least `min_variance` in every
/// direction.
vision::Matrix6d gained_covariance(const OdometryPose& a, const OdometryPose& b, double min_variance);

/// Covariance of a_from_b, as above, by systematic errors of the turns.
vision::Matrix6d covariance_of_turns(const OdometrySample& a, const OdometrySample& b, const TurnErrors& errors);

/// The step with an additional turn to the left, half of it before and half after the translation.
Eigen::Isometry3d turned_more(const Eigen::Isometry3d& step, double by_rad);

/// Yaw of a rotation about the upward z axis, rad, (-pi, pi].
double yaw_of(const Eigen::Matrix3d& rotation);

}  // namespace panvo::localizer
