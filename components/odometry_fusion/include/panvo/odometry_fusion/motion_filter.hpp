// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "panvo/odometry_fusion/fusion_parameters.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::odometry_fusion {

/// What the filter learns about the sensors: index of each quantity.
enum Learned : int {
  kGyroBias = 0,       ///< rad/s, three axes of base_link
  kGyroMounting = 3,   ///< rad, three axes: rotation missing in /tf_static
  kGyroScale = 6,      ///< rates are too large by this share
  kGyroClock = 7,      ///< s, stamps are late
  kWheelScale = 8,     ///< distances are too short by this share
  kWheelYawScale = 9,  ///< the same of rotations
  kAxle = 10,          ///< m, forward from the unsteered axle to base_link
  kWheelLeft = 11,     ///< rad, the vehicle rolls this much to the left of base_link's x axis
  kWheelUp = 12,       ///< the same upwards
  kStereoScale = 13,   ///< distances are too short by this share
  kStereoTurnScale = 14,
  kLearned = 15
};

using LearnedVector = Eigen::Matrix<double, kLearned, 1>;

/// A measurement of the vehicle's motion in one interval: residual = measured - estimated, linear in the errors of that
/// motion (as vision::pose_error) and of the learned quantities.
struct Factor {
  static constexpr int kMaxRows = 6;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxRows, 1>;
  using ByStep = Eigen::Matrix<double, Eigen::Dynamic, 6, 0, kMaxRows, 6>;
  using ByLearned = Eigen::Matrix<double, Eigen::Dynamic, kLearned, 0, kMaxRows, kLearned>;
  using Covariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxRows, kMaxRows>;

  explicit Factor(int rows)
      : residual(Vector::Zero(rows)),
        by_step(ByStep::Zero(rows, 6)),
        by_learned(ByLearned::Zero(rows, kLearned)),
        noise(Covariance::Zero(rows, rows)) {}

  Vector residual;
  ByStep by_step;
  ByLearned by_learned;
  Covariance noise;
};

/// How a factor fits the filter's state.
struct Innovation {
  Factor::Vector residual;
  Factor::Vector noise_variance,
      systematic_variance;  ///< of each row: independent in each interval, and of the learned
  double chi_square = 0.0;  ///< squared Mahalanobis distance
};

/// Error-state Kalman filter over pose, motion in the current interval, and learned quantities. What is learned also
/// corrects the pose that was reached with it, by millimetres at a time; a standing vehicle's pose does not change.
class MotionFilter {
 public:
  explicit MotionFilter(const FusionParameters& parameters);

  /// Begins at a pose with its covariance (as vision::pose_error).
  void begin_at(const Eigen::Isometry3d& odom_from_base, const vision::Matrix6d& covariance);
  /// Begins an interval of `dt_s` whose motion is unknown.
  void begin_unknown(double dt_s);
  /// Begins an interval whose motion continues the previous one, as an unmeasured vehicle may.
  void begin_continued(double dt_s);
  /// Begins an interval without motion.
  void begin_still(double dt_s);

  void update(const Factor& factor);
  /// Corrects only what is learned, not the motion.
  void learn(const Factor& factor);
  Innovation innovation(const Factor& factor) const;
  /// Ends the interval: moves the pose.
  void compose();

  /// Restarts learned quantities [first, first + count) from their prior, with the given values.
  void restart(int first, int count, const Eigen::Ref<const Eigen::VectorXd>& value,
               const Eigen::Ref<const Eigen::VectorXd>& sigma);

  const Eigen::Isometry3d& odom_from_base() const noexcept { return odom_from_base_; }
  vision::Matrix6d covariance() const { return covariance_.topLeftCorner<6, 6>(); }
  /// Motion in the current interval: the base at its end in the base at its begin.
  const Eigen::Isometry3d& step() const noexcept { return step_; }
  vision::Matrix6d step_covariance() const { return covariance_.block<6, 6>(kStep, kStep); }
  /// The same before any measurement. Scales are learned by it: the noise of a measured motion, correlated with the
  /// residual, would bias them.
  const Eigen::Isometry3d& predicted_step() const noexcept { return predicted_; }
  double interval_s() const noexcept { return dt_s_; }
  const LearnedVector& learned() const noexcept { return learned_; }
  double sigma(int learned) const;

 private:
  static constexpr int kStep = 6, kLearnedAt = 12, kSize = kLearnedAt + kLearned;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using ByAll = Eigen::Matrix<double, Eigen::Dynamic, kSize, 0, Factor::kMaxRows, kSize>;

  void update(const Factor& factor, bool corrects_motion);
  static ByAll jacobian(const Factor& factor);
  void walk(double dt_s);
  void forget_step();

  FusionParameters parameters_;
  Eigen::Isometry3d odom_from_base_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d step_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d predicted_ = Eigen::Isometry3d::Identity();
  LearnedVector learned_ = LearnedVector::Zero();
  Matrix covariance_ = Matrix::Zero();
  double dt_s_ = 0.0;
  bool is_still_ = false;
};

/// Prior standard deviations of the learned quantities.
LearnedVector prior_sigma(const FusionParameters& parameters);

}  // namespace panvo::odometry_fusion
