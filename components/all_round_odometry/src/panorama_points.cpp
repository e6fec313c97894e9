// SPDX-License-Identifier: Apache-2.0
#include "panvo/all_round_odometry/panorama_points.hpp"

#include "panvo/vision/angle.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::all_round_odometry {

PanoramaPoints turned(PanoramaPoints panorama, const Eigen::Matrix3d& by) {
  panorama.now_from_then = by * panorama.now_from_then * by.transpose();
  for (PointTracks& tracks : panorama.tracks) {
    for (Sighting& sighting : tracks.sightings) {
      sighting.then = by * sighting.then;
      sighting.now = by * sighting.now;
    }
  }
  return panorama;
}

double turn_in(const PanoramaPoints& panorama) {
  const Eigen::Matrix3d then_from_now = panorama.now_from_then.transpose();
  return vision::so3_log(then_from_now).z();
}

double turn_beyond(double turn_rad, const PanoramaPoints& panorama) {
  return vision::wrapped(turn_in(panorama) - turn_rad);
}

void set_back(PanoramaPoints& panorama, std::int64_t by_ns) {
  panorama.stamp_ns -= by_ns;
  for (PointTracks& tracks : panorama.tracks) tracks.from_ns -= by_ns;
}

}  // namespace panvo::all_round_odometry
