// SPDX-License-Identifier: Apache-2.0
#include "host_frame.hpp"

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "panvo/vision/stereo_geometry.hpp"
#include "track_search.hpp"

namespace panvo::binocular_odometry {
namespace {

constexpr double kMaxZoom = 1.5;  // of a patch relative to its host

}  // namespace

HostFrame::HostFrame(const vision::RectifiedStereo& stereo, const StereoPyramids& images,
                     const vision::StereoMatcher& matcher, const DisparityOffset& offset,
                     const Eigen::Isometry3d& odom_from_current)
    : stereo_(stereo), images_(images), matcher_(matcher), offset_(offset), odom_from_current_(odom_from_current) {}

void HostFrame::renew(std::vector<Track>& tracks) {
  const Eigen::Isometry3d current_from_odom = odom_from_current_.inverse();
  for (Track& track : tracks) {
    if (!track.seen.has_disparity) continue;
    const auto expected = expect(stereo_, track, current_from_odom * track.odom_from_host);
    const double zoom = expected ? std::sqrt(expected->current_from_host.determinant()) : 0.0;
    if (zoom < kMaxZoom && zoom > 1.0 / kMaxZoom) continue;
    const auto match = matcher_.measure(*images_.left, images_.right, track.seen.pixel.head<2>(), track.seen.pixel.z(),
                                        track.gradient);
    if (match) host(track, *match);
  }
}

void HostFrame::add(std::span<const Feature> features, std::int64_t first_id, std::vector<Track>& tracks) {
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto match = matcher_.search(*images_.left, images_.right, features[i].pixel);
    if (!match) continue;
    Track track;
    track.id = first_id + static_cast<std::int64_t>(i);
    track.seen.track_id = track.id;
    track.seen.pixel.head<2>() = features[i].pixel;
    track.seen.sigma_px = kNoiseFloor_px;
    track.descriptor = features[i].descriptor;
    host(track, *match);
    tracks.push_back(std::move(track));
  }
}

void HostFrame::host(Track& track, const vision::StereoMatch& match) {
  set_disparity(track, match);
  row_errors_.push_back(matcher_.row_error(*images_.left, images_.right, track.seen.pixel.head<2>(), match));
  track.host = images_.left;
  track.host_pixel = track.seen.pixel.head<2>();
  track.host_plane = vision::surface_plane(stereo_, offset_.without(track.seen.pixel), match.gradient);
  track.odom_from_host = odom_from_current_;
}

}  // namespace panvo::binocular_odometry
