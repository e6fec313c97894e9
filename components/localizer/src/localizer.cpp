// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/localizer.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace panvo::localizer {
namespace {

constexpr double kSecond_ns = 1e9;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLeastVariance = 1e-8;  // of an edge: a tenth of a millimetre, a tenth of a millirad

/// Covariance of a_from_b that odometry gained on the way from a to b, in the axes of a.
vision::Matrix6d gained(const OdometryPose& a, const OdometryPose& b) {
  const Eigen::Isometry3d a_from_b = a.odom_from_base.inverse() * b.odom_from_base;
  const vision::Matrix6d inherited =
      vision::compose_covariance(a.odom_from_base, a.covariance, a_from_b, vision::Matrix6d::Zero());
  vision::Matrix6d turn = vision::Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = a.odom_from_base.linear().transpose();
  const vision::Matrix6d difference = turn * (b.covariance - inherited) * turn.transpose();
  // rounding, and covariances that were reset, must not make it negative
  const Eigen::SelfAdjointEigenSolver<vision::Matrix6d> parts(0.5 * (difference + difference.transpose()));
  return parts.eigenvectors() * parts.eigenvalues().cwiseMax(kLeastVariance).asDiagonal() *
         parts.eigenvectors().transpose();
}

bool is_finite(const Eigen::Isometry3d& pose, const vision::Matrix6d& covariance) {
  return pose.matrix().allFinite() && covariance.allFinite();
}

double position_variance(const vision::Matrix6d& covariance) { return covariance.topLeftCorner<3, 3>().trace(); }

}  // namespace

Localizer::Localizer(const Parameters& parameters) : parameters_(parameters) {}

LocalizedPose Localizer::add(const OdometryPose& odometry) {
  const bool is_late = !history_.empty() && odometry.stamp_ns <= history_.back().pose.stamp_ns;
  if (is_late || !is_finite(odometry.odom_from_base, odometry.covariance)) return latest_;
  Remembered now{odometry, 0.0};
  if (history_.empty()) {
    Node start;
    start.at = now;
    start.map_from_base = odometry.odom_from_base;
    nodes_.push_back(start);
  } else {
    const auto& before = history_.back();
    now.way_m =
        before.way_m + (odometry.odom_from_base.translation() - before.pose.odom_from_base.translation()).norm();
  }
  history_.push_back(now);
  while (static_cast<double>(odometry.stamp_ns - history_.front().pose.stamp_ns) > parameters_.history_s * kSecond_ns) {
    history_.pop_front();
  }
  return latest_ = carried(odometry);
}

void Localizer::add_known(const KnownLandmark& landmark) {
  Node node;
  node.landmark_id = landmark.id;
  node.is_of_earlier_day = true;
  node.known = landmark;
  node.map_from_base = landmark.map_from_base;
  node.covariance = landmark.covariance;
  nodes_.push_back(node);
  if (!has_relocalised_) is_located_ = false;
}

std::optional<KnownLandmark> Localizer::add_built(std::uint32_t id, std::int64_t stamp_ns) {
  const auto at = remembered(stamp_ns);
  if (!at) return std::nullopt;
  Node node;
  node.landmark_id = id;
  node.at = *at;
  const auto here = carried(at->pose);
  node.map_from_base = here.map_from_base;
  node.covariance = here.covariance;
  nodes_.push_back(node);
  return KnownLandmark{id, stamp_ns, node.map_from_base, node.covariance};
}

Correction Localizer::add(const LandmarkSighting& sighting) {
  Correction correction;
  const auto rejected = [&](std::string reason) {
    correction.kind = CorrectionKind::kRejected;
    correction.reason = std::move(reason);
    return correction;
  };
  if (!is_finite(sighting.landmark_from_base, sighting.covariance)) return rejected("numbers that are none");
  const auto at = remembered(sighting.stamp_ns);
  if (!at) return rejected("no odometry is remembered of that time");
  const auto* const known = landmark(sighting.landmark_id);
  if (known == nullptr) return rejected(fmt::format("landmark {} is not known", sighting.landmark_id));
  correction.map_from_base_before = correction.map_from_base_after = carried(at->pose).map_from_base;
  const auto reason = doubt(sighting, *known, at->pose, correction);
  if (!reason.empty()) return rejected(reason);

  if (!is_located_) {
    place_journey(known->map_from_base * sighting.landmark_from_base * at->pose.odom_from_base.inverse());
    is_located_ = has_relocalised_ = true;
  }
  if (!take(sighting, *at)) {
    correction.kind = CorrectionKind::kBetterKnown;
    correction.reason = "a panorama of the same pass tells it better";
    return correction;
  }
  solve();
  correction.kind = CorrectionKind::kApplied;
  correction.map_from_base_after = carried(at->pose).map_from_base;
  if (!history_.empty()) latest_ = carried(history_.back().pose);
  return correction;
}

std::vector<KnownLandmark> Localizer::landmarks() const {
  std::vector<KnownLandmark> all;
  for (const auto& node : nodes_) {
    if (node.landmark_id == 0 || node.is_sighting) continue;
    all.push_back({node.landmark_id, node.is_of_earlier_day ? node.known.stamp_ns : node.at.pose.stamp_ns,
                   node.map_from_base, node.covariance});
  }
  return all;
}

/// Odometry at a time, between the two poses around it.
std::optional<Remembered> Localizer::remembered(std::int64_t stamp_ns) const {
  const auto after = std::lower_bound(history_.begin(), history_.end(), stamp_ns,
                                      [](const Remembered& one, std::int64_t at) { return one.pose.stamp_ns < at; });
  if (after == history_.end()) return std::nullopt;
  if (after->pose.stamp_ns == stamp_ns) return *after;
  if (after == history_.begin()) return std::nullopt;
  const auto& before = *std::prev(after);
  const double share = static_cast<double>(stamp_ns - before.pose.stamp_ns) /
                       static_cast<double>(after->pose.stamp_ns - before.pose.stamp_ns);
  Remembered between = before;
  between.pose.stamp_ns = stamp_ns;
  between.pose.odom_from_base =
      before.pose.odom_from_base *
      vision::se3_exp(share * vision::se3_log(before.pose.odom_from_base.inverse() * after->pose.odom_from_base));
  between.pose.covariance = (1.0 - share) * before.pose.covariance + share * after->pose.covariance;
  between.way_m = (1.0 - share) * before.way_m + share * after->way_m;
  return between;
}

const Localizer::Node* Localizer::landmark(std::uint32_t id) const {
  const auto found = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& node) {
    return node.landmark_id == id && id != 0 && !node.is_sighting;
  });
  return found == nodes_.end() ? nullptr : &*found;
}

/// The last node of this journey up to a time, else its first.
const Localizer::Node& Localizer::anchor(std::int64_t stamp_ns) const {
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

LocalizedPose Localizer::carried(const OdometryPose& odometry) const {
  const auto& from = anchor(odometry.stamp_ns);
  const Eigen::Isometry3d way = from.at.pose.odom_from_base.inverse() * odometry.odom_from_base;
  LocalizedPose pose;
  pose.stamp_ns = odometry.stamp_ns;
  pose.state = !is_located_ ? State::kUnlocated : has_relocalised_ ? State::kRelocalised : State::kTracking;
  pose.map_from_base = from.map_from_base * way;
  pose.map_from_odom = pose.map_from_base * odometry.odom_from_base.inverse();
  pose.covariance =
      vision::compose_covariance(from.map_from_base, from.covariance, way, gained(from.at.pose, odometry));
  return pose;
}

/// What speaks against a sighting; empty when nothing does.
std::string Localizer::doubt(const LandmarkSighting& sighting, const Node& landmark, const OdometryPose& odometry,
                             Correction& correction) {
  const Eigen::Isometry3d measured = landmark.map_from_base * sighting.landmark_from_base;
  const Eigen::Isometry3d map_from_odom = measured * odometry.odom_from_base.inverse();
  if (is_located_) {
    const auto expected = carried(odometry);
    const vision::Vector6d error = vision::pose_error(expected.map_from_base, measured);
    const vision::Matrix6d spread =
        expected.covariance + vision::compose_covariance(landmark.map_from_base, landmark.covariance,
                                                         sighting.landmark_from_base, sighting.covariance);
    correction.chi_square = error.dot(spread.ldlt().solve(error));
    if (correction.chi_square <= parameters_.gate_chi_square) {
      pending_.reset();
      return {};
    }
  }
  if (is_asked_for_twice(sighting, map_from_odom)) return {};
  return is_located_
             ? fmt::format("{:.0f} from what was expected, {:.0f} at most, until a second panorama asks for it, too",
                           correction.chi_square, parameters_.gate_chi_square)
             : "the first sighting: a second panorama must agree";
}

bool Localizer::is_asked_for_twice(const LandmarkSighting& sighting, const Eigen::Isometry3d& map_from_odom) {
  const auto before = std::exchange(pending_, Pending{sighting, map_from_odom});
  if (!before || before->sighting.landmark_id != sighting.landmark_id ||
      before->sighting.stamp_ns >= sighting.stamp_ns) {
    return false;
  }
  const auto odometry = remembered(sighting.stamp_ns);
  const auto now = map_from_odom * odometry->pose.odom_from_base;
  const auto then = before->map_from_odom * odometry->pose.odom_from_base;
  const auto apart = vision::pose_error(then, now);
  return apart.head<3>().norm() < parameters_.second_look_m &&
         apart.tail<3>().norm() < parameters_.second_look_deg * kDegree;
}

/// Where the whole journey lies in a map of earlier days.
void Localizer::place_journey(const Eigen::Isometry3d& map_from_odom) {
  for (auto& node : nodes_) {
    if (!node.is_of_earlier_day) node.map_from_base = map_from_odom * node.at.pose.odom_from_base;
  }
}

/// Makes a node of a sighting; false where the pass has a better one.
bool Localizer::take(const LandmarkSighting& sighting, const Remembered& at) {
  Node node;
  node.landmark_id = sighting.landmark_id;
  node.is_sighting = true;
  node.at = at;
  node.sighting = sighting;
  node.map_from_base = carried(at.pose).map_from_base;
  const auto same_pass = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& other) {
    return other.is_sighting && other.landmark_id == sighting.landmark_id &&
           std::abs(other.at.way_m - at.way_m) < parameters_.same_pass_m;
  });
  if (same_pass == nodes_.end()) {
    nodes_.push_back(node);
    return true;
  }
  if (position_variance(same_pass->sighting.covariance) <= position_variance(sighting.covariance)) return false;
  *same_pass = node;
  return true;
}

std::vector<std::size_t> Localizer::journey_order() const {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!nodes_[i].is_of_earlier_day) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return nodes_[a].at.pose.stamp_ns < nodes_[b].at.pose.stamp_ns;
  });
  return order;
}

void Localizer::solve() {
  PoseGraph graph;
  for (const auto& node : nodes_) graph.poses.push_back(node.map_from_base);
  const auto order = journey_order();
  for (std::size_t i = 1; i < order.size(); ++i) {
    const auto& a = nodes_[order[i - 1]].at.pose;
    const auto& b = nodes_[order[i]].at.pose;
    graph.edges.push_back({order[i - 1], order[i], a.odom_from_base.inverse() * b.odom_from_base, gained(a, b), false});
  }
  bool has_earlier_days = false;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto& node = nodes_[i];
    if (node.is_of_earlier_day) {
      has_earlier_days = true;
      const vision::Matrix6d covariance = node.known.covariance + kLeastVariance * vision::Matrix6d::Identity();
      graph.priors.push_back({i, node.known.map_from_base, covariance});
    }
    if (!node.is_sighting) continue;
    const auto seen = static_cast<std::size_t>(landmark(node.landmark_id) - nodes_.data());
    const vision::Matrix6d covariance = node.sighting.covariance + kLeastVariance * vision::Matrix6d::Identity();
    graph.edges.push_back({seen, i, node.sighting.landmark_from_base, covariance, true});
  }
  if (!has_earlier_days) {  // the map begins where the journey does
    vision::Matrix6d covariance = vision::Matrix6d::Identity();
    covariance.topLeftCorner<3, 3>() *= parameters_.start_sigma_m * parameters_.start_sigma_m;
    covariance.bottomRightCorner<3, 3>() *= std::pow(parameters_.start_sigma_deg * kDegree, 2);
    graph.priors.push_back({order.front(), nodes_[order.front()].at.pose.odom_from_base, covariance});
  }
  graph.optimise();
  const auto covariances = graph.covariances();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].map_from_base = graph.poses[i];
    if (covariances) nodes_[i].covariance = (*covariances)[i];
  }
}

}  // namespace panvo::localizer
