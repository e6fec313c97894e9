// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "panvo/localizer/local_pose_graph.hpp"

/// Errors common to all poses around one, which the graph cannot contain.
namespace panvo::localizer {
namespace {

/// Covariance, in the axes of a way, that it has by the scale and direction of the odometry.
vision::Matrix6d way_covariance_of(const Eigen::Vector3d& way, double scale_sigma, double direction_sigma_rad) {
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(way);
  // A direction error also shortens the distance along the path: by 1 - cos.
  const double length_sigma = std::hypot(scale_sigma, 0.5 * direction_sigma_rad * direction_sigma_rad);
  covariance.topLeftCorner<3, 3>() = length_sigma * length_sigma * way * way.transpose() +
                                     direction_sigma_rad * direction_sigma_rad * across * across.transpose();
  return covariance;
}

}  // namespace

/// The nodes of this journey in the order of their stamps, to find those around many poses.
class LocalPoseGraph::Path {
 public:
  explicit Path(const LocalPoseGraph& graph)
      : graph_(graph), is_of_one_landmark_(graph.is_of_one_landmark()), is_tied_(graph.is_tied_over_cuts()) {
    for (const auto i : graph.journey_order()) {
      const auto& node = graph.nodes_[i];
      all_.push_back(&node);
      if (graph.is_known_pass(node)) known_passes_.push_back(&node);
      if (graph.shows_direction(node)) shown_.push_back(&node);
      if (node.said) said_.push_back(&node);
    }
  }

  From around(const OdometrySample& at) const {
    const auto after = behind(all_, at.pose.stamp_ns);
    From from{after == all_.begin() ? all_.front() : *std::prev(after), next_on_way(known_passes_, at),
              next_on_way(shown_, at), next_on_way(said_, at), is_of_one_landmark_};
    if (!graph_.counts_from_said(at, from) || is_tied_) from.said = nullptr;
    return from;
  }

 private:
  using Nodes = std::vector<const Node*>;

  static Nodes::const_iterator behind(const Nodes& nodes, std::int64_t stamp_ns) {
    return std::upper_bound(nodes.begin(), nodes.end(), stamp_ns,
                            [](std::int64_t one_ns, const Node* node) { return one_ns < node->at.pose.stamp_ns; });
  }

  /// As that of the graph: of equal stamps, the one that came first.
  const Node* next_on_way(const Nodes& nodes, const OdometrySample& at) const {
    const auto after = behind(nodes, at.pose.stamp_ns);
    if (after == nodes.begin()) return after == nodes.end() ? nullptr : *after;
    const auto before =
        std::lower_bound(nodes.begin(), after, (*std::prev(after))->at.pose.stamp_ns,
                         [](const Node* node, std::int64_t one_ns) { return node->at.pose.stamp_ns < one_ns; });
    return graph_.nearer(at, *before, after == nodes.end() ? nullptr : *after);
  }

  const LocalPoseGraph& graph_;
  const bool is_of_one_landmark_, is_tied_;
  Nodes all_, known_passes_, shown_, said_;
};

LocalPoseGraph::From LocalPoseGraph::around(const OdometrySample& at) const {
  From from{&anchor(at.pose.stamp_ns), next_on_way(at, [&](const Node& node) { return is_known_pass(node); }),
            next_on_way(at, [&](const Node& node) { return shows_direction(node); }),
            next_on_way(at, [](const Node& node) { return node.said.has_value(); }), is_of_one_landmark()};
  if (!counts_from_said(at, from) || is_tied_over_cuts()) from.said = nullptr;
  return from;
}

/// Whether nothing of an earlier map was seen, nor satellites received in it, on this part of the way, between the cuts, on
/// which a pose was said.
bool LocalPoseGraph::counts_from_said(const OdometrySample& at, const From& from) const {
  const auto is_here = [&](const Node* node) {
    return node != nullptr && !is_cut(node->at.pose.stamp_ns, at.pose.stamp_ns);
  };
  return is_here(from.said) && !is_here(from.known_pass) && !is_here(from.shown);
}

/// Whether a landmark of this journey was seen on both sides of a cut: then an external pose of one side is not all that
/// shows where the vehicle is.
bool LocalPoseGraph::is_tied_over_cuts() const {
  if (cuts_ns_.empty()) return false;
  std::map<std::uint32_t, std::int64_t> built_ns;
  for (const auto& node : nodes_) {
    if (!node.is_pass && !node.is_of_earlier_day) built_ns.emplace(node.landmark_id, node.at.pose.stamp_ns);
  }
  return std::any_of(nodes_.begin(), nodes_.end(), [&](const Node& node) {
    const auto built = node.is_pass ? built_ns.find(node.landmark_id) : built_ns.end();
    return built != built_ns.end() && is_cut(built->second, node.at.pose.stamp_ns);
  });
}

/// Whether the place in the map of the earlier journeys comes from one of their landmarks only, whose error the graph
/// contains. Of several, the graph takes the errors for independent.
bool LocalPoseGraph::is_of_one_landmark() const {
  if (enu_ && enu_->known) return false;
  std::size_t seen = 0;
  for (const auto& node : nodes_) {
    if (node.said) return false;
    if (node.is_of_earlier_day) ++seen;
  }
  return seen == 1;
}

vision::Matrix6d LocalPoseGraph::common_covariance(const OdometrySample& at) const {
  return common_covariance(at, around(at));
}

Eigen::Vector3d LocalPoseGraph::velocity_where_known(const OdometrySample& at) const { return velocity_at(around(at)); }

std::map<std::uint32_t, LocalPoseGraph::CommonErrors> LocalPoseGraph::common_errors() const {
  std::map<std::uint32_t, CommonErrors> all;
  const Path path(*this);
  for (const auto& node : nodes_) {
    const bool is_built = node.landmark_id != 0 && !node.is_pass && !node.is_of_earlier_day;
    if (!is_built || is_known(node.landmark_id) || all.contains(node.landmark_id)) continue;
    const From from = path.around(node.at);
    all.emplace(node.landmark_id, CommonErrors{common_covariance(node.at, from), velocity_at(from)});
  }
  return all;
}

vision::Matrix6d LocalPoseGraph::common_covariance(const OdometrySample& at, const From& from) const {
  const Eigen::Vector3d position = reckoned(at, *from.anchor).map_from_base.translation();
  if (from.known_pass != nullptr && from.said == nullptr) {
    if (from.is_of_one_landmark) return since_shown(at, from.shown);
    const KnownLandmark& known = known_.at(from.known_pass->landmark_id);
    // Landmarks side by side are turned alike: however many were seen, what comes is turned about them.
    vision::Matrix6d turned = vision::Matrix6d::Identity();
    turned.topRightCorner<3, 3>() = -vision::skew(position - known.map_from_base.translation());
    return turned * known.covariance * turned.transpose() + since_shown(at, from.shown);
  }
  const Node& begin = from.said != nullptr ? *from.said : nodes_.front();
  return since(begin, position);
}

vision::Matrix6d LocalPoseGraph::since(const Node& begin, const Eigen::Vector3d& position) const {
  const double scale_sigma = enu_ ? 0.0 : scale_sigma_;  // with satellites it is part of the graph
  return way_covariance_of(position - begin.map_from_base.translation(), scale_sigma, direction_sigma_rad_);
}

Eigen::Vector3d LocalPoseGraph::velocity_at(const From& from) {
  if (from.known_pass == nullptr || from.said != nullptr) return Eigen::Vector3d::Zero();
  return from.known_pass->map_from_base.linear() * from.known_pass->sighting.velocity_m_s;
}

vision::Matrix6d LocalPoseGraph::since_known(const OdometrySample& at) const {
  const From from = around(at);
  if (from.said != nullptr) return since(*from.said, reckoned(at, *from.anchor).map_from_base.translation());
  return since_shown(at, from.shown);
}

/// Satellites whose frame has a known pose in the map show the direction, too.
bool LocalPoseGraph::shows_direction(const Node& node) const {
  return is_known_pass(node) || (enu_ && enu_->known && node.fix);
}

vision::Matrix6d LocalPoseGraph::since_shown(const OdometrySample& at, const Node* from) const {
  if (from == nullptr) return vision::Matrix6d::Zero();
  const Eigen::Vector3d way = from->map_from_base.linear() * way_between(from->at.pose, at.pose).translation();
  return way_covariance_of(way, enu_ ? 0.0 : scale_sigma_, direction_sigma_rad_);
}

/// Of the nodes that meet a condition, the last one before or the first one after a pose: see nearer().
template <class Condition>
const LocalPoseGraph::Node* LocalPoseGraph::next_on_way(const OdometrySample& at, Condition&& condition) const {
  const Node* before = nullptr;
  const Node* after = nullptr;
  for (const auto& node : nodes_) {
    if (node.is_of_earlier_day || !condition(node)) continue;
    const std::int64_t stamp_ns = node.at.pose.stamp_ns;
    if (stamp_ns <= at.pose.stamp_ns) {
      if (before == nullptr || stamp_ns > before->at.pose.stamp_ns) before = &node;
    } else if (after == nullptr || stamp_ns < after->at.pose.stamp_ns) {
      after = &node;
    }
  }
  return before != nullptr ? nearer(at, before, after) : after;
}

/// By the path between, but of the same side of a cut if only one is. `after` may be null.
const LocalPoseGraph::Node* LocalPoseGraph::nearer(const OdometrySample& at, const Node* before,
                                                   const Node* after) const {
  if (after == nullptr) return before;
  const bool is_before_cut = is_cut(before->at.pose.stamp_ns, at.pose.stamp_ns);
  if (is_before_cut != is_cut(at.pose.stamp_ns, after->at.pose.stamp_ns)) return is_before_cut ? after : before;
  return at.way_m - before->at.way_m <= after->at.way_m - at.way_m ? before : after;
}

}  // namespace panvo::localizer
