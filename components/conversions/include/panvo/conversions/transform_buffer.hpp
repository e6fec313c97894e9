// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "panvo/vision/stamp_sequence.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace panvo::conversions {

/// Transform of a frame that is fixed to its parent, for /tf_static.
geometry_msgs::msg::TransformStamped to_static_transform(std::int64_t stamp_ns, const std::string& parent,
                                                         const std::string& child,
                                                         const Eigen::Isometry3d& parent_from_child);

/// The transforms received on /tf_static and /tf, and the chains between frames, as tf2's buffer keeps them.
class TransformBuffer {
 public:
  static constexpr std::int64_t kHistory_ns = 10'000'000'000;  ///< of each moving frame

  /// Adds the transforms of a message on /tf_static; one of a known frame replaces the previous one. Invalid transforms
  /// are ignored and returned, one sentence each.
  std::vector<std::string> add_static(const tf2_msgs::msg::TFMessage& message);
  /// Adds the transforms of a message on /tf, in any order of their stamps; after the clock was set back, those before are
  /// forgotten. Returns like add_static().
  std::vector<std::string> add_moving(const tf2_msgs::msg::TFMessage& message);

  /// target_from_source along a chain of static transforms; nullopt if there is none.
  std::optional<Eigen::Isometry3d> lookup(const std::string& target, const std::string& source) const;
  /// target_from_source at a stamp, along static and moving transforms; the latter are interpolated at constant twist
  /// between the neighbouring stamps. nullopt if no chain connects the frames, or a moving one has no transforms around
  /// the stamp.
  std::optional<Eigen::Isometry3d> lookup(const std::string& target, const std::string& source,
                                          std::int64_t stamp_ns) const;

 private:
  /// A frame's transform to its parent.
  struct Edge {
    std::string parent;
    bool is_static = true;
    std::map<std::int64_t, Eigen::Isometry3d> parent_from_child{};  // by stamp; a static one: of any stamp
    vision::StampSequence stamps{};                                 // of a moving one

    std::optional<Eigen::Isometry3d> at(std::optional<std::int64_t> stamp_ns) const;
  };

  struct Link {
    std::string frame;
    Eigen::Isometry3d frame_from_start = Eigen::Isometry3d::Identity();
  };

  std::vector<std::string> add(const tf2_msgs::msg::TFMessage& message, bool is_static);
  std::optional<Eigen::Isometry3d> find(const std::string& target, const std::string& source,
                                        std::optional<std::int64_t> stamp_ns) const;
  std::vector<Link> ancestors(const std::string& frame, std::optional<std::int64_t> stamp_ns) const;

  std::map<std::string, Edge> by_child_;
};

}  // namespace panvo::conversions
