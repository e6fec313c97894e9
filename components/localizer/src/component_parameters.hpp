// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/localizer/integrity.hpp"
#include "panvo/localizer/localizer_parameters.hpp"

namespace panvo::localizer {

/// The algorithm's parameters and the names of the frames.
struct ComponentParameters {
  Parameters fusion;
  IntegrityParameters integrity;
  bool use_compass = true;
  bool use_corrections = true;
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  double stale_after_s = 0.5;
  double path_step_m = 1.0;
  double path_period_s = 2.0;
  std::string last_pose_file;
  double last_pose_s = 30.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = ComponentParameters;
    field.group(&P::fusion, "fusion");
    field.group(&P::integrity, "integrity");
    field(&P::use_compass, "use_compass", "", "straighten the azimuth by the panoramic compass");
    field(&P::use_corrections, "use_corrections", "",
          "correct the position where a landmark is seen; false: landmarks are only kept");
    field(&P::map_frame, "map_frame", "", "frame of the corrected pose");
    field(&P::odom_frame, "odom_frame", "", "frame in which the vehicle's pose never jumps");
    field(
        &P::stale_after_s, "stale_after_s", "s",
        "without odometry for so long the pose is stale: twelve images at 25 Hz, more than a busy computer misses, and "
        "a walking robot has gone 0.7 m",
        0.05, 0.5);
    field(&P::path_step_m, "path_step_m", "m", "between two poses of path/binocular and path/enhanced", 0.01, 1000.0);
    field(&P::path_period_s, "path_period_s", "s", "how often the paths are told", 0.1, 3600.0);
    field.path(&P::last_pose_file, "last_pose_file",
               "where the pose is kept from second to second, and from where a process that is started again goes on; "
               "empty: nowhere");
    field(&P::last_pose_s, "last_pose_s", "s", "how old it may be to go on from it", 0.0, 3600.0);
  }
};

}  // namespace panvo::localizer
