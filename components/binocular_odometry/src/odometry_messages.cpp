// SPDX-License-Identifier: Apache-2.0
#include "odometry_messages.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "panvo/conversions/point_cloud.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {
using vision::Matrix6d;
using vision::Vector6d;

namespace {

// (m/s)^2 and (rad/s)^2; conventional for a velocity that is not measured.
constexpr double kNotMeasured = 1e6;

/// Layout of the points in a PointCloud2.
struct PackedPoint {
  float x, y, z, u, v;
  std::uint32_t track;  // the low bits of the id
  std::uint8_t state;
  std::array<std::uint8_t, 3> unused;
};
static_assert(sizeof(PackedPoint) == 28);

PackedPoint pack(const ScenePoint& point, const Eigen::Isometry3d& odom_from_start) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d known = point.in_odom ? odom_from_start * *point.in_odom : Eigen::Vector3d::Constant(kUnknown);
  const Eigen::Vector3f at = known.cast<float>();
  const Eigen::Vector2f pixel = point.pixel.cast<float>();
  return {at.x(),
          at.y(),
          at.z(),
          pixel.x(),
          pixel.y(),
          static_cast<std::uint32_t>(point.track_id),
          static_cast<std::uint8_t>(point.state),
          {}};
}

}  // namespace

nav_msgs::msg::Odometry to_odometry(const VehicleEstimate& estimate, std::optional<std::int64_t> previous_stamp_ns,
                                    const std::string& odom_frame, const std::string& base_frame) {
  const std::int64_t stamp_ns = estimate.of_left.stamp_ns;
  nav_msgs::msg::Odometry odometry;
  odometry.header().stamp(conversions::to_stamp(stamp_ns));
  odometry.header().frame_id(odom_frame);
  odometry.child_frame_id(base_frame);
  odometry.pose().pose(conversions::to_pose(estimate.odom_from_base.pose));
  odometry.pose().covariance(conversions::to_array(estimate.odom_from_base.covariance));

  const double interval_s = previous_stamp_ns ? static_cast<double>(stamp_ns - *previous_stamp_ns) * 1e-9 : 0.0;
  if (interval_s <= 0.0) {
    odometry.twist().covariance(conversions::to_array(kNotMeasured * Matrix6d::Identity()));
    return odometry;
  }
  const UncertainPose& motion = estimate.previous_from_current;
  const Vector6d twist = vision::se3_log(motion.pose) / interval_s;
  // The covariance is in the axes of the previous base_frame, the twist in those of the current one.
  Matrix6d current_from_previous = Matrix6d::Zero();
  current_from_previous.topLeftCorner<3, 3>() = motion.pose.linear().transpose();
  current_from_previous.bottomRightCorner<3, 3>() = motion.pose.linear().transpose();
  const Matrix6d covariance =
      current_from_previous * motion.covariance * current_from_previous.transpose() / (interval_s * interval_s);
  auto& message = odometry.twist().twist();
  message.linear().x(twist[0]);
  message.linear().y(twist[1]);
  message.linear().z(twist[2]);
  message.angular().x(twist[3]);
  message.angular().y(twist[4]);
  message.angular().z(twist[5]);
  odometry.twist().covariance(conversions::to_array(covariance));
  return odometry;
}

tf2_msgs::msg::TFMessage to_transform(const nav_msgs::msg::Odometry& odometry) {
  const auto& pose = odometry.pose().pose();
  geometry_msgs::msg::TransformStamped stamped;
  stamped.header(odometry.header());
  stamped.child_frame_id(odometry.child_frame_id());
  stamped.transform().translation().x(pose.position().x());
  stamped.transform().translation().y(pose.position().y());
  stamped.transform().translation().z(pose.position().z());
  stamped.transform().rotation(pose.orientation());
  tf2_msgs::msg::TFMessage message;
  message.transforms({stamped});
  return message;
}

sensor_msgs::msg::PointCloud2 to_point_cloud(const std::vector<ScenePoint>& points,
                                             const Eigen::Isometry3d& odom_from_start, std::int64_t stamp_ns,
                                             const std::string& odom_frame) {
  namespace types = sensor_msgs::msg::PointField_Constants;
  std::vector<PackedPoint> packed;
  packed.reserve(points.size());
  for (const ScenePoint& point : points) packed.push_back(pack(point, odom_from_start));
  const bool is_dense = std::ranges::all_of(points, [](const ScenePoint& point) { return point.in_odom.has_value(); });
  return conversions::to_point_cloud(stamp_ns, odom_frame,
                                     {{"x", offsetof(PackedPoint, x), types::FLOAT32},
                                      {"y", offsetof(PackedPoint, y), types::FLOAT32},
                                      {"z", offsetof(PackedPoint, z), types::FLOAT32},
                                      {"u", offsetof(PackedPoint, u), types::FLOAT32},
                                      {"v", offsetof(PackedPoint, v), types::FLOAT32},
                                      {"track", offsetof(PackedPoint, track), types::UINT32},
                                      {"state", offsetof(PackedPoint, state), types::UINT8}},
                                     packed, is_dense);
}

panvo_msgs::msg::OdometryQuality to_quality(const OdometryEstimate& estimate, const std::string& base_frame) {
  panvo_msgs::msg::OdometryQuality quality;
  quality.header().stamp(conversions::to_stamp(estimate.stamp_ns));
  quality.header().frame_id(base_frame);
  quality.detected(static_cast<std::uint32_t>(estimate.quality.detected));
  quality.tracked(static_cast<std::uint32_t>(estimate.quality.tracked));
  quality.matched(static_cast<std::uint32_t>(estimate.quality.matched));
  quality.inliers(static_cast<std::uint32_t>(estimate.quality.inliers));
  quality.inlier_ratio(estimate.quality.inlier_ratio);
  quality.residual_px(estimate.quality.residual_px);
  quality.lean_sigma_rad_per_m(estimate.quality.lean_sigma_rad_per_m);
  quality.reliable(estimate.quality.reliable);
  quality.reason(estimate.quality.reason);
  return quality;
}

}  // namespace panvo::binocular_odometry
