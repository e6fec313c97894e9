// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/localizer/integrity.hpp"
#include "panvo/localizer/localizer_parameters.hpp"

namespace panvo::localizer {

/// The algorithm's parameters, the frames, and the settings of the component.
struct ComponentParameters {
  Parameters fusion;
  IntegrityParameters integrity;
  bool use_compass = true;
  bool use_corrections = true;
  bool use_gnss = true;
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  std::string enu_frame = "enu";
  double stale_after_s = 0.5;
  double path_step_m = 1.0;
  double path_period_s = 2.0;
  std::string last_pose_file;
  std::string georeference_file;
  std::string self_calibration_file;
  double last_pose_s = 30.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = ComponentParameters;
    field.group(&P::fusion, "fusion");
    field.group(&P::integrity, "integrity");
    field(&P::use_compass, "use_compass", "", "correct the azimuth with the panoramic compass");
    field(&P::use_corrections, "use_corrections", "",
          "correct the position with landmark sightings; false: only keep track of landmarks");
    field(&P::use_gnss, "use_gnss", "", "correct the path with positions by satellites, if there are any");
    field(&P::map_frame, "map_frame", "", "frame of the corrected pose");
    field(&P::odom_frame, "odom_frame", "", "frame of the continuous pose");
    field(&P::enu_frame, "enu_frame", "", "frame with axes east, north, up at the first position by satellites");
    field(&P::stale_after_s, "stale_after_s", "s",
          "time without odometry after which the pose is stale: twelve images at 25 Hz, more than a busy computer "
          "misses; a walking robot moves 0.7 m",
          0.05, 0.5);
    field(&P::path_step_m, "path_step_m", "m", "spacing of the poses of path/binocular and path/enhanced", 0.01,
          1000.0);
    field(&P::path_period_s, "path_period_s", "s", "period of the path messages", 0.1, 3600.0);
    field.path(&P::last_pose_file, "last_pose_file",
               "file in which the pose is saved every second, and from which a restarted process resumes; "
               "empty: none");
    field.path(&P::georeference_file, "georeference_file",
               "file in which the place of the map on earth is saved, if there are positions by satellites, and from "
               "which a later run in the stored map is located by them; empty: none");
    field.path(
        &P::self_calibration_file, "self_calibration_file",
        "file in which is saved what turns out of the sensors, and with which a later run begins: clock and yaw of "
        "the panoramic camera, errors of the odometry's turns and, by satellites, of its scale; empty: none");
    field(&P::last_pose_s, "last_pose_s", "s", "largest age of a pose to resume from", 0.0, 3600.0);
  }
};

}  // namespace panvo::localizer
