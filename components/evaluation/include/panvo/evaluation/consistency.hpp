// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>

#include "panvo/evaluation/association.hpp"

namespace panvo::evaluation {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// As in nav_msgs/Odometry: order x y z rotx roty rotz, rotations about fixed axes.
struct MotionCovariance {
  Matrix6d pose;   // of odom_from_base, in the axes of odom, accumulated since the start
  Matrix6d twist;  // of the motion since the previous message divided by its duration, in the axes of base_link
};

using MotionCovariances = std::map<std::int64_t, MotionCovariance>;  // by stamp, ns

// odometry_binocular_covariance.csv: header, then `stamp_ns`, 36 numbers of the pose's covariance (row-major), 36 of
// the twist's, 6 of the twist. Throws InputError.
MotionCovariances read_motion_covariances(const std::filesystem::path& file);

// Normalised estimation error squared, e' C^-1 e. Its mean is `dimension` if the covariances are correct, larger if
// they are too small, smaller if they are too large.
struct Nees {
  int dimension = 0;
  std::size_t samples = 0;
  double mean = 0.0;
  double lower_95 = 0.0;  // 95 % interval of the mean of `samples` independent samples
  double upper_95 = 0.0;
  double inside_95 = 0.0;  // fraction of samples below the 95 % bound of a single sample
};

struct ConsistencyOptions {
  std::size_t steps = 1;
  // Standard deviations of a ground-truth pose along and about each axis, independent between poses: the noise of the
  // GNSS receiver or tracking system. They are added to the covariance of the error.
  double truth_noise_m = 0.0;
  double truth_noise_rad = 0.0;
};

struct Consistency {
  Nees motion;              // of the relative pose over `steps` steps, 6 dimensions
  Nees motion_translation;  // 3 dimensions each
  Nees motion_rotation;
  std::optional<Nees> pose;  // of the accumulated pose; samples are correlated, so the interval is that of one sample
  ConsistencyOptions options;
  std::size_t unusable = 0;  // skipped steps: no line for a stamp, or a covariance that is not positive definite
};

// Evaluates the relative motion D over `steps` poses. Error: D_true^-1 D_estimated, as translation and rotation vector
// in the axes of base_link at the end. Covariance: twist covariance times dt^2, propagated over the steps by the
// adjoint, assuming independent steps, plus the noise of the ground truth at both ends. Intervals do not overlap.
// nullopt if none is usable; throws InputError for 0 steps.
std::optional<Consistency> consistency(std::span<const PosePair> pairs, const MotionCovariances& covariances,
                                       const ConsistencyOptions& options = {});

// NEES of published poses. Neighbouring samples are correlated, so the intervals are those of one sample.
struct PoseConsistency {
  Nees full;                 // position and orientation, 6 dimensions
  Nees plane;                // x, y and the rotation about z, 3 dimensions
  std::size_t unusable = 0;  // poses without a line, or with a covariance that is not positive definite
};

// Compares the estimate with the ground truth, transformed by `truth_from_estimate`; pose covariance as in
// nav_msgs/Odometry. nullopt if no pose is usable.
std::optional<PoseConsistency> pose_consistency(std::span<const PosePair> pairs, const MotionCovariances& covariances,
                                                const Eigen::Isometry3d& truth_from_estimate);

}  // namespace panvo::evaluation
