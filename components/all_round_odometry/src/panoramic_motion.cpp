// SPDX-License-Identifier: Apache-2.0
#include "panvo/all_round_odometry/panoramic_motion.hpp"

#include <algorithm>
#include <climits>
#include <cmath>
#include <vector>

namespace panvo::all_round_odometry {
namespace {

constexpr double kLeastWay_m = 0.3;     // at standstill, distances are not learned anyway
constexpr int kMinAgreeing = 20;        // points: fewer may agree by chance
constexpr double kMinShare = 0.25;      // of the points; the rest are moving objects and wrong distances
constexpr double kMaxWaySigma_m = 0.5;  // of a step: a larger one is of no use
constexpr std::ptrdiff_t kEnough = 40;  // points of known distance for the scale
constexpr int kNotRanked = INT_MAX;     // generation of a reference whose points have no distances yet
constexpr double kKnown = 0.01;         // share of the variance of a point of which nothing is known
constexpr double kContradicts = 4.0;    // standard deviations
constexpr int kMaxContradicted = 3;     // in a row: the object moves, or the distance is wrong
// Sightings of a point against one reference share the error of its appearance: of n sightings, n / 4 count.
constexpr double kAlike = 4.0;
// Relative error of all distances alike: lens, stitching and the measured motion.
constexpr double kScaleSigma = 0.005;
// Of the uncertainty of the first motion that a new reference shows, the share that its distances keep, because they
// are learned from several.
constexpr double kKept = 0.5;

/// The estimate after another sighting of the point from a known pose; nullopt if that contradicts it.
std::optional<InverseDistance> updated(const InverseDistance& inverse, const Sighting& sighting,
                                       const Eigen::Isometry3d& then_from_now) {
  const auto residual = residual_of(sighting, inverse.mean, then_from_now);
  if (!residual) return std::nullopt;
  const Eigen::Matrix2d noise = kAlike * residual->measurement_covariance;
  const Eigen::Matrix2d spread = noise + inverse.variance * residual->by_inverse * residual->by_inverse.transpose();
  const Eigen::RowVector2d gain = inverse.variance * residual->by_inverse.transpose() * spread.inverse();
  if (residual->error.dot(spread.inverse() * residual->error) > kContradicts * kContradicts) return std::nullopt;
  return InverseDistance{inverse.mean - gain * residual->error, (1.0 - gain * residual->by_inverse) * inverse.variance};
}

bool is_known(const InverseDistance& inverse) { return inverse.variance < kKnown * InverseDistance{}.variance; }

}  // namespace

std::int64_t PanoramicMotion::before_ns(const PanoramaPoints& points) const {
  return goes_on(points) ? *last_ns_ : points.tracks.front().from_ns;
}

std::optional<double> PanoramicMotion::agreeing_share(const PanoramaPoints& points,
                                                      const Eigen::Isometry3d& before_from_now) const {
  if (!goes_on(points)) return std::nullopt;
  const Eigen::Isometry3d local_from_now = local_from_last_ * camera_motion(before_from_now);
  int known = 0, agreeing = 0;
  for (const PointTracks& tracks : points.tracks) {
    const auto reference = std::ranges::find(references_, tracks.from_ns, &Reference::stamp_ns);
    if (reference == references_.end()) continue;
    const Eigen::Isometry3d then_from_now = reference->camera_from_local * local_from_now;
    for (const Sighting& sighting : tracks.sightings) {
      const auto point = reference->points.find(sighting.id);
      if (point == reference->points.end() || !is_known(point->second.inverse)) continue;
      ++known;
      agreeing += updated(point->second.inverse, sighting, then_from_now).has_value();
    }
  }
  if (known < kMinAgreeing) return std::nullopt;
  return agreeing / static_cast<double>(known);
}

void PanoramicMotion::learn(const PanoramaPoints& points, const Eigen::Isometry3d& before_from_now) {
  if (!goes_on(points)) {
    references_.clear();
    last_ns_ = points.tracks.front().from_ns;
  }
  take_references(points);
  for (Reference& reference : references_) {
    reference.generation = 0;
    reference.scale_variance = kScaleSigma * kScaleSigma;
  }
  local_from_last_ = local_from_last_ * camera_motion(before_from_now);
  learn_distances(points);
}

std::optional<PanoramicStep> PanoramicMotion::measure(const PanoramaPoints& points,
                                                      const Eigen::Isometry3d& expected_before_from_now) {
  if (!goes_on(points)) return std::nullopt;
  take_references(points);
  const int leading = leading_generation(points);
  const std::vector<KnownSighting> known = known_sightings(points, leading);
  const auto found = resect(known, start_of_search(points, expected_before_from_now));
  const double needed = std::max<double>(kMinAgreeing, kMinShare * static_cast<double>(known.size()));
  if (!found || found->agreeing < needed || vision::horizontal_sigma(found->covariance) > kMaxWaySigma_m) {
    return std::nullopt;
  }
  PanoramicStep step;
  step.before_from_now = base_motion(local_from_last_.inverse() * found->local_from_now);
  step.covariance = vision::rotate_covariance(local_from_last_.linear().transpose(), found->covariance);
  step.agreeing_share = found->agreeing / static_cast<double>(known.size());
  for (const Reference& reference : references_) {
    if (reference.generation <= leading) step.scale_variance = std::max(step.scale_variance, reference.scale_variance);
  }
  rank_new_reference(leading, step);
  local_from_last_ = found->local_from_now;
  learn_distances(points);
  return step;
}

std::vector<KnownSighting> PanoramicMotion::known_sightings(const PanoramaPoints& points, int leading) const {
  std::vector<KnownSighting> known;
  for (const PointTracks& tracks : points.tracks) {
    const auto reference = std::ranges::find(references_, tracks.from_ns, &Reference::stamp_ns);
    if (reference == references_.end()) continue;
    for (const Sighting& sighting : tracks.sightings) {
      const auto point = reference->points.find(sighting.id);
      InverseDistance inverse = point == reference->points.end() ? InverseDistance{} : point->second.inverse;
      if (reference->generation > leading) inverse.variance += InverseDistance{}.variance;
      known.push_back({&sighting, inverse, &reference->camera_from_local});
    }
  }
  return known;
}

/// The expected position, with the rotation that the tracker of the points found.
Eigen::Isometry3d PanoramicMotion::start_of_search(const PanoramaPoints& points,
                                                   const Eigen::Isometry3d& expected_before_from_now) const {
  Eigen::Isometry3d start = local_from_last_ * camera_motion(expected_before_from_now);
  const auto reference = std::ranges::find(references_, points.tracks.front().from_ns, &Reference::stamp_ns);
  if (reference != references_.end()) {
    start.linear() = reference->camera_from_local.linear().transpose() * points.now_from_then.transpose();
  }
  return start;
}

/// The distances of a reference whose first motion is `step` will share a part of its error.
void PanoramicMotion::rank_new_reference(int leading, const PanoramicStep& step) {
  Reference& latest = references_.back();
  if (!latest.points.empty()) return;
  const double way_m = std::max(step.before_from_now.translation().norm(), kLeastWay_m);
  const double relative_sigma = kKept * vision::horizontal_sigma(step.covariance) / way_m;
  int last = 0;  // with few known points, those of references that are not ranked lead, too
  for (const Reference& reference : references_) {
    if (reference.generation != kNotRanked && &reference != &latest) last = std::max(last, reference.generation);
  }
  latest.generation = std::min(leading, last) + 1;
  latest.scale_variance = step.scale_variance + relative_sigma * relative_sigma;
}

/// Whether the points are those of a reference whose camera pose is known.
bool PanoramicMotion::goes_on(const PanoramaPoints& points) const {
  return last_ns_ && std::ranges::any_of(points.tracks, [this](const PointTracks& tracks) {
           return tracks.from_ns == *last_ns_ ||
                  std::ranges::find(references_, tracks.from_ns, &Reference::stamp_ns) != references_.end();
         });
}

/// The generation of references up to which distances decide on the scale: the first with enough points of known
/// distance. Distances of later ones share the errors of the motion from which they were learned.
int PanoramicMotion::leading_generation(const PanoramaPoints& points) const {
  std::ptrdiff_t known = 0;
  int generation = 0;
  for (const Reference& reference : references_) {  // with increasing generation
    if (known >= kEnough && reference.generation > generation) break;
    generation = reference.generation;
    for (const PointTracks& tracks : points.tracks) {
      if (tracks.from_ns != reference.stamp_ns) continue;
      known += std::ranges::count_if(tracks.sightings, [&](const Sighting& sighting) {
        const auto point = reference.points.find(sighting.id);
        return point != reference.points.end() && is_known(point->second.inverse);
      });
    }
  }
  return generation;
}

/// Drops references that are no longer tracked, and adds the last panorama if tracks start there.
void PanoramicMotion::take_references(const PanoramaPoints& points) {
  const auto tracks_of = [&](std::int64_t stamp_ns) {
    return std::ranges::find(points.tracks, stamp_ns, &PointTracks::from_ns) != points.tracks.end();
  };
  std::erase_if(references_, [&](const Reference& reference) { return !tracks_of(reference.stamp_ns); });
  const bool is_taken = std::ranges::find(references_, *last_ns_, &Reference::stamp_ns) != references_.end();
  if (tracks_of(*last_ns_) && !is_taken)
    references_.push_back({*last_ns_, local_from_last_.inverse(), kNotRanked, 0.0, {}});
}

/// From the pose of the panorama, which is the last one from now on.
void PanoramicMotion::learn_distances(const PanoramaPoints& points) {
  last_ns_ = points.stamp_ns;
  for (const PointTracks& tracks : points.tracks) {
    const auto reference = std::ranges::find(references_, tracks.from_ns, &Reference::stamp_ns);
    if (reference == references_.end()) continue;
    const Eigen::Isometry3d then_from_now = reference->camera_from_local * local_from_last_;
    for (const Sighting& sighting : tracks.sightings) {
      Point& point = reference->points[sighting.id];
      if (const auto better = updated(point.inverse, sighting, then_from_now)) {
        point = {*better, 0};
      } else if (++point.contradicted >= kMaxContradicted) {
        point = {};
      }
    }
  }
}

Eigen::Isometry3d PanoramicMotion::camera_motion(const Eigen::Isometry3d& of_base) const {
  return Eigen::Translation3d(-camera_) * of_base * Eigen::Translation3d(camera_);
}

Eigen::Isometry3d PanoramicMotion::base_motion(const Eigen::Isometry3d& of_camera) const {
  return Eigen::Translation3d(camera_) * of_camera * Eigen::Translation3d(-camera_);
}

}  // namespace panvo::all_round_odometry
