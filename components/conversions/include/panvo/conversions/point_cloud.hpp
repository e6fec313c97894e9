// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

#include "panvo/conversions/time.hpp"
#include "sensor_msgs/msg/PointCloud2.h"

namespace panvo::conversions {

/// A field of packed points; `datatype` of sensor_msgs::msg::PointField_Constants.
struct PointCloudField {
  const char* name;
  std::size_t offset;
  std::uint8_t datatype;
};

/// A cloud of one row. `Point` must have no padding, whose bytes would differ between replays.
template <class Point>
sensor_msgs::msg::PointCloud2 to_point_cloud(std::int64_t stamp_ns, const std::string& frame,
                                             std::initializer_list<PointCloudField> fields,
                                             const std::vector<Point>& points, bool is_dense) {
  static_assert(std::is_trivially_copyable_v<Point>);
  sensor_msgs::msg::PointCloud2 cloud;
  cloud.header().stamp(to_stamp(stamp_ns));
  cloud.header().frame_id(frame);
  for (const PointCloudField& field : fields) {
    auto& added = cloud.fields().emplace_back();
    added.name(field.name);
    added.offset(static_cast<std::uint32_t>(field.offset));
    added.datatype(field.datatype);
    added.count(1);
  }
  cloud.height(1);
  cloud.width(static_cast<std::uint32_t>(points.size()));
  cloud.point_step(sizeof(Point));
  cloud.row_step(cloud.point_step() * cloud.width());
  cloud.is_dense(is_dense);
  cloud.data().resize(cloud.row_step());
  if (!points.empty()) std::memcpy(cloud.data().data(), points.data(), cloud.data().size());
  return cloud;
}

}  // namespace panvo::conversions
