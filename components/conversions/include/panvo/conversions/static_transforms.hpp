// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tf2_msgs/msg/TFMessage.h"

namespace panvo::conversions {

/// Transform of a frame that is fixed to its parent, for /tf_static.
geometry_msgs::msg::TransformStamped to_static_transform(std::int64_t stamp_ns, const std::string& parent,
                                                         const std::string& child,
                                                         const Eigen::Isometry3d& parent_from_child);

/// The transforms received on /tf_static so far, and their chains.
class StaticTransforms {
 public:
  /// Adds the transforms of a message; a repeated one replaces the previous one. Invalid transforms are ignored and
  /// returned, one sentence each.
  std::vector<std::string> add(const tf2_msgs::msg::TFMessage& message);

  /// target_from_source along the chain of parents between the frames; nullopt if there is none.
  std::optional<Eigen::Isometry3d> lookup(const std::string& target, const std::string& source) const;

 private:
  struct Edge {
    std::string parent;
    Eigen::Isometry3d parent_from_child = Eigen::Isometry3d::Identity();
  };

  struct Link {
    std::string frame;
    Eigen::Isometry3d frame_from_start = Eigen::Isometry3d::Identity();
  };
  std::vector<Link> ancestors(const std::string& frame) const;

  std::map<std::string, Edge> by_child_;
};

}  // namespace panvo::conversions
