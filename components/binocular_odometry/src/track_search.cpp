// SPDX-License-Identifier: Apache-2.0
#include "track_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "panvo/vision/patch_template.hpp"

namespace panvo::binocular_odometry {
namespace {

using vision::PatchTemplate;

constexpr double kReachPerLevel_px = 6.0;  // half a patch: beyond, alignment may lock on to another structure
constexpr double kAstray_px = 3.0;         // deviation from the motion above which a track is searched again
constexpr double kFarOff_px = 6.0;         // deviation after that above which a track is dropped

}  // namespace

void set_disparity(Track& track, const vision::StereoMatch& match) {
  track.seen.has_disparity = true;
  track.seen.pixel.z() = match.disparity_px;
  track.seen.sigma_disparity_px = std::sqrt(kNoiseFloor_px * kNoiseFloor_px + match.variance_px2);
  track.gradient = match.gradient;
}

TrackSearch::TrackSearch(const vision::RectifiedStereo& stereo, double min_correlation, const StereoPyramids& images,
                         const vision::StereoMatcher& matcher, double disparity_offset_px, FrontEnd& front_end)
    : stereo_(stereo),
      min_correlation_(min_correlation),
      images_(images),
      matcher_(matcher),
      disparity_offset_px_(disparity_offset_px),
      front_end_(front_end) {}

TrackSearch::Split TrackSearch::search_widely(const std::vector<Track>& tracks, std::size_t count,
                                              const Eigen::Isometry3d& current_from_odom) const {
  const std::size_t stride = std::max<std::size_t>(1, tracks.size() / std::max<std::size_t>(1, count));
  Split split;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    Track track = tracks[i];
    const auto expected =
        i % stride == 0 ? expect(stereo_, track, current_from_odom * track.odom_from_host) : std::nullopt;
    const auto where = expected ? front_end_.match(track, expected->pixel) : std::nullopt;
    if (where && align(track, *expected, *where)) {
      split.found.push_back(std::move(track));
    } else {
      split.remaining.push_back(tracks[i]);
    }
  }
  for (Track& track : split.found) match_left_right(track);
  return split;
}

std::vector<Track> TrackSearch::search_nearby(Split tracks, const Eigen::Isometry3d& current_from_odom) const {
  std::vector<Track> kept;
  for (Track& track : tracks.found) {
    const auto expected = expect(stereo_, track, current_from_odom * track.odom_from_host);
    if (!expected) continue;
    const bool is_astray = (expected->pixel - track.seen.pixel.head<2>()).norm() > kAstray_px;
    if (!is_astray || find(track, *expected)) kept.push_back(std::move(track));
  }
  for (Track& track : tracks.remaining) {
    const auto expected = expect(stereo_, track, current_from_odom * track.odom_from_host);
    if (expected && find(track, *expected)) kept.push_back(std::move(track));
  }
  std::sort(kept.begin(), kept.end(), [](const Track& a, const Track& b) { return a.id < b.id; });
  return kept;
}

/// A prediction by the measured motion is accurate to about a pixel: full resolution finds nearly all tracks, half
/// resolution the rest.
bool TrackSearch::find(Track& track, const ExpectedPatch& expected) const {
  if (!align(track, expected, {expected.pixel, 0}) && !align(track, expected, {expected.pixel, 1})) return false;
  if ((track.seen.pixel.head<2>() - expected.pixel).norm() > kFarOff_px) return false;
  match_left_right(track);
  return true;
}

/// From coarse to fine; levels where alignment fails (near the border, no texture) are skipped.
bool TrackSearch::align(Track& track, const ExpectedPatch& expected, const SearchStart& where) const {
  const vision::ImagePyramid& left = *images_.left;
  const Eigen::Matrix2d host_from_current = expected.current_from_host.inverse();
  Eigen::Vector2d pixel = where.pixel;
  for (int level = std::min(where.level, left.levels() - 1); level >= 0; --level) {
    const double scale = 1 << level;
    const auto patch = PatchTemplate::sample((*track.host)[level], track.host_pixel / scale, host_from_current);
    const auto found = patch
                           ? patch->align(left[level], pixel / scale, PatchTemplate::Search::kPlane, kReachPerLevel_px)
                           : std::nullopt;
    if (found) pixel = found->position * scale;
    if (level > 0) continue;
    if (!found || found->correlation < min_correlation_) return false;
    track.seen.sigma_px = std::sqrt(kNoiseFloor_px * kNoiseFloor_px + 0.5 * found->variance.sum());
  }
  track.seen.pixel.head<2>() = pixel;
  track.seen.pixel.z() = expected.disparity_px + disparity_offset_px_;
  track.gradient = expected.gradient;
  return true;
}

void TrackSearch::match_left_right(Track& track) const {
  const Eigen::Vector2d pixel = track.seen.pixel.head<2>();
  const auto match = matcher_.refine(*images_.left, images_.right, pixel, track.seen.pixel.z(), track.gradient);
  track.seen.has_disparity = match.has_value();
  if (match) set_disparity(track, *match);
}

}  // namespace panvo::binocular_odometry
