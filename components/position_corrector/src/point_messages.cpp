// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/point_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "panvo/conversions/time.hpp"

namespace panvo::position_corrector {
namespace {

/// Layout of the points in a PointCloud2. Without padding, whose bytes would differ between replays.
struct PackedMatch {
  float x, y, z, u, v, place_u, place_v;
  std::uint32_t landmark;
  std::uint8_t state;
  std::array<std::uint8_t, 3> unused;
};
static_assert(sizeof(PackedMatch) == 36);

constexpr std::uint8_t kAgrees = 1, kContradicts = 2;

std::vector<sensor_msgs::msg::PointField> match_fields() {
  namespace types = sensor_msgs::msg::PointField_Constants;
  std::vector<sensor_msgs::msg::PointField> fields;
  const auto add = [&](const char* name, std::size_t offset, std::uint8_t datatype) {
    auto& field = fields.emplace_back();
    field.name(name);
    field.offset(static_cast<std::uint32_t>(offset));
    field.datatype(datatype);
    field.count(1);
  };
  add("x", offsetof(PackedMatch, x), types::FLOAT32);
  add("y", offsetof(PackedMatch, y), types::FLOAT32);
  add("z", offsetof(PackedMatch, z), types::FLOAT32);
  add("u", offsetof(PackedMatch, u), types::FLOAT32);
  add("v", offsetof(PackedMatch, v), types::FLOAT32);
  add("place_u", offsetof(PackedMatch, place_u), types::FLOAT32);
  add("place_v", offsetof(PackedMatch, place_v), types::FLOAT32);
  add("landmark", offsetof(PackedMatch, landmark), types::UINT32);
  add("state", offsetof(PackedMatch, state), types::UINT8);
  return fields;
}

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

PackedMatch pack(const PointMatch& match, const std::optional<PanoramaPose>& pose, std::uint32_t landmark) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d known = pose ? Eigen::Vector3d(pose->landmark_from_panorama.inverse() * match.point)
                                     : Eigen::Vector3d::Constant(kUnknown);
  const Eigen::Vector3f at = known.cast<float>();
  return {at.x(),
          at.y(),
          at.z(),
          column_of(match.bearing),
          row_of(match.bearing),
          column_of(match.point),
          row_of(match.point),
          landmark,
          match.agrees ? kAgrees : kContradicts,
          {}};
}

}  // namespace

sensor_msgs::msg::PointCloud2 to_point_cloud(const LandmarkMatch& match, const std::string& panorama_frame) {
  const auto& pose = match.pose ? match.pose : match.weak_pose;
  sensor_msgs::msg::PointCloud2 cloud;
  cloud.header().stamp(conversions::to_stamp(match.stamp_ns));
  cloud.header().frame_id(panorama_frame);
  cloud.fields(match_fields());
  cloud.height(1);
  cloud.width(static_cast<std::uint32_t>(match.points.size()));
  cloud.point_step(sizeof(PackedMatch));
  cloud.row_step(cloud.point_step() * cloud.width());
  cloud.data().resize(cloud.row_step());
  cloud.is_dense(pose.has_value());
  std::uint8_t* place = cloud.data().data();
  for (const auto& point : match.points) {
    const PackedMatch packed = pack(point, pose, match.landmark_id);
    std::memcpy(place, &packed, sizeof packed);
    place += sizeof packed;
  }
  return cloud;
}

}  // namespace panvo::position_corrector
