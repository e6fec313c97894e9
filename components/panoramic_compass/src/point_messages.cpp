// SPDX-License-Identifier: Apache-2.0
#include "point_messages.hpp"

#include <Eigen/Geometry>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"

namespace panvo::panoramic_compass {

panvo_msgs::msg::PanoramaPoints to_message(std::int64_t stamp_ns, const TrackedPoints* points,
                                           const std::string& frame) {
  panvo_msgs::msg::PanoramaPoints message;
  message.header().stamp(conversions::to_stamp(stamp_ns));
  message.header().frame_id(frame);
  message.now_from_then().w(1.0);
  if (!points) return message;
  message.now_from_then(conversions::to_pose(Eigen::Isometry3d(points->now_from_then)).orientation());
  for (const PointTracks& tracks : points->tracks) {
    panvo_msgs::msg::PointTracks& said = message.tracks().emplace_back();
    said.from_stamp(conversions::to_stamp(tracks.from_stamp_ns));
    said.points().reserve(tracks.pairs.size());
    for (const BearingPair& pair : tracks.pairs) {
      panvo_msgs::msg::TrackedPoint& point = said.points().emplace_back();
      point.id(static_cast<std::uint32_t>(pair.id));
      point.then(conversions::to_vector3(pair.then));
      point.now(conversions::to_vector3(pair.now));
      point.azimuth_variance_rad2(pair.variance_rad2.x());
      point.elevation_variance_rad2(pair.variance_rad2.y());
    }
  }
  return message;
}

}  // namespace panvo::panoramic_compass
