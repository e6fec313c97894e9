// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/metric_places.hpp"

#include <algorithm>

#include "panvo/landmark_builder/keypoint_triangulation.hpp"
#include "panvo/position_corrector/panorama_pose.hpp"

namespace panvo::places {
namespace {

constexpr double kMinBaseline_m = 0.5;  // less gives no range of what is 10 m away
constexpr double kMaxBaseline_m = 6.0;  // more, and the views have too little in common
constexpr std::size_t kNeighbours = 4;

/// The panorama looks along the vehicle's x axis: right, down, ahead are -y, -z, x.
Eigen::Isometry3d base_from_panorama() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return pose;
}

struct Candidate {
  double baseline_m;
  std::size_t index;
};

std::vector<landmark_builder::NeighbourPanorama> neighbours_of(const std::vector<KnownPlace>& places,
                                                               std::size_t index) {
  const Eigen::Isometry3d& here = *places[index].map_from_base;
  std::vector<Candidate> near;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i == index || !places[i].map_from_base) continue;
    const double baseline_m = (places[i].map_from_base->translation() - here.translation()).norm();
    if (baseline_m >= kMinBaseline_m && baseline_m <= kMaxBaseline_m) near.push_back({baseline_m, i});
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.baseline_m < b.baseline_m; });
  if (near.size() > kNeighbours) near.resize(kNeighbours);
  std::vector<landmark_builder::NeighbourPanorama> neighbours;
  for (const auto& candidate : near) {
    const auto& place = places[candidate.index];
    const Eigen::Isometry3d turn = base_from_panorama();
    neighbours.push_back({turn.inverse() * here.inverse() * *place.map_from_base * turn, place.keypoints});
  }
  return neighbours;
}

int count_points(const KnownPlace& place) {
  return static_cast<int>(std::count_if(place.keypoints.begin(), place.keypoints.end(),
                                        [](const auto& keypoint) { return keypoint.has_point; }));
}

}  // namespace

int triangulate_places(std::vector<KnownPlace>& places) {
  int metric = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].map_from_base) continue;
    landmark_builder::triangulate_keypoints(places[i].keypoints, neighbours_of(places, i), {});
    metric += count_points(places[i]) >= position_corrector::PanoramaPoseParameters{}.min_inliers ? 1 : 0;
  }
  return metric;
}

std::optional<MetricPosition> metric_position(std::span<const landmarks::Keypoint> query, const KnownPlace& place,
                                              double heading_rad) {
  if (!place.map_from_base || count_points(place) == 0) return std::nullopt;
  const auto found = position_corrector::estimate_panorama_pose(query, place.keypoints, heading_rad, {});
  if (!found.pose) return std::nullopt;
  const Eigen::Isometry3d turn = base_from_panorama();
  const Eigen::Isometry3d place_from_base = turn * found.pose->landmark_from_panorama * turn.inverse();
  const auto covariance = vision::rotate_covariance(turn.linear(), found.pose->covariance);
  return MetricPosition{*place.map_from_base * place_from_base, vision::horizontal_sigma(covariance)};
}

}  // namespace panvo::places
