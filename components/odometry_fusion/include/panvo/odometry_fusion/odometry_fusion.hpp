// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "panvo/odometry_fusion/consistency.hpp"
#include "panvo/odometry_fusion/fusion_parameters.hpp"
#include "panvo/odometry_fusion/motion_filter.hpp"
#include "panvo/odometry_fusion/sample_window.hpp"
#include "panvo/odometry_fusion/sensor_data.hpp"
#include "panvo/odometry_fusion/sensor_trial.hpp"
#include "panvo/vision/odometry_path.hpp"
#include "panvo/vision/usual_interval.hpp"

namespace panvo::odometry_fusion {

/// The vehicle's motion by all sensors.
struct FusedPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();  ///< of the pose, as vision::pose_error
  vision::Vector6d twist = vision::Vector6d::Zero();  ///< mean since the previous pose, m/s and rad/s, in base_link
  /// Of the twist. By default that of an unknown one, such as the first, or the first after the clock was set back.
  vision::Matrix6d twist_covariance = 1e6 * vision::Matrix6d::Identity();
  bool is_reliable = true;  ///< measured by cameras or wheels
  bool is_standing = false;
  bool uses_cameras = false, uses_gyro = false, uses_wheels = false;

  /// Takes pose and twist, with covariances, from a filter at the end of an interval.
  void take_motion(const MotionFilter& filter);
};

/// State of an optional sensor.
struct SensorState {
  bool is_used = false;  ///< it measures what the cameras see
  std::string fault;     ///< why it is not used, and the remedy; empty while there is nothing to report
};

/// Fuses stereo odometry, gyroscope and wheels into one odometry that starts in the first stereo pose. A sensor takes
/// part once it has agreed with the cameras, and no longer when it contradicts them.
class OdometryFusion {
 public:
  explicit OdometryFusion(const FusionParameters& parameters);

  /// False, without effect: not finite, or not later than the fused pose (sensors: too old, or a stamp twice).
  bool add(const StereoPose& stereo);
  bool add(const GyroSample& sample);
  bool add(const WheelSample& sample);

  /// The stereo odometry's clock was set back: forgets all samples and begins again at this pose, where the path so far
  /// leads. `refused`: poses since the last that was added. False, without effect, if it is not finite.
  bool begin_again(const StereoPose& stereo, int refused);

  /// The next pose, of a stereo pose or, if none come, of the wheels' and gyroscope's samples. nullopt: none yet. Call it
  /// until then after each add().
  std::optional<FusedPose> next();

  /// The latest pose of next().
  const std::optional<FusedPose>& latest() const noexcept { return latest_; }

  /// The pose at the gyroscope's newest sample: the latest one, carried on by gyroscope and wheels, at constant
  /// velocity where they do not measure. nullopt: no later sample, or one more than half a second later.
  std::optional<FusedPose> predicted() const;

  const SensorState& gyro() const noexcept { return gyro_.state; }
  const SensorState& wheels() const noexcept { return wheels_.state; }
  /// Whether wheels are also used for rotations, and why not.
  const SensorState& wheel_yaw() const noexcept { return wheel_yaw_; }
  /// rad/s; while the gyroscope is on trial, its mean difference to the cameras.
  Eigen::Vector3d gyro_bias() const;
  /// By how much the stamps of the wheels are late.
  double wheels_late_s() const noexcept { return wheels_late_s_; }
  const MotionFilter& filter() const noexcept { return filter_; }

 private:
  template <class Sample, class Trial>
  struct Sensor {
    SampleWindow<Sample> window;
    Trial trial = {};
    SensorState state = {};
    Consistency consistency = {};
  };
  /// What is known of one interval.
  struct Interval {
    std::int64_t from_ns, to_ns;
    double dt_s;
    std::optional<Eigen::Isometry3d> seen;  // by the cameras
    vision::Matrix6d seen_covariance;
    bool is_reliable = false;  // what was seen
    std::vector<GyroSample> gyro;
    std::vector<WheelSample> wheels;
    bool uses_gyro = false, uses_wheels = false;  // they are trusted, and measured
  };

  struct Begin {
    Eigen::Isometry3d odom_from_base;
    vision::Matrix6d covariance;
  };

  Begin continued(const StereoPose& stereo, int refused) const;
  bool must_wait(std::optional<std::int64_t> latest_ns, std::int64_t stamp_ns, double clock_s) const;
  std::optional<std::int64_t> blind_until() const;
  Interval interval(std::int64_t from_ns, std::int64_t to_ns) const;
  void see(Interval& now, const StereoPose& stereo);
  FusedPose step(std::int64_t to_ns, const std::optional<StereoPose>& stereo);
  void try_sensors(Interval& now);
  void try_gyro(const Interval& now);
  void try_wheels(const Interval& now);
  void accept_gyro();
  void choose_sensors(Interval& now) const;
  bool is_gyro_still(std::int64_t to_ns) const;
  bool is_standing(const Interval& now) const;
  FusedPose stand(const Interval& now);
  FusedPose move(const Interval& now);
  FusedPose move_seen(const Interval& now);
  FusedPose move_blind(const Interval& now);
  FusedPose continue_blind(const Interval& now, MotionFilter& filter) const;
  FusedPose move_ahead(MotionFilter& ahead, std::int64_t to_ns) const;
  bool does_wheel_follow_gyro(const Interval& now) const;
  void doubt_sensors();
  Factor factor_of_gyro(const MotionFilter& filter, const Interval& now) const;
  Factor factor_of_wheels(const MotionFilter& filter, const Interval& now) const;
  bool has_wheel_yaw(const Interval& now) const;

  FusionParameters parameters_;
  MotionFilter filter_;
  Sensor<GyroSample, GyroTrial> gyro_;
  Sensor<WheelSample, WheelTrial> wheels_;
  SensorState wheel_yaw_;
  std::optional<Begin> begin_;  // nullopt: at the first stereo pose
  std::deque<StereoPose> waiting_;
  vision::OdometryPath path_;  // of the stereo odometry
  std::optional<StereoPose> previous_stereo_;
  std::optional<FusedPose> latest_;
  std::int64_t newest_ns_ = INT64_MIN;               // stamp of a stereo pose
  double wheels_late_s_ = 0.0;                       // their stamps
  std::optional<std::int64_t> wheels_at_stereo_ns_;  // latest wheel sample when the last stereo pose arrived
  vision::UsualInterval interval_;                   // of stereo poses
};

}  // namespace panvo::odometry_fusion
