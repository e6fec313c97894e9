// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/map_join.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <utility>

#include "panvo/fleet/clique.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::fleet {
namespace {

using vision::Matrix6d;
using vision::Vector6d;

constexpr std::size_t kMaxOfDirection = kMaxCliqueNodes / 2;
constexpr int kFitSteps = 6;
constexpr double kSmallStep = 1e-9;  // m and rad

Matrix6d diagonal(double position_sigma, double rotation_sigma) {
  Vector6d variance;
  variance << Eigen::Vector3d::Constant(position_sigma * position_sigma),
      Eigen::Vector3d::Constant(rotation_sigma * rotation_sigma);
  return variance.asDiagonal();
}

Matrix6d widened(const CrossSighting& sighting, const JoinParameters& parameters) {
  return sighting.covariance + diagonal(parameters.position_sigma_m, parameters.rotation_sigma_deg * vision::kDegree);
}

/// The two places of a sighting.
struct Ends {
  const landmarks::PanoramicLandmark* a = nullptr;
  const landmarks::PanoramicLandmark* b = nullptr;
};

Matrix6d between(const landmarks::PanoramicLandmark& i, const landmarks::PanoramicLandmark& j,
                 const JoinParameters& parameters) {
  if (i.id == j.id) return Matrix6d::Zero();
  return relative_covariance(i.map_from_base, i.covariance, j.map_from_base, j.covariance, parameters);
}

/// Squared Mahalanobis distance between the two ways from place a of sighting i to place b of sighting j.
double loop_error(const CrossSighting& i, const Ends& ends_i, const CrossSighting& j, const Ends& ends_j,
                  const JoinParameters& parameters) {
  const Eigen::Isometry3d through_a = ends_i.a->map_from_base.inverse() * ends_j.a->map_from_base;
  const Eigen::Isometry3d through_b = ends_i.b->map_from_base.inverse() * ends_j.b->map_from_base;
  const auto error = vision::pose_error(i.a_from_b * through_b, through_a * j.a_from_b);
  const Matrix6d covariance = vision::compose_covariance(through_a, between(*ends_i.a, *ends_j.a, parameters),
                                                         j.a_from_b, widened(j, parameters)) +
                              vision::compose_covariance(i.a_from_b, widened(i, parameters), through_b,
                                                         between(*ends_i.b, *ends_j.b, parameters));
  return error.dot(covariance.ldlt().solve(error));
}

void append(const SharedMap& own, const SharedMap& other, bool by_a, std::vector<CrossSighting>& found) {
  std::vector<std::pair<std::uint64_t, const Sighting*>> newest;
  for (const auto& [slot, seen] : own.sightings()) {
    const auto& sighting = seen.sighting;
    if (sighting.seen.map != other.id() || !own.find(sighting.own_place) || !other.find(sighting.seen.place)) continue;
    newest.emplace_back(seen.changed, &sighting);
  }
  std::sort(newest.begin(), newest.end(), [](const auto& one, const auto& two) {
    return std::pair(one.first, one.second->slot) > std::pair(two.first, two.second->slot);
  });
  newest.resize(std::min(newest.size(), kMaxOfDirection));
  std::sort(newest.begin(), newest.end(),
            [](const auto& one, const auto& two) { return one.second->slot < two.second->slot; });
  for (const auto& [version, sighting] : newest) {
    if (by_a) {
      found.push_back({sighting->own_place, sighting->seen.place, sighting->own_from_seen, sighting->covariance,
                       sighting->travelled_m, true});
    } else {
      found.push_back({sighting->seen.place, sighting->own_place, sighting->own_from_seen.inverse(),
                       vision::invert_covariance(sighting->own_from_seen, sighting->covariance), sighting->travelled_m,
                       false});
    }
  }
}

std::vector<Ends> ends_of(const SharedMap& a, const SharedMap& b, const std::vector<CrossSighting>& sightings) {
  std::vector<Ends> ends;
  ends.reserve(sightings.size());
  for (const auto& sighting : sightings) ends.push_back({a.find(sighting.place_a), b.find(sighting.place_b)});
  return ends;
}

/// Whether a sighting is precise enough to contradict others, and both maps upright according to it.
bool is_usable(const CrossSighting& sighting, const Ends& ends, const JoinParameters& parameters) {
  if (vision::horizontal_sigma(sighting.covariance) > parameters.max_sigma_m) return false;
  const Eigen::Matrix3d rotation =
      ends.a->map_from_base.linear() * sighting.a_from_b.linear() * ends.b->map_from_base.linear().transpose();
  return rotation(2, 2) >= std::cos(parameters.max_tilt_deg * vision::kDegree);
}

std::vector<NodeSet> consistent_pairs(const std::vector<CrossSighting>& sightings, const std::vector<Ends>& ends,
                                      const JoinParameters& parameters) {
  std::vector<NodeSet> neighbours(sightings.size(), 0);
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!is_usable(sightings[i], ends[i], parameters)) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_usable(sightings[j], ends[j], parameters)) continue;
      if (!(loop_error(sightings[j], ends[j], sightings[i], ends[i], parameters) < parameters.gate_chi_square))
        continue;
      neighbours[i] |= NodeSet{1} << j;
      neighbours[j] |= NodeSet{1} << i;
    }
  }
  return neighbours;
}

/// Those of `among` that contradict most of the clique. What contradicts only a few of it is imprecise, not wrong.
NodeSet against(NodeSet clique, const std::vector<NodeSet>& neighbours) {
  NodeSet found = 0;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const NodeSet node = NodeSet{1} << i;
    if ((clique & node) == 0 && 2 * std::popcount(neighbours[i] & clique) < std::popcount(clique)) found |= node;
  }
  return found;
}

/// How far apart the places seen, and the observers on their paths, are at most.
struct Extent {
  double apart_m = 0.0, path_m = 0.0;
  bool is_mutual = false;
};

Extent extent_of(const std::vector<CrossSighting>& agreed, const std::vector<Ends>& ends) {
  Extent extent;
  const auto seen_at = [&](std::size_t i) -> Eigen::Vector3d {
    const auto& a = ends[i].a->map_from_base;
    return agreed[i].by_a ? (a * agreed[i].a_from_b).translation() : a.translation();
  };
  for (std::size_t i = 0; i < agreed.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (agreed[i].by_a != agreed[j].by_a) {
        extent.is_mutual = true;
        continue;
      }
      extent.apart_m = std::max(extent.apart_m, (seen_at(i) - seen_at(j)).norm());
      extent.path_m = std::max(extent.path_m, std::abs(agreed[i].travelled_m - agreed[j].travelled_m));
    }
  }
  return extent;
}

std::string objection(const MapJoin& join, const std::vector<Ends>& ends, const JoinParameters& parameters) {
  if (join.sightings == 0) return "no place of one was seen by the other";
  if (join.agreeing < parameters.min_sightings) {
    return fmt::format("{} of {} sightings agree, {} needed", join.agreeing, join.sightings, parameters.min_sightings);
  }
  const auto extent = extent_of(join.agreed, ends);
  if (extent.apart_m < parameters.min_apart_m) {
    return fmt::format("the places seen are within {:.1f} m, {:.1f} m needed", extent.apart_m, parameters.min_apart_m);
  }
  if (!extent.is_mutual && extent.path_m < parameters.min_path_m) {
    return fmt::format("seen on {:.1f} m of path, {:.1f} m needed", extent.path_m, parameters.min_path_m);
  }
  if (join.agreeing < parameters.outweigh * join.contradicting) {
    return fmt::format("{} sightings agree, {} others contradict them", join.agreeing, join.contradicting);
  }
  return {};
}

}  // namespace

Matrix6d relative_covariance(const Eigen::Isometry3d& map_from_i, const Matrix6d& covariance_i,
                             const Eigen::Isometry3d& map_from_j, const Matrix6d& covariance_j,
                             const JoinParameters& parameters) {
  const Eigen::Isometry3d i_from_j = map_from_i.inverse() * map_from_j;
  const Matrix6d inherited = vision::compose_covariance(map_from_i, covariance_i, i_from_j, Matrix6d::Zero());
  const Matrix6d gained = vision::rotate_covariance(map_from_i.linear().transpose(), covariance_j - inherited);
  // Between corrections the later place is the less certain one, at a correction the earlier one: either way the
  // difference is what happened between them.
  const Eigen::SelfAdjointEigenSolver<Matrix6d> parts(0.5 * (gained + gained.transpose()));
  const double distance_m = i_from_j.translation().norm();
  return parts.eigenvectors() * parts.eigenvalues().cwiseAbs().asDiagonal() * parts.eigenvectors().transpose() +
         diagonal(parameters.drift_ratio * distance_m, parameters.drift_deg_per_m * vision::kDegree * distance_m);
}

std::vector<CrossSighting> cross_sightings(const SharedMap& a, const SharedMap& b) {
  std::vector<CrossSighting> found;
  append(a, b, true, found);
  append(b, a, false, found);
  return found;
}

MapJoin decide(const SharedMap& a, const SharedMap& b, const JoinParameters& parameters) {
  const auto sightings = cross_sightings(a, b);
  const auto ends = ends_of(a, b, sightings);
  const auto neighbours = consistent_pairs(sightings, ends, parameters);
  const NodeSet all = sightings.empty() ? 0 : ~NodeSet{0} >> (kMaxCliqueNodes - sightings.size());
  const NodeSet clique = largest_clique(neighbours, all);
  MapJoin join;
  join.sightings = static_cast<int>(sightings.size());
  join.agreeing = std::popcount(clique);
  join.contradicting = std::popcount(largest_clique(neighbours, against(clique, neighbours)));
  std::vector<Ends> ends_of_agreed;
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if ((clique >> i & 1) == 0) continue;
    join.agreed.push_back(sightings[i]);
    ends_of_agreed.push_back(ends[i]);
    pairs.emplace(sightings[i].place_a, sightings[i].place_b);
  }
  join.seen_places = static_cast<int>(pairs.size());
  join.reason = objection(join, ends_of_agreed, parameters);
  join.is_joined = join.reason.empty();
  return join;
}

std::optional<MapTransform> fit(const SharedMap& a, const SharedMap& b, const std::vector<CrossSighting>& agreed,
                                std::uint32_t near_a, const JoinParameters& parameters) {
  const auto* near = a.find(near_a);
  const auto ends = ends_of(a, b, agreed);
  if (agreed.empty() || !near) return std::nullopt;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (!ends[i].a || !ends[i].b) return std::nullopt;
    const auto distance = [&](std::size_t k) {
      return (ends[k].a->map_from_base.translation() - near->map_from_base.translation()).norm();
    };
    if (distance(i) < distance(nearest)) nearest = i;
  }
  const Eigen::Vector3d centre = near->map_from_base.translation();
  Eigen::Isometry3d a_from_b =
      ends[nearest].a->map_from_base * agreed[nearest].a_from_b * ends[nearest].b->map_from_base.inverse();
  Matrix6d information;
  for (int step = 0; step < kFitSteps; ++step) {
    information.setZero();
    Vector6d gradient = Vector6d::Zero();
    for (std::size_t i = 0; i < agreed.size(); ++i) {
      const auto& in_a = ends[i].a->map_from_base;
      const Eigen::Isometry3d measured = in_a * agreed[i].a_from_b;
      const Eigen::Isometry3d predicted = a_from_b * ends[i].b->map_from_base;
      const Matrix6d drift_a = between(*near, *ends[i].a, parameters);
      const Matrix6d drift_b = between(*ends[nearest].b, *ends[i].b, parameters);
      const Matrix6d covariance =
          vision::compose_covariance(in_a, vision::rotate_covariance(near->map_from_base.linear(), drift_a),
                                     agreed[i].a_from_b, widened(agreed[i], parameters)) +
          vision::rotate_covariance(a_from_b.linear() * ends[nearest].b->map_from_base.linear(), drift_b);
      Matrix6d by_change = Matrix6d::Identity();
      by_change.topRightCorner<3, 3>() = -vision::skew(predicted.translation() - centre);
      const Matrix6d weight = covariance.inverse();
      information += by_change.transpose() * weight * by_change;
      gradient += by_change.transpose() * weight * vision::pose_error(predicted, measured);
    }
    const Vector6d change = information.ldlt().solve(gradient);
    const Eigen::Matrix3d turn = vision::so3_exp(change.tail<3>());
    a_from_b.translation() = centre + turn * (a_from_b.translation() - centre) + change.head<3>();
    a_from_b.linear() = turn * a_from_b.linear();
    if (change.norm() < kSmallStep) break;
  }
  Matrix6d at_origin = Matrix6d::Identity();
  at_origin.topRightCorner<3, 3>() = -vision::skew(a_from_b.translation() - centre);
  return MapTransform{a_from_b, at_origin * information.inverse() * at_origin.transpose()};
}

}  // namespace panvo::fleet
