// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/transform_buffer.hpp"

#include <iterator>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"

namespace panvo::conversions {
namespace {

// Any process can publish transforms: without bounds, those of ever new frames or stamps would fill the memory.
constexpr std::size_t kMostFrames = 10'000;
constexpr std::size_t kMostStamps = 20'000;  // of a frame: the history of one that is sent 2,000 times per second
constexpr std::size_t kLongestChain = 100;

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

std::vector<std::string> TransformBuffer::add_static(const tf2_msgs::msg::TFMessage& message) {
  return add(message, true);
}

std::vector<std::string> TransformBuffer::add_moving(const tf2_msgs::msg::TFMessage& message) {
  return add(message, false);
}

std::vector<std::string> TransformBuffer::add(const tf2_msgs::msg::TFMessage& message, bool is_static) {
  std::vector<std::string> problems;
  for (const auto& transform : message.transforms()) {
    const auto parent = plain(transform.header().frame_id());
    const auto child = plain(transform.child_frame_id());
    const auto subject = (is_static ? "the static transform '" : "the transform '") + parent + "' -> '" + child + "' ";
    const auto parent_from_child = to_isometry(transform.transform());
    if (parent.empty() || child.empty() || parent == child) {
      problems.push_back(subject + "does not name two different frames and is ignored");
      continue;
    }
    if (!parent_from_child) {
      problems.push_back(subject + parent_from_child.reason() + " and is ignored");
      continue;
    }
    if (by_child_.size() >= kMostFrames && !by_child_.contains(child)) {
      problems.push_back("transforms of more than " + std::to_string(kMostFrames) + " frames are ignored");
      continue;
    }
    Edge& edge = by_child_[child];
    if (is_static || edge.is_static || edge.parent != parent) edge = {parent, is_static};
    const std::int64_t stamp_ns = is_static ? 0 : conversions::stamp_ns(transform);
    // Otherwise the old transforms, with later stamps, would hide the new ones.
    if (!is_static && edge.stamps.add(stamp_ns) == vision::StampOrder::kSetBack) edge.parent_from_child.clear();
    edge.parent_from_child[stamp_ns] = *parent_from_child;
    while (edge.parent_from_child.begin()->first < edge.parent_from_child.rbegin()->first - kHistory_ns ||
           edge.parent_from_child.size() > kMostStamps) {
      edge.parent_from_child.erase(edge.parent_from_child.begin());
    }
  }
  return problems;
}

std::optional<Eigen::Isometry3d> TransformBuffer::lookup(const std::string& target, const std::string& source) const {
  return find(target, source, std::nullopt);
}

std::optional<Eigen::Isometry3d> TransformBuffer::lookup(const std::string& target, const std::string& source,
                                                         std::int64_t stamp_ns) const {
  return find(target, source, stamp_ns);
}

std::optional<Eigen::Isometry3d> TransformBuffer::find(const std::string& target, const std::string& source,
                                                       std::optional<std::int64_t> stamp_ns) const {
  const auto above_source = ancestors(plain(source), stamp_ns);
  for (const auto& [frame, frame_from_target] : ancestors(plain(target), stamp_ns)) {
    for (const auto& [other, frame_from_source] : above_source) {
      if (other == frame) return frame_from_target.inverse() * frame_from_source;
    }
  }
  return std::nullopt;
}

std::vector<TransformBuffer::Link> TransformBuffer::ancestors(const std::string& frame,
                                                              std::optional<std::int64_t> stamp_ns) const {
  std::vector<Link> links{{frame}};
  while (links.size() <= kLongestChain) {  // this also terminates loops
    const auto edge = by_child_.find(links.back().frame);
    if (edge == by_child_.end()) break;
    const auto parent_from_child = edge->second.at(stamp_ns);
    if (!parent_from_child) break;
    links.push_back({edge->second.parent, *parent_from_child * links.back().frame_from_start});
  }
  return links;
}

std::optional<Eigen::Isometry3d> TransformBuffer::Edge::at(std::optional<std::int64_t> stamp_ns) const {
  if (is_static) return parent_from_child.begin()->second;
  if (!stamp_ns) return std::nullopt;
  const auto after = parent_from_child.lower_bound(*stamp_ns);
  if (after == parent_from_child.end()) return std::nullopt;
  if (after->first == *stamp_ns) return after->second;
  if (after == parent_from_child.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double share =
      static_cast<double>(*stamp_ns - before->first) / static_cast<double>(after->first - before->first);
  return vision::interpolate(before->second, after->second, share);
}

}  // namespace panvo::conversions
