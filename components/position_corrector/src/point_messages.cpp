// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/point_messages.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "panvo/conversions/point_cloud.hpp"

namespace panvo::position_corrector {
namespace {

/// Layout of the points in a PointCloud2.
struct PackedMatch {
  float x, y, z, u, v, place_u, place_v;
  std::uint32_t landmark;
  std::uint8_t state;
  std::array<std::uint8_t, 3> unused;
};
static_assert(sizeof(PackedMatch) == 36);

constexpr std::uint8_t kAgrees = 1, kContradicts = 2;

/// Fraction of the height of a panorama at which a direction is seen; see vision::Equirectangular.
float row_of(const Eigen::Vector3d& direction) {
  return static_cast<float>(0.5 +
                            std::atan2(direction.y(), std::hypot(direction.x(), direction.z())) / std::numbers::pi);
}

/// The same of the width.
float column_of(const Eigen::Vector3d& direction) {
  const double turns = 0.5 + std::atan2(direction.x(), direction.z()) / (2.0 * std::numbers::pi);
  return static_cast<float>(turns - std::floor(turns));
}

PackedMatch pack(const PointMatch& match, const std::optional<PanoramaPose>& pose, std::uint32_t landmark,
                 const Eigen::Matrix3d& panorama_from_level) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d known = pose ? Eigen::Vector3d(pose->landmark_from_panorama.inverse() * match.point)
                                     : Eigen::Vector3d::Constant(kUnknown);
  const Eigen::Vector3f at = (panorama_from_level * known).cast<float>();
  const Eigen::Vector3d bearing = panorama_from_level * match.bearing;
  return {at.x(),
          at.y(),
          at.z(),
          column_of(bearing),
          row_of(bearing),
          column_of(match.point),
          row_of(match.point),
          landmark,
          match.agrees ? kAgrees : kContradicts,
          {}};
}

}  // namespace

sensor_msgs::msg::PointCloud2 to_point_cloud(const LandmarkMatch& match, const std::string& panorama_frame,
                                             const Eigen::Matrix3d& panorama_from_level) {
  const auto& pose = match.pose ? match.pose : match.weak_pose;
  namespace types = sensor_msgs::msg::PointField_Constants;
  std::vector<PackedMatch> packed;
  packed.reserve(match.points.size());
  for (const auto& point : match.points) packed.push_back(pack(point, pose, match.landmark_id, panorama_from_level));
  return conversions::to_point_cloud(match.stamp_ns, panorama_frame,
                                     {{"x", offsetof(PackedMatch, x), types::FLOAT32},
                                      {"y", offsetof(PackedMatch, y), types::FLOAT32},
                                      {"z", offsetof(PackedMatch, z), types::FLOAT32},
                                      {"u", offsetof(PackedMatch, u), types::FLOAT32},
                                      {"v", offsetof(PackedMatch, v), types::FLOAT32},
                                      {"place_u", offsetof(PackedMatch, place_u), types::FLOAT32},
                                      {"place_v", offsetof(PackedMatch, place_v), types::FLOAT32},
                                      {"landmark", offsetof(PackedMatch, landmark), types::UINT32},
                                      {"state", offsetof(PackedMatch, state), types::UINT8}},
                                     packed, pose.has_value());
}

}  // namespace panvo::position_corrector
