// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "panvo/localizer/local_pose_graph.hpp"
#include "panvo/localizer/odometry_buffer.hpp"

namespace panvo::localizer {

/// Checks the extrinsics of both cameras. Panoramas and odometry measure the same path along a pass by a landmark. A
/// wrong rotation of the panoramic camera rotates that path; a wrong position moves it sideways when the vehicle turns.
/// Both are fitted to all passes.
class ExtrinsicsMonitor {
 public:
  /// Of the panoramic relative to the stereo camera, in addition to the extrinsics.
  struct Misalignment {
    double yaw_rad = 0.0;    ///< left positive
    double pitch_rad = 0.0;  ///< down positive
    double forward_m = 0.0;
    double left_m = 0.0;
    bool is_turned = false, is_displaced = false;  ///< large and significant
  };

  /// A sighting and the odometry at its stamp.
  void add(const LandmarkSighting& sighting, const OdometrySample& at);

  /// nullopt if there is no notable misalignment or not enough data to be certain.
  std::optional<Misalignment> misalignment() const;

  static constexpr double kNotable_rad = 0.044;  // 2.5 degrees: many times the uncertainty after a pass
  static constexpr double kNotable_m = 0.1;      // more than the error of sightings

 private:
  using Matrix4d = Eigen::Matrix4d;
  using Matrix34d = Eigen::Matrix<double, 3, 4>;

  /// Sums of one pass, for the model d = common error of its first sighting + J (yaw, pitch, forward, left).
  struct Pass {
    LandmarkSighting first;
    OdometrySample first_at, last_at;
    double weight = 0.0;  // sum over its sightings; the sums below are weighted
    Matrix4d jtj = Matrix4d::Zero();
    Eigen::Vector4d jtd = Eigen::Vector4d::Zero();
    Matrix34d j = Matrix34d::Zero();
    Eigen::Vector3d d = Eigen::Vector3d::Zero();
  };
  struct NormalEquations {
    Matrix4d left = Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
  };

  bool continues_pass(const LandmarkSighting& sighting, const OdometrySample& at) const;
  NormalEquations with_current_pass() const;

  std::optional<Pass> pass_;
  NormalEquations ended_passes_;
};

}  // namespace panvo::localizer
