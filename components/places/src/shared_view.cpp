// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/shared_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "panvo/position_corrector/panorama_pose.hpp"
#include "panvo/vision/angle.hpp"
#include "panvo/vision/pose.hpp"
#include "view_motion.hpp"

namespace panvo::places {
namespace {

constexpr int kRefinements = 3;
constexpr double kModels = 3.0;
constexpr int kObjectSteps = 24;  // azimuths at which an object is assumed
constexpr int kAttempts = 2;  // with everything, and without the object on which alone the first one agrees (a bonnet)
constexpr double kSky_rad = 10.0 * vision::kDegree;      // above the horizon: higher things may be sky
constexpr double kVehicle_rad = 20.0 * vision::kDegree;  // below the horizon: lower things may be the own vehicle
constexpr double kCertainShare = 0.25;                   // of the evidence that must remain when ranges may differ
constexpr double kFar = 0.01;                            // rad between two bearings: less is noise of the keypoints
constexpr double kMaxDirectionSigma_rad = 20.0 * vision::kDegree;  // a less certain direction is not stated

struct Judged {
  ViewMotion motion;
  Consensus consensus;
};

std::vector<BearingPair> agreeing(const std::vector<BearingPair>& pairs, const Judged& judged) {
  std::vector<BearingPair> chosen;
  for (const auto& pair : pairs) {
    if (probability(pair, judged.motion) <= judged.consensus.probability) chosen.push_back(pair);
  }
  return chosen;
}

Judged judge(const ViewMotion& motion, const std::vector<BearingPair>& pairs, double log10_tests) {
  return {motion, least_expected(probabilities(pairs, motion), sample_size(motion.model), log10_tests)};
}

/// Refines a hypothesis over those that agree with it as long as that makes it less likely to be chance.
Judged refined(Judged best, const std::vector<BearingPair>& pairs, double log10_tests, double sigma_rad) {
  for (int i = 0; i < kRefinements && best.consensus.size > sample_size(best.motion.model); ++i) {
    const auto next = judge(refine_motion(best.motion, agreeing(pairs, best), sigma_rad), pairs, log10_tests);
    if (next.consensus.log10_expected >= best.consensus.log10_expected) break;
    best = next;
  }
  return best;
}

Judged best_motion(const std::vector<BearingPair>& pairs, double log10_tests, double sigma_rad) {
  Judged best;
  for (const auto& motion : propose_motions(pairs)) {
    const auto judged = refined(judge(motion, pairs, log10_tests), pairs, log10_tests, sigma_rad);
    if (judged.consensus.log10_expected < best.consensus.log10_expected) best = judged;
  }
  return best;
}

/// log10 of the expectation of a part of the pairs. It must agree as well as all did: a wrong turn by 15 degrees would be a
/// common, if rough, agreement of everything outside a bonnet.
double log10_expected_of(const std::vector<BearingPair>& part, const Judged& judged, double log10_tests) {
  auto values = probabilities(part, judged.motion);
  std::replace_if(
      values.begin(), values.end(), [&](double p) { return p > judged.consensus.probability; }, 1.0);
  return least_expected(values, sample_size(judged.motion.model), log10_tests).log10_expected;
}

/// Clouds and the sun stand at the same bearings everywhere, and so does the own vehicle: they do not tell the place.
std::vector<BearingPair> between_sky_and_vehicle(const std::vector<BearingPair>& pairs) {
  std::vector<BearingPair> between;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(between), [](const BearingPair& pair) {
    return -pair.landmark.y() < std::sin(kSky_rad) && pair.landmark.y() < std::sin(kVehicle_rad);
  });
  return between;
}

/// Whether a pair is seen from the place within an azimuth window.
bool is_within(const BearingPair& pair, double middle_rad, double width_rad) {
  return std::abs(vision::wrapped(azimuth_of(pair.landmark) - middle_rad)) <= 0.5 * width_rad;
}

std::vector<BearingPair> outside(const std::vector<BearingPair>& pairs, double middle_rad, double width_rad) {
  std::vector<BearingPair> others;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(others),
               [&](const BearingPair& pair) { return !is_within(pair, middle_rad, width_rad); });
  return others;
}

/// Middle of the azimuth window number `i` of kObjectSteps.
double window_middle_rad(int i) { return 2.0 * std::numbers::pi * i / kObjectSteps; }

/// The largest log10 of the expectation after everything within an azimuth window is left out.
double without_any_object(const std::vector<BearingPair>& pairs, const Judged& judged, double log10_tests,
                          double object_rad) {
  double worst = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < kObjectSteps; ++i) {
    const auto others = outside(pairs, window_middle_rad(i), object_rad);
    worst = std::max(worst, log10_expected_of(others, judged, log10_tests));
  }
  return worst;
}

/// Least squares over the epipolar planes: unlike equal ranges, these hold for things at any range.
Judged at_any_range(const Judged& best, const std::vector<BearingPair>& pairs, double log10_tests, double sigma_rad) {
  if (best.motion.model != ViewModel::kEqualRange) return best;
  auto start = best.motion;
  start.model = ViewModel::kEpipolar;
  start.translation.normalize();
  const auto exact = judge(refine_motion(start, agreeing(pairs, best), sigma_rad), pairs, log10_tests);
  const bool is_certain = exact.consensus.log10_expected < kCertainShare * best.consensus.log10_expected;
  return is_certain ? refined(exact, pairs, log10_tests, sigma_rad) : best;
}

/// Range of a thing from the place over the distance of the two positions; nullopt if too far to tell.
std::optional<double> range_per_baseline(const BearingPair& pair, const ViewMotion& motion) {
  const Eigen::Vector3d turned = motion.rotation * pair.panorama;
  const Eigen::Vector3d normal = pair.landmark.cross(turned);
  const double squared = normal.squaredNorm();
  if (squared < kFar * kFar) return std::nullopt;
  return motion.translation.normalized().cross(turned).dot(normal) / squared;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double baseline_per_range(const Judged& judged, const std::vector<BearingPair>& agreeing) {
  if (judged.motion.model == ViewModel::kRotation) return 0.0;
  if (judged.motion.model == ViewModel::kEqualRange) return judged.motion.translation.norm();
  std::vector<double> inverse;
  for (const auto& pair : agreeing) {
    const auto range = range_per_baseline(pair, judged.motion);
    inverse.push_back(range && *range > 0.0 ? 1.0 / *range : 0.0);
  }
  return inverse.empty() ? 0.0 : median(inverse);
}

SharedView describe(const Judged& judged, const std::vector<BearingPair>& agreeing, double sigma_rad) {
  const auto& motion = judged.motion;
  SharedView view;
  view.model = motion.model;
  view.rotation = motion.rotation;
  view.heading_rad = position_corrector::heading_of(motion.rotation);
  view.baseline_per_range = baseline_per_range(judged, agreeing);
  const auto uncertainty = motion_uncertainty(motion, agreeing, sigma_rad);
  view.heading_sigma_rad = uncertainty.heading_rad;
  const bool is_direction_known =
      motion.model != ViewModel::kRotation && uncertainty.direction_rad < kMaxDirectionSigma_rad;
  if (is_direction_known) {
    view.direction = motion.translation.normalized();
    view.direction_sigma_rad = uncertainty.direction_rad;
  }
  return view;
}

/// Everything but the azimuth window with the most agreeing pairs.
std::vector<BearingPair> outside_object(const std::vector<BearingPair>& pairs, const Judged& judged,
                                        double object_rad) {
  const auto chosen = agreeing(pairs, judged);
  double densest = 0.0;
  std::ptrdiff_t most = -1;
  for (int i = 0; i < kObjectSteps; ++i) {
    const double middle = window_middle_rad(i);
    const auto count = std::count_if(chosen.begin(), chosen.end(),
                                     [&](const auto& pair) { return is_within(pair, middle, object_rad); });
    if (count <= most) continue;
    most = count;
    densest = middle;
  }
  return outside(pairs, densest, object_rad);
}

}  // namespace

SharedViewResult find_shared_view(std::span<const landmarks::Keypoint> query,
                                  std::span<const landmarks::Keypoint> place, double log10_places,
                                  const SharedViewParameters& parameters) {
  const auto pairs = pair_bearings(query, place, parameters.descriptor_ratio, parameters.same_object_deg);
  const double sigma_rad = parameters.bearing_sigma_deg * vision::kDegree;
  const double object_rad = parameters.object_deg * vision::kDegree;
  const double log10_tests = log10_places + std::log10(kModels * kAttempts);
  SharedViewResult result;
  result.matches = static_cast<int>(pairs.size());
  auto considered = pairs;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const auto best = best_motion(considered, log10_tests, sigma_rad);
    const double between = log10_expected_of(between_sky_and_vehicle(considered), best, log10_tests);
    const double without = std::max(between, without_any_object(considered, best, log10_tests, object_rad));
    if (attempt == 0 || std::max(best.consensus.log10_expected, without) <= parameters.log10_false_alarms) {
      result.agreeing = best.consensus.size;
      result.log10_expected = best.consensus.log10_expected;
      result.log10_without_object = without;
    }
    if (best.consensus.log10_expected > parameters.log10_false_alarms) break;
    if (without <= parameters.log10_false_alarms) {
      const auto final = at_any_range(best, considered, log10_tests, sigma_rad);
      result.agreeing_pairs = agreeing(considered, final);
      result.agreeing = static_cast<int>(result.agreeing_pairs.size());
      result.view = describe(final, result.agreeing_pairs, sigma_rad);
      return result;
    }
    considered = between > parameters.log10_false_alarms ? between_sky_and_vehicle(considered)
                                                         : outside_object(considered, best, object_rad);
  }
  result.reason =
      result.log10_expected > parameters.log10_false_alarms
          ? fmt::format("{} of {} matches agree, as by chance", result.agreeing, result.matches)
          : fmt::format("{} of {} matches agree, but only on one object within {:.0f} deg, or the sky and the vehicle",
                        result.agreeing, result.matches, parameters.object_deg);
  return result;
}

}  // namespace panvo::places
