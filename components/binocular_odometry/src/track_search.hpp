// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "front_end.hpp"
#include "panvo/vision/stereo_matcher.hpp"
#include "stereo_pyramids.hpp"
#include "track.hpp"

namespace panvo::binocular_odometry {

/// Standard deviation of a position in the image (px): interpolation, calibration, non-planar surfaces.
inline constexpr double kNoiseFloor_px = 0.15;

/// Stores a match in the right image in a track.
void set_disparity(Track& track, const vision::StereoMatch& match);

/// Search for known tracks in one frame: at positions predicted by a motion of the camera, by alignment with their
/// patches, then in the right image.
class TrackSearch {
 public:
  /// All references must outlive it. `disparity_offset_px`: known common error of the disparities.
  TrackSearch(const vision::RectifiedStereo& stereo, double min_correlation, const StereoPyramids& images,
              const vision::StereoMatcher& matcher, double disparity_offset_px, FrontEnd& front_end);

  struct Split {
    std::vector<Track> found;      ///< ascending id
    std::vector<Track> remaining;  ///< not searched or not found; ascending id
  };

  /// Searches about `count` tracks, evenly spread over the list, in a wide area: over all pyramid levels.
  Split search_widely(const std::vector<Track>& tracks, std::size_t count,
                      const Eigen::Isometry3d& current_from_odom) const;

  /// Searches the remaining tracks near the positions predicted by a known motion, and those found again that deviate
  /// from it. Returns all found, ascending id.
  std::vector<Track> search_nearby(Split tracks, const Eigen::Isometry3d& current_from_odom) const;

 private:
  bool find(Track& track, const ExpectedPatch& expected) const;
  bool align(Track& track, const ExpectedPatch& expected, const SearchStart& where) const;
  void match_left_right(Track& track) const;

  const vision::RectifiedStereo& stereo_;
  double min_correlation_;
  const StereoPyramids& images_;
  const vision::StereoMatcher& matcher_;
  double disparity_offset_px_;
  FrontEnd& front_end_;
};

}  // namespace panvo::binocular_odometry
