// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/static_transforms.hpp"

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"

namespace panvo::conversions {
namespace {

/// Removes the leading slash of older publishers, which tf2 does not use.
std::string plain(const std::string& frame) { return frame.starts_with('/') ? frame.substr(1) : frame; }

}  // namespace

geometry_msgs::msg::TransformStamped to_static_transform(std::int64_t stamp_ns, const std::string& parent,
                                                         const std::string& child,
                                                         const Eigen::Isometry3d& parent_from_child) {
  geometry_msgs::msg::TransformStamped transform;
  transform.header().stamp(to_stamp(stamp_ns));
  transform.header().frame_id(parent);
  transform.child_frame_id(child);
  transform.transform(to_transform(parent_from_child));
  return transform;
}

std::vector<std::string> StaticTransforms::add(const tf2_msgs::msg::TFMessage& message) {
  std::vector<std::string> problems;
  for (const auto& transform : message.transforms()) {
    const auto parent = plain(transform.header().frame_id());
    const auto child = plain(transform.child_frame_id());
    const auto subject = "the static transform '" + parent + "' -> '" + child + "' ";
    const auto parent_from_child = to_isometry(transform.transform());
    if (parent.empty() || child.empty() || parent == child) {
      problems.push_back(subject + "does not name two different frames and is ignored");
    } else if (!parent_from_child) {
      problems.push_back(subject + parent_from_child.reason() + " and is ignored");
    } else {
      by_child_[child] = {parent, *parent_from_child};
    }
  }
  return problems;
}

std::optional<Eigen::Isometry3d> StaticTransforms::lookup(const std::string& target, const std::string& source) const {
  const auto above_source = ancestors(plain(source));
  for (const auto& [frame, frame_from_target] : ancestors(plain(target))) {
    for (const auto& [other, frame_from_source] : above_source) {
      if (other == frame) return frame_from_target.inverse() * frame_from_source;
    }
  }
  return std::nullopt;
}

std::vector<StaticTransforms::Link> StaticTransforms::ancestors(const std::string& frame) const {
  std::vector<Link> links{{frame}};
  // A chain has at most all edges; this also terminates loops.
  while (links.size() <= by_child_.size()) {
    const auto edge = by_child_.find(links.back().frame);
    if (edge == by_child_.end()) break;
    links.push_back({edge->second.parent, edge->second.parent_from_child * links.back().frame_from_start});
  }
  return links;
}

}  // namespace panvo::conversions
