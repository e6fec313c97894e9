// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/view_evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "panvo/landmarks/keypoints.hpp"
#include "panvo/places/chance.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::stereo_places {
namespace {

using landmarks::Keypoint;

constexpr int kSample = 3;            // points define a pose
constexpr int kObjectSteps = 12;      // positions of an object across the view
constexpr int kPlanes = 150;          // tried: finds a surface with a quarter of the points with 90 %
constexpr double kRough_m = 0.08;     // of a surface, and the noise of bearings
constexpr double kOnPlane = 2.5;      // standard deviations
constexpr double kMinArea_m2 = 0.05;  // of the triangle that defines a plane

/// A match of a bearing in the view with a point of the place.
struct Pair {
  Eigen::Vector3d bearing;           // unit, in the view
  Eigen::Vector3d bearing_at_place;  // unit
  Eigen::Vector3d point;             // m, frame of the place
  double range_sigma_m;              // of the point
};

/// Most similar first. Of matches that are close together in both views only the most similar one is kept.
std::vector<Pair> pairs_of(std::span<const Keypoint> view, std::span<const Keypoint> place,
                           const EvidenceParameters& parameters) {
  auto matches = landmarks::match_keypoints(view, place, static_cast<float>(parameters.descriptor_ratio));
  std::stable_sort(matches.begin(), matches.end(),
                   [](const auto& a, const auto& b) { return a.distance < b.distance; });
  const double close = std::cos(parameters.same_object_deg * vision::kDegree);
  std::vector<Pair> pairs;
  for (const auto& match : matches) {
    const auto& known = place[static_cast<std::size_t>(match.landmark)];
    if (!known.has_point) continue;
    const Pair pair{view[static_cast<std::size_t>(match.query)].bearing.cast<double>().normalized(),
                    known.bearing.cast<double>().normalized(), known.point_in_panorama.cast<double>(),
                    static_cast<double>(known.point_in_panorama.squaredNorm() * known.inverse_range_sigma)};
    const bool is_known = std::any_of(pairs.begin(), pairs.end(), [&](const Pair& other) {
      return other.bearing.dot(pair.bearing) > close && other.bearing_at_place.dot(pair.bearing_at_place) > close;
    });
    if (!is_known) pairs.push_back(pair);
  }
  return pairs;
}

/// Probability that the match agrees at least as well by chance: share of the view's row within the same angle.
double probability(const Pair& pair, const Eigen::Isometry3d& view_from_place, double field_of_view_rad) {
  const Eigen::Vector3d seen = view_from_place * pair.point;
  if (seen.z() <= 0.0) return 1.0;
  const double angle_rad = std::acos(std::clamp(seen.normalized().dot(pair.bearing), -1.0, 1.0));
  return std::min(1.0, 2.0 * angle_rad / field_of_view_rad);
}

double azimuth_of(const Pair& pair) { return std::atan2(pair.bearing.x(), pair.bearing.z()); }

/// The largest expectation without what lies within any window of the view.
double without_any_object(const std::vector<Pair>& pairs, const std::vector<double>& probabilities, double largest,
                          double field_of_view_rad, double log10_places, double object_share) {
  double worst = -std::numeric_limits<double>::infinity();
  const double half_rad = 0.5 * object_share * field_of_view_rad;
  for (int i = 0; i <= kObjectSteps; ++i) {
    const double middle_rad = field_of_view_rad * (static_cast<double>(i) / kObjectSteps - 0.5);
    std::vector<double> rest;
    for (std::size_t j = 0; j < pairs.size(); ++j) {
      if (std::abs(azimuth_of(pairs[j]) - middle_rad) <= half_rad) continue;
      rest.push_back(probabilities[j] <= largest ? probabilities[j] : 1.0);  // it must agree as well as all did
    }
    worst = std::max(worst, places::least_expected(rest, kSample, log10_places).log10_expected);
  }
  return worst;
}

struct Plane {
  Eigen::Vector3d normal;
  double distance_m;

  bool holds(const Pair& pair) const {
    const double sigma_m = std::hypot(kRough_m, normal.dot(pair.point.normalized()) * pair.range_sigma_m);
    return std::abs(normal.dot(pair.point) - distance_m) < kOnPlane * sigma_m;
  }
};

/// The plane with the most points; nullopt if the points lie on a line.
std::optional<Plane> largest_plane(const std::vector<Pair>& pairs) {
  std::optional<Plane> best;
  std::ptrdiff_t most = 0;
  std::mt19937_64 random(1);
  for (int i = 0; i < kPlanes && pairs.size() >= kSample; ++i) {
    const auto& a = pairs[random() % pairs.size()].point;
    const auto& b = pairs[random() % pairs.size()].point;
    const auto& c = pairs[random() % pairs.size()].point;
    const Eigen::Vector3d across = (b - a).cross(c - a);
    if (across.norm() < kMinArea_m2) continue;
    const Plane plane{across.normalized(), across.normalized().dot(a)};
    const auto count = std::count_if(pairs.begin(), pairs.end(), [&](const Pair& pair) { return plane.holds(pair); });
    if (count <= most) continue;
    most = count;
    best = plane;
  }
  return best;
}

/// The expectation without what lies on the flat surface with the most agreeing points.
double without_largest_plane(const std::vector<Pair>& pairs, const std::vector<double>& probabilities, double largest,
                             double log10_places) {
  std::vector<Pair> agreeing;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (probabilities[i] <= largest) agreeing.push_back(pairs[i]);
  }
  const auto plane = largest_plane(agreeing);
  if (!plane) return 0.0;
  std::vector<double> rest;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!plane->holds(pairs[i])) rest.push_back(probabilities[i] <= largest ? probabilities[i] : 1.0);
  }
  return places::least_expected(rest, kSample, log10_places).log10_expected;
}

}  // namespace

ViewEvidence judge_view(std::span<const Keypoint> view, std::span<const Keypoint> place,
                        const Eigen::Isometry3d& place_from_view, double field_of_view_rad, double log10_places,
                        const EvidenceParameters& parameters) {
  const auto pairs = pairs_of(view, place, parameters);
  const Eigen::Isometry3d view_from_place = place_from_view.inverse();
  std::vector<double> probabilities;
  for (const auto& pair : pairs) probabilities.push_back(probability(pair, view_from_place, field_of_view_rad));
  const auto consensus = places::least_expected(probabilities, kSample, log10_places);
  ViewEvidence evidence;
  evidence.matches = static_cast<int>(pairs.size());
  evidence.agreeing = consensus.size;
  evidence.log10_expected = consensus.log10_expected;
  evidence.log10_without_object = without_any_object(pairs, probabilities, consensus.probability, field_of_view_rad,
                                                     log10_places, parameters.object_share);
  evidence.log10_without_plane = without_largest_plane(pairs, probabilities, consensus.probability, log10_places);
  if (evidence.log10_expected > parameters.log10_false_alarms) {
    evidence.objection = fmt::format("{} of {} matches agree, as chance may explain (1e{:.0f})", evidence.agreeing,
                                     evidence.matches, evidence.log10_expected);
  } else if (evidence.log10_without_object > parameters.log10_false_alarms) {
    evidence.objection = fmt::format("{} of {} matches agree, but only in one part of the view (1e{:.0f} without it)",
                                     evidence.agreeing, evidence.matches, evidence.log10_without_object);
  } else if (evidence.log10_without_plane > parameters.log10_false_alarms) {
    evidence.objection = fmt::format("{} of {} matches agree, but only on one flat surface (1e{:.0f} without it)",
                                     evidence.agreeing, evidence.matches, evidence.log10_without_plane);
  }
  return evidence;
}

}  // namespace panvo::stereo_places
