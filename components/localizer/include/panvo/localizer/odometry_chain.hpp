// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>

#include "panvo/vision/pose.hpp"

namespace panvo::localizer {

/// A pose that odometry published; covariance as of vision::pose_error, growing from the start.
struct OdometryPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  bool is_reliable = true;     ///< false: carried on without being measured
  double outlier_share = 1.0;  ///< of the points, those that moved otherwise, [0, 1]; 1 where nobody says
};

/// Odometry with the way behind it.
struct Remembered {
  OdometryPose pose;
  double way_m = 0.0;
};

/// By how much the vehicle turned, left positive.
struct Turn {
  double change_rad = 0.0;
  double variance_rad2 = 0.0;
  double said_variance_rad2 = 0.0;  ///< before a share of it was kept
};

/// The odometry of the last while, step by step, so that what is learned late (a turn measured otherwise) can be put where it
/// belongs: into those steps that were least sure.
class OdometryChain {
 public:
  explicit OdometryChain(double history_s) : history_s_(history_s) {}

  /// In order of stamps; false, and nothing is done, for one that is not after the last or not finite. `turn_share`: of the variance that
  /// it gained in yaw, how much is kept; `turn_scale`: by what share its turns are too large; `least`: what the step's covariance must be at
  /// least, in the vehicle's axes.
  bool add(const OdometryPose& odometry, double turn_share = 1.0, double turn_scale = 0.0,
           const vision::Matrix6d& least = vision::Matrix6d::Zero());

  bool empty() const noexcept { return entries_.empty(); }
  /// Precondition: not empty.
  const Remembered& latest() const { return entries_.back().now; }
  /// The stamp of the one before it; nullopt where none is remembered.
  std::optional<std::int64_t> before_latest_ns() const;
  /// Between the two poses around a time, or going on for up to 5 ms after the last as it went; nullopt where it is not remembered.
  std::optional<Remembered> at(std::int64_t stamp_ns) const;

  /// Of the stretch from one remembered time to a later one.
  std::optional<Turn> turn(std::int64_t from_ns, std::int64_t to_ns) const;
  /// The same of the odometry as it came, before anything was put right.
  std::optional<double> raw_turn(std::int64_t from_ns, std::int64_t to_ns) const;
  /// Linear (m/s), then angular (rad/s), in the vehicle's axes; nullopt where no step is remembered.
  std::optional<vision::Vector6d> twist(std::int64_t stamp_ns) const;

  /// Takes the turns of a stretch for less sure than they said: multiplies the variance of the yaw by `factor`, and that of all else by
  /// `factor`, too, but not by more than `most_else` in all, however often it is distrusted.
  void distrust(std::int64_t from_ns, std::int64_t to_ns, double factor, double most_else);
  /// Makes a stretch turn by so much more, each step by its share of the variance, and multiplies the variance of its yaw.
  void turn_more(std::int64_t from_ns, std::int64_t to_ns, double by_rad, double variance_factor);

  /// Makes a stretch less sure by so much in all, each step by its share of the time: of both ways in the plane, and of the yaw.
  void allow(std::int64_t from_ns, std::int64_t to_ns, double way_variance_m2, double yaw_variance_rad2);

  /// All stamps become so much earlier.
  void set_clock_back(std::int64_t by_ns);

  /// Keeps the steps after a time as they are, ...
  void mark(std::int64_t from_ns);
  /// ... so that what was put right in them since can be taken back, for one who knows better now.
  void revert();

 private:
  struct Step {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();  // the one before from this
    vision::Matrix6d covariance = vision::Matrix6d::Zero();    // in the axes of the one before
    double widened = 1.0;     // the variance of all but the yaw, against what odometry said
    double turn_share = 1.0;  // of the variance of the yaw, what was kept
  };
  struct Entry {
    OdometryPose raw;  // as it came
    Step step;
    Step marked;     // the step as it is reverted to
    Remembered now;  // all steps up to this
  };

  /// A time between an entry and the one before it: 0 there, 1 at the entry, more after the last.
  struct Place {
    std::size_t after;
    double share;
  };

  std::optional<Place> place_of(std::int64_t stamp_ns) const;
  std::size_t first_after(std::int64_t stamp_ns) const;
  std::optional<Eigen::Isometry3d> raw_at(std::int64_t stamp_ns) const;
  double share(std::size_t index, std::int64_t from_ns, std::int64_t to_ns) const;
  void compose_from(std::size_t index);

  const double history_s_;
  std::deque<Entry> entries_;
  std::int64_t marked_from_ns_ = 0;
};

/// Covariance of a_from_b that odometry gained on the way from a to b, in the axes of a; at least `least_variance` along every direction.
vision::Matrix6d gained_covariance(const OdometryPose& a, const OdometryPose& b, double least_variance);

/// A step with so much more of a turn to the left, half of it before the way and half after it.
Eigen::Isometry3d turned_more(const Eigen::Isometry3d& step, double by_rad);

/// Yaw of a rotation about the upward z axis, rad, (-pi, pi].
double yaw_of(const Eigen::Matrix3d& rotation);

}  // namespace panvo::localizer
