// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/local_pose_graph.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace panvo::localizer {
namespace {

// Per landmark. Eight reduce the error of a single sighting to a third; the rest is common to all sightings.
constexpr int kMaxPasses = 8;
// Remaining odometry constraint across a cut: moved within a kilometre, any yaw, nearly upright.
constexpr double kCutPosition_m = 1000.0;
constexpr double kCutTilt_rad = 0.2;
constexpr double kCutYaw_rad = 3.0;

double position_variance(const vision::Matrix6d& covariance) { return covariance.topLeftCorner<3, 3>().trace(); }

vision::Matrix6d cut_covariance() {
  vision::Vector6d sigma;
  sigma << kCutPosition_m, kCutPosition_m, kCutPosition_m, kCutTilt_rad, kCutTilt_rad, kCutYaw_rad;
  return sigma.cwiseAbs2().asDiagonal();
}

}  // namespace

LocalPoseGraph::LocalPoseGraph(double start_sigma_m, double start_sigma_rad, double scale_sigma,
                               const GnssParameters& fixes)
    : scale_sigma_(scale_sigma), fix_parameters_(fixes) {
  start_.covariance.topLeftCorner<3, 3>() = start_sigma_m * start_sigma_m * Eigen::Matrix3d::Identity();
  start_.covariance.bottomRightCorner<3, 3>() = start_sigma_rad * start_sigma_rad * Eigen::Matrix3d::Identity();
}

bool LocalPoseGraph::has_only_start() const {
  return has_started() &&
         std::all_of(std::next(nodes_.begin()), nodes_.end(), [](const Node& node) { return node.fix; });
}

void LocalPoseGraph::expect_scale(const Estimate& scale) {
  scale_ = scale;
  expected_scale_ = scale.value;
  scale_sigma_ = scale.sigma;
}

std::optional<Estimate> LocalPoseGraph::measured_scale() const {
  const bool is_measured =
      enu_ && scale_.sigma > 0.0 && 2.0 * scale_.sigma * scale_.sigma < scale_sigma_ * scale_sigma_;
  return is_measured ? std::optional(scale_) : std::nullopt;
}

void LocalPoseGraph::start(const OdometrySample& at) {
  start_.map_from_base = at.pose.odom_from_base;
  Node node;
  node.at = at;
  node.map_from_base = start_.map_from_base;
  node.covariance = start_.covariance;
  nodes_.push_back(node);
}

void LocalPoseGraph::add_built(std::uint32_t id, std::int64_t panorama_ns, const OdometrySample& at) {
  Node node;
  node.landmark_id = id;
  node.at = at;
  node.sighting.stamp_ns = panorama_ns;
  const auto here = reckoned(at);
  node.map_from_base = here.map_from_base;
  node.covariance = here.covariance;
  nodes_.push_back(node);
}

void LocalPoseGraph::set_initial_pose(const PoseInMap& pose, const OdometrySample& at) {
  Node node;
  node.at = at;
  node.said = pose;
  node.map_from_base = pose.map_from_base;
  node.covariance = pose.covariance;
  nodes_.push_back(node);
}

bool LocalPoseGraph::add_pass(const LandmarkSighting& sighting, const OdometrySample& at, double same_pass_m) {
  Node node;
  node.landmark_id = sighting.landmark_id;
  node.is_pass = true;
  node.at = at;
  node.sighting = sighting;
  const auto here = reckoned(at);
  node.map_from_base = here.map_from_base;
  node.covariance = here.covariance;
  const auto same_pass = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& other) {
    return other.is_pass && other.landmark_id == sighting.landmark_id &&
           std::abs(other.at.way_m - at.way_m) < same_pass_m && !is_cut(other.at.pose.stamp_ns, at.pose.stamp_ns);
  });
  if (same_pass != nodes_.end()) {
    if (position_variance(same_pass->sighting.covariance) <= position_variance(sighting.covariance)) return false;
    *same_pass = node;
    return true;
  }
  if (landmark_node(sighting.landmark_id) == nullptr) {
    const auto& known = known_.at(sighting.landmark_id);
    Node seen;
    seen.landmark_id = known.id;
    seen.is_of_earlier_day = true;
    seen.at.pose.stamp_ns = known.stamp_ns;
    seen.map_from_base = known.map_from_base;
    seen.covariance = known.covariance;
    nodes_.push_back(seen);
  }
  nodes_.push_back(node);
  forget_least_precise_pass(sighting.landmark_id);
  return true;
}

/// The odometry before and after a removed pass needs no merging: edges are derived from the existing nodes.
void LocalPoseGraph::forget_least_precise_pass(std::uint32_t landmark_id) {
  auto worst = nodes_.end();
  int passes = 0;
  for (auto node = nodes_.begin(); node != std::prev(nodes_.end()); ++node) {  // the last one is the newest
    if (!node->is_pass || node->landmark_id != landmark_id) continue;
    ++passes;
    const bool is_worse = worst == nodes_.end() ||
                          position_variance(node->sighting.covariance) > position_variance(worst->sighting.covariance);
    if (is_worse) worst = node;
  }
  if (passes >= kMaxPasses) nodes_.erase(worst);
}

std::optional<KnownLandmark> LocalPoseGraph::landmark(std::uint32_t id) const {
  if (const auto* const node = landmark_node(id)) {
    return KnownLandmark{id, node->at.pose.stamp_ns, node->map_from_base, node->covariance};
  }
  const auto known = known_.find(id);
  return known == known_.end() ? std::nullopt : std::optional(known->second);
}

std::vector<KnownLandmark> LocalPoseGraph::landmarks() const {
  std::vector<KnownLandmark> all;
  const Node* const solved = solved_node();
  for (const auto& node : nodes_) {
    if (node.landmark_id == 0 || node.is_pass) continue;
    // Errors of landmarks of one earlier journey are correlated: seeing several does not reduce them.
    const vision::Matrix6d covariance = node.is_of_earlier_day
                                            ? known_.at(node.landmark_id).covariance
                                            : vision::Matrix6d(node.covariance + since_solution(node.at, solved));
    all.push_back({node.landmark_id, node.at.pose.stamp_ns, node.map_from_base, covariance});
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return all;
}

PoseInMap LocalPoseGraph::carried(const OdometrySample& at) const {
  PoseInMap here = reckoned(at);
  here.covariance += since_solution(at, solved_node());
  return here;
}

/// The same without the uncertainty of the scale, which later solutions contain.
PoseInMap LocalPoseGraph::reckoned(const OdometrySample& at) const { return reckoned(at, anchor(at.pose.stamp_ns)); }

PoseInMap LocalPoseGraph::reckoned(const OdometrySample& at, const Node& from) const {
  const bool is_back = at.pose.stamp_ns < from.at.pose.stamp_ns;  // before the journey's first node
  const Eigen::Isometry3d way = way_between(from.at.pose, at.pose);
  const vision::Matrix6d covariance =
      is_back ? vision::Matrix6d(vision::Matrix6d::Zero()) : way_covariance(from.at, at);
  return {from.map_from_base * way, vision::compose_covariance(from.map_from_base, from.covariance, way, covariance)};
}

void LocalPoseGraph::place(const Eigen::Isometry3d& map_from_former_map) {
  is_placed_ = true;
  move(map_from_former_map);
}

void LocalPoseGraph::move(const Eigen::Isometry3d& map_from_former_map) {
  start_.map_from_base = map_from_former_map * start_.map_from_base;
  start_.covariance = vision::rotate_covariance(map_from_former_map.linear(), start_.covariance);
  for (auto& node : nodes_) {
    if (node.is_of_earlier_day) continue;
    node.map_from_base = map_from_former_map * node.map_from_base;
    node.covariance = vision::rotate_covariance(map_from_former_map.linear(), node.covariance);
  }
  if (!enu_ || enu_->known) return;
  enu_->map_from_enu = map_from_former_map * enu_->map_from_enu;
  enu_->covariance = vision::rotate_covariance(map_from_former_map.linear(), enu_->covariance);
  enu_->cross = vision::rotate_covariance(map_from_former_map.linear(), enu_->cross);
}

void LocalPoseGraph::refresh(const OdometryBuffer& chain, std::int64_t since_ns) {
  for (auto& node : nodes_) {
    if (node.is_of_earlier_day || node.at.pose.stamp_ns <= since_ns) continue;
    if (const auto at = chain.at(node.at.pose.stamp_ns)) node.at = *at;
  }
}

void LocalPoseGraph::set_clock(const OdometryBuffer& chain, std::int64_t ahead_ns, std::int64_t since_ns) {
  for (auto& node : nodes_) {
    if (node.landmark_id == 0 || node.is_of_earlier_day || node.sighting.stamp_ns <= since_ns) continue;
    const auto at = chain.at(node.sighting.stamp_ns - ahead_ns);
    if (!at) continue;
    node.map_from_base = node.map_from_base * (node.at.pose.odom_from_base.inverse() * at->pose.odom_from_base);
    node.at = *at;
  }
}

void LocalPoseGraph::set_clock_back(std::int64_t by_ns) {
  for (auto& node : nodes_) {
    if (node.is_of_earlier_day) continue;
    node.at.pose.stamp_ns -= by_ns;
    node.sighting.stamp_ns -= by_ns;
  }
  for (auto& cut_ns : cuts_ns_) cut_ns -= by_ns;
  if (enu_) enu_->solved_ns -= by_ns;
}

const LocalPoseGraph::Node* LocalPoseGraph::landmark_node(std::uint32_t id) const {
  const auto found = std::find_if(nodes_.begin(), nodes_.end(),
                                  [&](const Node& node) { return node.landmark_id == id && id != 0 && !node.is_pass; });
  return found == nodes_.end() ? nullptr : &*found;
}

/// The last node of this journey up to a time, else its first node.
const LocalPoseGraph::Node& LocalPoseGraph::anchor(std::int64_t stamp_ns) const {
  const Node* last = nullptr;
  const Node* first = nullptr;
  for (const auto& node : nodes_) {
    if (node.is_of_earlier_day) continue;
    if (first == nullptr || node.at.pose.stamp_ns < first->at.pose.stamp_ns) first = &node;
    if (node.at.pose.stamp_ns > stamp_ns) continue;
    if (last == nullptr || node.at.pose.stamp_ns >= last->at.pose.stamp_ns) last = &node;
  }
  return last != nullptr ? *last : *first;
}

/// Whether the vehicle was lifted between two times.
bool LocalPoseGraph::is_cut(std::int64_t from_ns, std::int64_t to_ns) const {
  const std::int64_t first_ns = std::min(from_ns, to_ns), last_ns = std::max(from_ns, to_ns);
  return std::any_of(cuts_ns_.begin(), cuts_ns_.end(),
                     [&](std::int64_t cut_ns) { return first_ns < cut_ns && cut_ns <= last_ns; });
}

/// Motion between two times by odometry, without its error of scale.
Eigen::Isometry3d LocalPoseGraph::way_between(const OdometryPose& from, const OdometryPose& to) const {
  Eigen::Isometry3d way = from.odom_from_base.inverse() * to.odom_from_base;
  way.translation() /= scale_.value;
  return way;
}

/// Covariance gained by odometry between two times, in the axes of the first.
vision::Matrix6d LocalPoseGraph::way_covariance(const OdometrySample& from, const OdometrySample& to) const {
  const vision::Matrix6d gained =
      gained_covariance(from.pose, to.pose, 0.0) + covariance_of_turns(from, to, turn_errors_);
  return is_cut(from.pose.stamp_ns, to.pose.stamp_ns) ? vision::Matrix6d(gained + cut_covariance()) : gained;
}

}  // namespace panvo::localizer
