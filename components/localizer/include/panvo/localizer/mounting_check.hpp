// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "panvo/localizer/journey_graph.hpp"
#include "panvo/localizer/odometry_chain.hpp"

namespace panvo::localizer {

/// Whether both cameras sit on the vehicle as is said of them. Along a pass by a landmark, the panoramas and the odometry measure the
/// same way; where they disagree on its direction, one of the cameras looks elsewhere than its extrinsics say.
class MountingCheck {
 public:
  /// By how much the panoramic camera is turned against the stereo camera, beyond what is said of them.
  struct Misalignment {
    double yaw_rad = 0.0;    ///< left positive
    double pitch_rad = 0.0;  ///< down positive
  };

  /// A sighting and the odometry of its time.
  void add(const LandmarkSighting& sighting, const Remembered& at);

  /// Nullopt before `kEnough_m` of way have been compared, and where nothing notable was found.
  std::optional<Misalignment> misalignment() const;

  static constexpr double kEnough_m = 20.0;      // sightings err by a decimetre: half a degree of this
  static constexpr double kNotable_rad = 0.044;  // 2.5 degrees: five times as much

 private:
  struct Last {
    LandmarkSighting sighting;
    Remembered at;
  };

  std::optional<Last> last_;
  double way_m_ = 0.0;
  Eigen::Vector3d cross_ =
      Eigen::Vector3d::Zero();  // of odometry's and the panoramas' steps, in the axes of the vehicle, m^2
  double dot_ = 0.0;
};

}  // namespace panvo::localizer
