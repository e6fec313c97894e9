// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "panvo/localizer/journey_graph.hpp"
#include "panvo/localizer/odometry_chain.hpp"

namespace panvo::localizer {

/// Whether both cameras sit on the vehicle as is said of them. Along a pass by a landmark, the panoramas and the odometry measure the
/// same way. A panoramic camera that looks elsewhere than its extrinsics say sees that way turned; one that sits elsewhere swings
/// aside when the vehicle turns. Both are fitted to all passes.
class MountingCheck {
 public:
  /// Of the panoramic camera against the stereo camera, beyond what is said of them.
  struct Misalignment {
    double yaw_rad = 0.0;    ///< left positive
    double pitch_rad = 0.0;  ///< down positive
    double forward_m = 0.0;
    double left_m = 0.0;
    bool is_turned = false, is_displaced = false;  ///< notably, and surely
  };

  /// A sighting and the odometry of its time.
  void add(const LandmarkSighting& sighting, const Remembered& at);

  /// Nullopt where nothing notable was found, or not enough was compared to be sure of it.
  std::optional<Misalignment> misalignment() const;

  static constexpr double kNotable_rad = 0.044;  // 2.5 degrees: many times what a pass leaves open
  static constexpr double kNotable_m = 0.1;      // more than sightings err by

 private:
  using Matrix4d = Eigen::Matrix4d;
  using Matrix34d = Eigen::Matrix<double, 3, 4>;

  /// Of one pass: d = common error of its first sighting + J (yaw, pitch, forward, left).
  struct Pass {
    LandmarkSighting first;
    Remembered first_at, last_at;
    double weight = 0.0;  // of all its sightings; the sums below are weighted
    Matrix4d jtj = Matrix4d::Zero();
    Eigen::Vector4d jtd = Eigen::Vector4d::Zero();
    Matrix34d j = Matrix34d::Zero();
    Eigen::Vector3d d = Eigen::Vector3d::Zero();
  };
  struct NormalEquations {
    Matrix4d left = Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
  };

  bool continues_pass(const LandmarkSighting& sighting, const Remembered& at) const;
  NormalEquations with_current_pass() const;

  std::optional<Pass> pass_;
  NormalEquations ended_passes_;
};

}  // namespace panvo::localizer
