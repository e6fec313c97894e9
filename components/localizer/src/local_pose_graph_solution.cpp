// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "panvo/localizer/local_pose_graph.hpp"
#include "panvo/localizer/pose_graph.hpp"
#include "panvo/vision/seconds.hpp"

/// The graph as a least-squares problem, and what satellites contribute to it.
namespace panvo::localizer {
namespace {

constexpr double kMinVariance = 1e-8;  // of an edge: 0.1 mm, 0.1 mrad
// A covariance costs as much as the solution of a system of equations of the graph.
constexpr std::size_t kMaxAllCovariances = 200, kNearCovariances = 100;
constexpr std::size_t kMaxFixes = 64;  // over 3 km every 50 m: errors of satellites change over some hundred metres
// Before any fix: the frame of the satellites lies anywhere within 1000 km, in any direction. Maps are level to the
// slope on which the journey began.
constexpr double kUnknownEnu_m = 1e6;
constexpr double kUnknownEnuYaw_rad = 3.0;
constexpr double kEnuTilt_rad = 0.05;

vision::Matrix6d with_least_variance(const vision::Matrix6d& covariance) {
  return covariance + kMinVariance * vision::Matrix6d::Identity();
}

vision::Matrix6d unknown_enu() {
  vision::Vector6d sigma;
  sigma << kUnknownEnu_m, kUnknownEnu_m, kUnknownEnu_m, kEnuTilt_rad, kEnuTilt_rad, kUnknownEnuYaw_rad;
  return sigma.cwiseAbs2().asDiagonal();
}

/// Covariance, in the axes of a way, that it gains by the scale.
vision::Matrix6d by_scale(const Eigen::Vector3d& way, double sigma) {
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() = sigma * sigma * way * way.transpose();
  return covariance;
}

}  // namespace

bool LocalPoseGraph::solve() {
  PoseGraph graph;
  for (const auto& node : nodes_) graph.poses.push_back(node.map_from_base);
  const auto order = journey_order();
  for (std::size_t i = 1; i < order.size(); ++i) {
    const auto& a = nodes_[order[i - 1]].at;
    const auto& b = nodes_[order[i]].at;
    const Eigen::Isometry3d way =
        enu_ ? a.pose.odom_from_base.inverse() * b.pose.odom_from_base : way_between(a.pose, b.pose);
    graph.edges.push_back({order[i - 1], order[i], way, with_least_variance(way_covariance(a, b)), false, true});
  }
  std::map<std::uint32_t, std::size_t> landmarks;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].landmark_id != 0 && !nodes_[i].is_pass) landmarks.emplace(nodes_[i].landmark_id, i);
  }
  bool is_anchored = is_placed_;  // by something other than the start of the journey
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto& node = nodes_[i];
    if (node.is_of_earlier_day) {
      is_anchored = true;
      const auto& known = known_.at(node.landmark_id);
      graph.priors.push_back({i, known.map_from_base, with_least_variance(known.covariance)});
    }
    if (node.said) graph.priors.push_back({i, node.said->map_from_base, with_least_variance(node.said->covariance)});
    if (!node.is_pass) continue;
    graph.edges.push_back({landmarks.at(node.landmark_id), i, node.sighting.landmark_from_base,
                           with_least_variance(node.sighting.covariance), true});
  }
  if (!is_anchored) graph.priors.push_back({order.front(), start_.map_from_base, start_.covariance});
  std::optional<std::pair<std::size_t, std::size_t>> pair;
  if (enu_) {
    add_fixes(graph, order);
    pair = {nodes_.size(), order.back()};
  }
  try {
    if (!graph.optimise()) return false;
  } catch (const std::invalid_argument&) {  // a sum of valid covariances that is singular by rounding
    return false;
  }
  auto wanted = wanted_covariances(graph.poses, order.back());
  if (enu_) wanted.push_back(nodes_.size());
  const auto covariances = graph.covariances(wanted, pair);
  if (!covariances) return false;
  for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i].map_from_base = graph.poses[i];
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (wanted[k] < nodes_.size()) nodes_[wanted[k]].covariance = covariances->poses[k];
  }
  if (enu_) {
    enu_->map_from_enu = graph.poses.back();
    enu_->covariance = covariances->poses.back();
    enu_->cross = covariances->cross;
    enu_->solved_ns = nodes_[order.back()].at.pose.stamp_ns;
    scale_ = {graph.scale, std::sqrt(covariances->scale_variance)};
    delay_ = {graph.delay, std::sqrt(covariances->delay_variance)};
  }
  return true;
}

std::vector<std::size_t> LocalPoseGraph::wanted_covariances(const std::vector<Eigen::Isometry3d>& poses,
                                                            std::size_t newest) const {
  std::vector<std::size_t> wanted(nodes_.size());
  std::iota(wanted.begin(), wanted.end(), std::size_t{0});
  if (nodes_.size() <= kMaxAllCovariances) return wanted;
  const Eigen::Vector3d here = poses[newest].translation();
  const auto distance = [&](std::size_t i) { return (poses[i].translation() - here).squaredNorm(); };
  std::nth_element(wanted.begin(), wanted.begin() + kNearCovariances, wanted.end(),
                   [&](std::size_t a, std::size_t b) { return std::pair(distance(a), a) < std::pair(distance(b), b); });
  wanted.resize(kNearCovariances);
  return wanted;
}

/// Errors of satellites persist for a time: fixes within it count as one, as all do that span less. Each is weighted by
/// its share of the time.
void LocalPoseGraph::add_fixes(PoseGraph& graph, const std::vector<std::size_t>& order) const {
  const std::size_t enu = graph.poses.size();
  graph.poses.push_back(enu_->map_from_enu);
  if (enu_->known) {
    graph.priors.push_back({enu, enu_->known->map_from_base, with_least_variance(enu_->known->covariance)});
  } else {
    Eigen::Isometry3d level = enu_->map_from_enu;
    level.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, yaw_of(level.linear())));
    graph.priors.push_back({enu, level, unknown_enu()});
  }
  graph.scale = scale_.value;
  graph.expected_scale = expected_scale_;
  graph.scale_sigma = scale_sigma_;
  graph.delay = delay_.value;
  graph.delay_sigma = fix_parameters_.delay_sigma_s;
  std::vector<std::size_t> fixes;
  std::copy_if(order.begin(), order.end(), std::back_inserter(fixes),
               [&](std::size_t i) { return nodes_[i].fix.has_value(); });
  const auto stamp_ns = [&](std::size_t k) { return nodes_[fixes[k]].at.pose.stamp_ns; };
  const double span_s = fixes.empty() ? 0.0 : vision::seconds(stamp_ns(0), stamp_ns(fixes.size() - 1));
  const double one_s = std::min(fix_parameters_.correlation_s, span_s);
  for (std::size_t k = 0; k < fixes.size(); ++k) {
    const std::int64_t since_ns = stamp_ns(k == 0 ? 0 : k - 1), until_ns = stamp_ns(std::min(k + 1, fixes.size() - 1));
    const double share_s = 0.5e-9 * static_cast<double>(until_ns - since_ns);
    const double alike = share_s > 0.0 ? one_s / share_s : 1.0;  // the only one has no time
    const auto& fix = *nodes_[fixes[k]].fix;
    graph.fixes.push_back({enu, fixes[k], fix.antenna_in_base_m, fix.velocity_in_base_m_s, fix.enu_m,
                           fix.covariance * std::max(1.0, alike)});
  }
}

void LocalPoseGraph::set_enu(const Eigen::Isometry3d& map_from_enu, const std::optional<vision::Matrix6d>& covariance) {
  const bool is_said = std::any_of(nodes_.begin(), nodes_.end(), [](const Node& node) { return node.said; });
  if (enu_ && enu_->known && !covariance && !is_said) {  // nothing else showed where the journey is: that remains
    start_ = {nodes_.front().map_from_base, nodes_.front().covariance};
    is_placed_ = false;
  }
  std::erase_if(nodes_, [](const Node& node) { return node.fix.has_value(); });
  enu_ = Enu{};
  enu_->map_from_enu = map_from_enu;
  if (covariance) enu_->known = PoseInMap{map_from_enu, *covariance};
}

void LocalPoseGraph::add_fix(const GnssFix& fix, const OdometrySample& at) {
  Node node;
  node.fix = fix;
  node.at = at;
  const auto here = reckoned(at);
  node.map_from_base = here.map_from_base;
  node.covariance = here.covariance;
  nodes_.push_back(node);
  thin_out_fixes();
}

/// Removes the fix that leaves the smallest gap, but neither the first, which shows the way from the start, nor the
/// last.
void LocalPoseGraph::thin_out_fixes() {
  std::vector<std::size_t> fixes;
  for (const auto i : journey_order()) {
    if (nodes_[i].fix) fixes.push_back(i);
  }
  if (fixes.size() <= kMaxFixes) return;
  std::size_t least = 1;
  const auto gap_m = [&](std::size_t k) { return nodes_[fixes[k + 1]].at.way_m - nodes_[fixes[k - 1]].at.way_m; };
  for (std::size_t k = 2; k + 1 < fixes.size(); ++k) {
    if (gap_m(k) < gap_m(least)) least = k;
  }
  nodes_.erase(nodes_.begin() + static_cast<std::ptrdiff_t>(fixes[least]));
}

/// The last node of the latest solution; nullptr without satellites.
const LocalPoseGraph::Node* LocalPoseGraph::solved_node() const {
  if (!enu_) return nullptr;
  const auto last = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& node) {
    return !node.is_of_earlier_day && node.at.pose.stamp_ns == enu_->solved_ns;
  });
  return last != nodes_.end() ? &*last : nullptr;
}

/// Covariance, in the map, that the way from the latest solution with satellites gains by the scale.
vision::Matrix6d LocalPoseGraph::since_solution(const OdometrySample& at, const Node* from) const {
  if (from == nullptr || at.pose.stamp_ns < from->at.pose.stamp_ns) return vision::Matrix6d::Zero();
  return by_scale(from->map_from_base.linear() * way_between(from->at.pose, at.pose).translation(), scale_.sigma);
}

PoseInMap LocalPoseGraph::in_enu(const OdometrySample& at) const {
  const Node* const last = solved_node();
  const Node& from = last != nullptr ? *last : anchor(at.pose.stamp_ns);
  // Errors as vision::pose_error, of enu_from_base = map_from_enu^-1 * map_from_base to first order.
  const Eigen::Isometry3d enu_from_map = enu_->map_from_enu.inverse();
  vision::Matrix6d by_enu = -vision::Matrix6d::Identity();
  by_enu.topRightCorner<3, 3>() = vision::skew(from.map_from_base.translation() - enu_->map_from_enu.translation());
  const vision::Matrix6d mixed = by_enu * enu_->cross;
  const vision::Matrix6d in_map_axes =
      from.covariance + by_enu * enu_->covariance * by_enu.transpose() + mixed + mixed.transpose();
  const Eigen::Isometry3d enu_from_node = enu_from_map * from.map_from_base;
  const Eigen::Isometry3d way = way_between(from.at.pose, at.pose);
  const bool is_back = at.pose.stamp_ns < from.at.pose.stamp_ns;
  vision::Matrix6d gained = vision::Matrix6d::Zero();
  if (!is_back) gained = way_covariance(from.at, at) + by_scale(way.translation(), scale_.sigma);
  return {enu_from_node * way,
          vision::compose_covariance(enu_from_node, vision::rotate_covariance(enu_from_map.linear(), in_map_axes), way,
                                     gained)};
}

std::vector<std::size_t> LocalPoseGraph::journey_order() const {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!nodes_[i].is_of_earlier_day) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return nodes_[a].at.pose.stamp_ns < nodes_[b].at.pose.stamp_ns;
  });
  return order;
}

}  // namespace panvo::localizer
