// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

namespace panvo::odometry_fusion {

/// Whether a sensor measures the motion that the cameras see.
struct Verdict {
  bool is_good = false;
  std::string fault;  ///< what is wrong and how to correct it; empty while undecided or good
};

/// Compares a gyroscope with the cameras' rotations, and finds wrong units, signs and axes.
class GyroTrial {
 public:
  /// Rotations in one interval of `dt_s`, rad, in base_link: as integrated from the gyroscope, and as seen.
  void add(const Eigen::Vector3d& by_gyro, const Eigen::Vector3d& seen, double dt_s);

  /// Undecided until the vehicle has turned by some 20 degrees.
  Verdict verdict() const;
  /// Whether nothing speaks against the gyroscope after some seconds, though the vehicle may not have turned.
  bool is_plausible() const;
  /// Mean difference of the rates and its standard deviation, rad/s: for a good gyroscope, its bias. Zero at first.
  Eigen::Vector3d bias() const { return mean_gyro_ - mean_seen_; }
  double bias_sigma() const;

 private:
  void add_window();
  /// Row i, column k: rate about axis i that the gyroscope shows when the vehicle turns about axis k at 1 rad/s.
  Eigen::Matrix3d response() const;
  bool is_excited(int axis) const;
  bool is_quiet() const;
  Eigen::Vector3d residual_variance() const;

  double window_s_ = 0.0;
  Eigen::Vector3d window_gyro_ = Eigen::Vector3d::Zero(), window_seen_ = Eigen::Vector3d::Zero();
  int windows_ = 0;
  double weight_ = 0.0;  // of the windows so far; older ones count less
  Eigen::Vector3d mean_gyro_ = Eigen::Vector3d::Zero(), mean_seen_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d gyro_seen_ = Eigen::Matrix3d::Zero(), seen_seen_ = Eigen::Matrix3d::Zero();  // sums about the means
  Eigen::Vector3d gyro_gyro_ = Eigen::Vector3d::Zero();
};

/// Compares wheels with the cameras' motion, and finds wrong units, signs and dead encoders.
class WheelTrial {
 public:
  struct Rolled {
    double forward_m = 0.0, yaw_rad = 0.0, speed_change_m_s = 0.0;
  };

  /// Motion in one interval of `dt_s` by wheels, and as seen.
  void add(const Rolled& rolled, double seen_forward_m, double seen_yaw_rad, double dt_s);

  /// Of distances. Undecided until the vehicle has moved some metres.
  Verdict verdict() const;
  /// By how much the stamps are late, s, at most 0.1 after a good verdict; 0 while unknown.
  double late_s() const;
  /// Of rotations; neither good nor faulty if the wheels do not measure any. Undecided until the vehicle has turned by
  /// some 20 degrees.
  Verdict yaw_verdict() const;
  bool measures_yaw() const { return yaw_.measured2() > 0.0; }

 private:
  /// Least squares of what wheels measured over what was seen: measured = x[0] seen - x[1] change. Changes of speed show
  /// late stamps.
  class Fit {
   public:
    void add(double measured, double seen, double change);

    double seen2() const { return normal_(0, 0); }
    double change2() const { return normal_(1, 1); }
    double measured2() const { return measured2_; }
    Eigen::Vector2d solve() const;
    /// Deviation from the fit, relative to what was seen.
    double scatter() const;

   private:
    Eigen::Matrix2d normal_ = Eigen::Matrix2d::Zero();
    Eigen::Vector2d product_ = Eigen::Vector2d::Zero();
    double measured2_ = 0.0;
  };

  double window_s_ = 0.0;
  Rolled window_;
  double window_seen_m_ = 0.0, window_seen_rad_ = 0.0;
  Fit forward_, yaw_;
};

}  // namespace panvo::odometry_fusion
