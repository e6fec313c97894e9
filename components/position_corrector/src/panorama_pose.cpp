// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/panorama_pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>
#include <numbers>
#include <opengv/absolute_pose/CentralAbsoluteAdapter.hpp>
#include <opengv/sac/Ransac.hpp>
#include <opengv/sac_problems/absolute_pose/AbsolutePoseSacProblem.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "panvo/landmarks/keypoints.hpp"
#include "panvo/position_corrector/pose_refinement.hpp"
#include "panvo/vision/angle.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::position_corrector {
namespace {

using landmarks::Keypoint;

constexpr int kMinForRansac = 5;
constexpr double kPoseFreedom = 6.0;
constexpr std::size_t kSectors = 12;
constexpr double kGate = 9.21;              // 99 % of chi-square with two degrees of freedom
constexpr double kSureDescriptors = 260.0;  // Euclidean, of 512: 90 % of the views of one point are closer

SightedPoint sighting(const Keypoint& seen, const Keypoint& known, double bearing_sigma_rad) {
  const Eigen::Vector3d point = known.point_in_panorama.cast<double>();
  const double range = point.norm();
  const Eigen::Vector3d along = point / range;
  const double along_sigma = range * range * static_cast<double>(known.inverse_range_sigma);
  const double across_sigma = range * bearing_sigma_rad;
  const Eigen::Matrix3d projection = along * along.transpose();
  return {
      point,
      along_sigma * along_sigma * projection + across_sigma * across_sigma * (Eigen::Matrix3d::Identity() - projection),
      seen.bearing.cast<double>().normalized()};
}

std::optional<Eigen::Isometry3d> three_point_ransac(std::span<const SightedPoint> sightings,
                                                    const PanoramaPoseParameters& parameters) {
  opengv::bearingVectors_t bearings;
  opengv::points_t points;
  for (const auto& seen : sightings) {
    bearings.push_back(seen.bearing);
    points.push_back(seen.point);
  }
  const opengv::absolute_pose::CentralAbsoluteAdapter adapter(bearings, points);
  using Problem = opengv::sac_problems::absolute_pose::AbsolutePoseSacProblem;
  opengv::sac::Ransac<Problem> ransac;
  auto copy = adapter;
  ransac.sac_model_.reset(new Problem(copy, Problem::KNEIP, false));  // own, constant seed
  ransac.threshold_ = 1.0 - std::cos(parameters.inlier_angle_deg * vision::kDegree);
  ransac.max_iterations_ = parameters.iterations;
  if (!ransac.computeModel() || !ransac.model_coefficients_.allFinite()) return std::nullopt;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = vision::nearest_rotation(ransac.model_coefficients_.leftCols<3>());
  pose.translation() = ransac.model_coefficients_.col(3);
  return pose;
}

double descriptor_distance(const Keypoint& a, const Keypoint& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.descriptor.size(); ++i) {
    const int difference = static_cast<int>(a.descriptor[i]) - static_cast<int>(b.descriptor[i]);
    sum += difference * difference;
  }
  return std::sqrt(static_cast<double>(sum));
}

/// Matches each point of the landmark with the most similar keypoint near its predicted bearing.
std::vector<SightedPoint> guided_sightings(std::span<const Keypoint> panorama, std::span<const Keypoint> landmark,
                                           const Eigen::Isometry3d& landmark_from_panorama,
                                           const PanoramaPoseParameters& parameters) {
  const double sigma_rad = parameters.bearing_sigma_deg * vision::kDegree;
  const double near = std::cos(3.0 * parameters.inlier_angle_deg * vision::kDegree);
  const Eigen::Isometry3d panorama_from_landmark = landmark_from_panorama.inverse();
  std::vector<double> best_of(panorama.size(), kSureDescriptors);
  std::vector<int> point_of(panorama.size(), -1);
  for (std::size_t j = 0; j < landmark.size(); ++j) {
    if (!landmark[j].has_point) continue;
    const Eigen::Vector3f expected =
        (panorama_from_landmark * landmark[j].point_in_panorama.cast<double>()).normalized().cast<float>();
    double best = std::numeric_limits<double>::infinity();
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < panorama.size(); ++i) {
      if (static_cast<double>(panorama[i].bearing.dot(expected)) < near) continue;
      const double distance = descriptor_distance(panorama[i], landmark[j]);
      if (distance >= best) continue;
      best = distance;
      chosen = i;
    }
    if (best >= kSureDescriptors || best >= best_of[chosen]) continue;
    best_of[chosen] = best;
    point_of[chosen] = static_cast<int>(j);
  }
  std::vector<SightedPoint> sightings;
  for (std::size_t i = 0; i < panorama.size(); ++i) {
    if (point_of[i] < 0) continue;
    const auto seen = sighting(panorama[i], landmark[static_cast<std::size_t>(point_of[i])], sigma_rad);
    if (squared_residual(seen, landmark_from_panorama, sigma_rad) < 4.0 * kGate) sightings.push_back(seen);
  }
  return sightings;
}

std::vector<SightedPoint> agreeing(std::span<const SightedPoint> sightings, const Eigen::Isometry3d& pose,
                                   double sigma_rad) {
  std::vector<SightedPoint> kept;
  std::copy_if(sightings.begin(), sightings.end(), std::back_inserter(kept),
               [&](const SightedPoint& seen) { return squared_residual(seen, pose, sigma_rad) < kGate; });
  return kept;
}

/// For display: the points that agree, and of those matched by their descriptors the others.
std::vector<PointMatch> matches_of(std::span<const SightedPoint> agreeing, std::span<const SightedPoint> matched) {
  std::vector<PointMatch> matches;
  for (const auto& seen : agreeing) matches.push_back({seen.point, seen.bearing, true});
  for (const auto& seen : matched) {
    const auto is_same = [&](const SightedPoint& other) { return other.point == seen.point; };
    if (std::ranges::none_of(agreeing, is_same)) matches.push_back({seen.point, seen.bearing, false});
  }
  return matches;
}

/// Factor on the covariance for selection bias: inliers were selected for agreement with the pose, so their residuals
/// are too small. The selection uses as many degrees of freedom as the fit, which matters for few points.
double by_choice(std::size_t points) {
  const double freedom = 2.0 * static_cast<double>(points) - kPoseFreedom;
  return freedom / std::max(1.0, freedom - kPoseFreedom);
}

/// Number of sectors, of twelve per turn, with a bearing: the content of a single sector may repeat elsewhere.
int sectors(std::span<const SightedPoint> sightings) {
  std::bitset<kSectors> seen;
  for (const auto& sighting : sightings) {
    const double turns = std::atan2(sighting.bearing.x(), sighting.bearing.z()) / (2.0 * std::numbers::pi) + 0.5;
    seen.set(std::min<std::size_t>(kSectors - 1, static_cast<std::size_t>(turns * kSectors)));
  }
  return static_cast<int>(seen.count());
}

/// Removes the layer of that thickness that holds the most of the heights, which are sorted.
void remove_fullest_layer(std::vector<double>& heights_m, double layer_m) {
  auto first = heights_m.begin(), last = heights_m.begin();
  for (auto from = heights_m.begin(), to = from; from != heights_m.end(); ++from) {
    while (to != heights_m.end() && *to <= *from + layer_m) ++to;
    if (to - from > last - first) std::tie(first, last) = std::pair(from, to);
  }
  heights_m.erase(first, last);
}

/// Number of points outside the two fullest horizontal layers: what these hold, a roof and a floor, repeats in a hall.
int beyond_layers(std::span<const SightedPoint> sightings, double layer_m) {
  if (layer_m <= 0.0) return static_cast<int>(sightings.size());
  std::vector<double> heights_m;
  for (const auto& sighting : sightings) heights_m.push_back(-sighting.point.y());
  std::ranges::sort(heights_m);
  for (int layer = 0; layer < 2; ++layer) remove_fullest_layer(heights_m, layer_m);
  return static_cast<int>(heights_m.size());
}

/// Reason to reject a pose; empty if there is none.
std::string objection(const Eigen::Isometry3d& pose, double heading_rad, const PanoramaPoseParameters& parameters) {
  const double offset_m = pose.translation().norm();
  if (offset_m > parameters.max_offset_m) {
    return fmt::format("{:.1f} m from the landmark, at most {:.0f} allowed", offset_m, parameters.max_offset_m);
  }
  const double turn_deg =
      std::abs(vision::wrap(heading_of(pose.linear()) - heading_rad, 2.0 * std::numbers::pi)) / vision::kDegree;
  if (turn_deg > parameters.max_turn_deg) {
    return fmt::format("rotated by {:.0f} deg from the heading found, at most {:.0f} allowed", turn_deg,
                       parameters.max_turn_deg);
  }
  const double tilt_deg = std::acos(std::clamp(pose.linear()(1, 1), -1.0, 1.0)) / vision::kDegree;
  if (tilt_deg > parameters.max_tilt_deg) {
    return fmt::format("tilted by {:.0f} deg, at most {:.0f} allowed", tilt_deg, parameters.max_tilt_deg);
  }
  return {};
}

}  // namespace

double heading_of(const Eigen::Matrix3d& landmark_from_panorama) {
  const Eigen::Vector3d forward = landmark_from_panorama.col(2);
  return vision::wrap(-std::atan2(forward.x(), forward.z()), 2.0 * std::numbers::pi);
}

PanoramaPoseResult estimate_panorama_pose(std::span<const Keypoint> panorama, std::span<const Keypoint> landmark,
                                          double heading_rad, const PanoramaPoseParameters& parameters) {
  const double sigma_rad = parameters.bearing_sigma_deg * vision::kDegree;
  const landmarks::AzimuthWindow window{heading_rad, parameters.azimuth_window_deg * vision::kDegree};
  std::vector<SightedPoint> matched;
  for (const auto& match :
       match_keypoints(panorama, landmark, static_cast<float>(parameters.descriptor_ratio), window)) {
    const auto& known = landmark[static_cast<std::size_t>(match.landmark)];
    if (known.has_point) matched.push_back(sighting(panorama[static_cast<std::size_t>(match.query)], known, sigma_rad));
  }
  PanoramaPoseResult result;
  result.matches = static_cast<int>(matched.size());
  result.points = matches_of({}, matched);
  const int needed =
      std::max(parameters.min_inliers, static_cast<int>(std::ceil(parameters.min_inliers_share * result.matches)));
  const auto few = [&](std::string_view what, int count) {
    result.reason = fmt::format("{} {} of {} needed", count, what, needed);
    return result;
  };
  const int needed_weakly = std::min(needed, std::max(parameters.min_weak_inliers, kMinForRansac));
  if (result.matches < needed_weakly) return few("matched points", result.matches);
  const auto start = three_point_ransac(matched, parameters);
  if (!start) return few("inliers", 0);

  std::vector<SightedPoint> inliers;
  const double cosine = std::cos(parameters.inlier_angle_deg * vision::kDegree);
  for (const auto& seen : matched) {
    const Eigen::Vector3d expected = (start->inverse() * seen.point).normalized();
    if (expected.dot(seen.bearing) > cosine) inliers.push_back(seen);
  }
  result.inliers = static_cast<int>(inliers.size());
  if (result.inliers < needed_weakly) return few("inliers", result.inliers);
  if (const int held = sectors(inliers); held < parameters.min_sectors) {
    result.reason = fmt::format("{} inliers, but only in {} of 12 sectors, {} needed", result.inliers, held,
                                parameters.min_sectors);
    return result;
  }

  // with an approximate pose, matches are searched at predicted bearings
  auto refined = refine_pose(*start, inliers, sigma_rad);
  auto guided = guided_sightings(panorama, landmark, refined.landmark_from_panorama, parameters);
  if (guided.size() < inliers.size()) guided = inliers;
  refined = refine_pose(refined.landmark_from_panorama, guided, sigma_rad);
  guided = agreeing(guided, refined.landmark_from_panorama, sigma_rad);
  result.inliers = static_cast<int>(guided.size());
  if (result.inliers < needed_weakly) return few("inliers", result.inliers);
  refined = refine_pose(refined.landmark_from_panorama, guided, sigma_rad);

  const int beyond = beyond_layers(guided, parameters.layer_m);
  if (const int least = ((result.inliers < needed ? needed_weakly : needed) + 1) / 2; beyond < least) {
    result.reason = fmt::format("{} inliers, but only {} outside two layers of equal height, {} needed", result.inliers,
                                beyond, least);
    return result;
  }
  result.reason = objection(refined.landmark_from_panorama, heading_rad, parameters);
  if (!result.reason.empty()) return result;
  result.points = matches_of(guided, matched);
  const auto covariance = covariance_without_most_informative(refined, guided, sigma_rad, parameters.spare_points);
  const PanoramaPose pose{refined.landmark_from_panorama, by_choice(guided.size()) * covariance,
                          heading_of(refined.landmark_from_panorama.linear())};
  if (result.inliers < needed) {
    result.weak_pose = pose;
    return few("inliers", result.inliers);
  }
  result.pose = pose;
  return result;
}

}  // namespace panvo::position_corrector
