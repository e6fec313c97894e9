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
  Matrix6d twist;  // of the motion since the message before divided by the time it took, in the axes of base_link
};

using MotionCovariances = std::map<std::int64_t, MotionCovariance>;  // by stamp, ns

// odometry_binocular_covariance.csv: header, then `stamp_ns`, 36 numbers of the pose's covariance (row-major), 36 of
// the twist's, 6 of the twist. Throws InputError.
MotionCovariances read_motion_covariances(const std::filesystem::path& file);

// Normalised estimation error squared, e' C^-1 e: its mean is `dimension` if the covariances tell the truth; more means
// overconfident, less means cautious.
struct Nees {
  int dimension = 0;
  std::size_t samples = 0;
  double mean = 0.0;
  double lower_95 = 0.0;  // where the mean of that many independent samples falls in 95 % of all cases
  double upper_95 = 0.0;
  double inside_95 = 0.0;  // share of the single samples below their own 95 % bound
};

struct ConsistencyOptions {
  std::size_t steps = 1;
  // Standard deviations of one pose of the ground truth along and about each axis, independent from pose to pose: what
  // a receiver or a tracking system trembles by. They are part of the error, so they join its covariance.
  double truth_noise_m = 0.0;
  double truth_noise_rad = 0.0;
};

struct Consistency {
  Nees motion;              // of the relative pose over `steps` steps, 6 dimensions
  Nees motion_translation;  // its parts, to see which one is off
  Nees motion_rotation;
  std::optional<Nees> pose;  // of the accumulated pose. Its samples depend on each other: bounds are those of one
  ConsistencyOptions options;
  std::size_t unusable = 0;  // stretches left out: no line for a stamp, or a covariance that is not positive definite
};

// Relative motion D from pose to pose, error D_true^-1 D_estimated: translation and rotation vector in the axes of
// base_link at the end of the stretch. Covariance: the twist's times dt^2, carried over `steps` independent steps by
// the adjoint, plus the ground truth's noise at both ends. The stretches do not overlap. nullopt if none is usable;
// throws InputError for 0 steps.
std::optional<Consistency> consistency(std::span<const PosePair> pairs, const MotionCovariances& covariances,
                                       const ConsistencyOptions& options = {});

// Whether the covariance of a pose, as it was published, says what its error is. Neighbouring samples depend on each
// other, so the bounds are those of one.
struct PoseConsistency {
  Nees full;                 // position and orientation, 6 dimensions
  Nees plane;                // x, y and the rotation about z, 3 dimensions
  std::size_t unusable = 0;  // poses with no line, or with a covariance that is not positive definite
};

// Errors of the estimate against the truth carried into its frame by `truth_from_estimate`, with the pose's covariance as
// in nav_msgs/Odometry. nullopt if no pose is usable.
std::optional<PoseConsistency> pose_consistency(std::span<const PosePair> pairs, const MotionCovariances& covariances,
                                                const Eigen::Isometry3d& truth_from_estimate);

}  // namespace panvo::evaluation
