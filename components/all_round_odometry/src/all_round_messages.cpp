// SPDX-License-Identifier: Apache-2.0
#include "all_round_messages.hpp"

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"

namespace panvo::all_round_odometry {

conversions::Result<PanoramaPoints> to_points(const panvo_msgs::msg::PanoramaPoints& message) {
  PanoramaPoints points;
  points.stamp_ns = conversions::stamp_ns(message);
  geometry_msgs::msg::Pose turned;
  turned.orientation(message.now_from_then());
  const auto rotation = conversions::to_isometry(turned);
  if (!rotation) return conversions::Reason{rotation.reason()};
  points.now_from_then = rotation->linear();
  for (const auto& said : message.tracks()) {
    PointTracks& tracks = points.tracks.emplace_back();
    tracks.from_ns = conversions::to_ns(said.from_stamp());
    tracks.sightings.reserve(said.points().size());
    for (const auto& point : said.points()) {
      tracks.sightings.push_back({static_cast<int>(point.id()),
                                  conversions::to_eigen(point.then()),
                                  conversions::to_eigen(point.now()),
                                  {point.azimuth_variance_rad2(), point.elevation_variance_rad2()}});
    }
  }
  return points;
}

nav_msgs::msg::Odometry to_odometry(const AllRoundPose& pose, const nav_msgs::msg::Odometry& like,
                                    const vision::Vector6d& twist) {
  nav_msgs::msg::Odometry odometry = like;
  odometry.header().stamp(conversions::to_stamp(pose.stamp_ns));
  odometry.pose().pose(conversions::to_pose(pose.odom_from_base));
  odometry.pose().covariance(conversions::to_array(pose.covariance));
  if (!pose.agreeing_share) return odometry;
  odometry.twist().twist().linear(conversions::to_vector3(twist.head<3>()));
  odometry.twist().twist().angular(conversions::to_vector3(twist.tail<3>()));
  return odometry;
}

panvo_msgs::msg::OdometryQuality to_quality(const AllRoundPose& pose,
                                            const conversions::OdometryJoin::Quality& of_stereo,
                                            const std::string& base_frame) {
  panvo_msgs::msg::OdometryQuality quality;
  quality.header().stamp(conversions::to_stamp(pose.stamp_ns));
  quality.header().frame_id(base_frame);
  quality.reliable(pose.is_reliable);
  quality.inlier_ratio(pose.agreeing_share.value_or(1.0 - of_stereo.outlier_share));
  quality.lean_sigma_rad_per_m(of_stereo.lean_sigma_rad_per_m);
  if (!pose.is_reliable) quality.reason("neither the stereo camera nor panoramas measure the motion");
  return quality;
}

}  // namespace panvo::all_round_odometry
