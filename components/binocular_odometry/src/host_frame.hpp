// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "disparity_offset.hpp"
#include "front_end.hpp"
#include "panvo/vision/stereo_matcher.hpp"
#include "stereo_pyramids.hpp"
#include "track.hpp"

namespace panvo::binocular_odometry {

/// A frame as the host of tracks: of new ones, and of those whose patch has changed too much.
class HostFrame {
 public:
  /// All references must outlive it. `odom_from_current`: pose of the frame in the dead-reckoning frame of the
  /// tracking stage.
  HostFrame(const vision::RectifiedStereo& stereo, const StereoPyramids& images, const vision::StereoMatcher& matcher,
            const DisparityOffset& offset, const Eigen::Isometry3d& odom_from_current);

  /// Takes over the tracks whose scale has changed so much that their patch is blurred or aliased.
  void renew(std::vector<Track>& tracks);

  /// Adds tracks of the features that are found in the right image; their ids begin at `first_id`, one for each
  /// feature.
  void add(std::span<const Feature> features, std::int64_t first_id, std::vector<Track>& tracks);

  const Eigen::Isometry3d& odom_from_current() const noexcept { return odom_from_current_; }
  /// Row errors of the tracks renewed and added; nullopt without vertical texture. Repeated row errors of one patch are
  /// correlated: each patch gives one, when it gets its host.
  const std::vector<std::optional<vision::RowError>>& row_errors() const noexcept { return row_errors_; }

 private:
  void host(Track& track, const vision::StereoMatch& match);

  const vision::RectifiedStereo& stereo_;
  const StereoPyramids& images_;
  const vision::StereoMatcher& matcher_;
  const DisparityOffset& offset_;
  Eigen::Isometry3d odom_from_current_;
  std::vector<std::optional<vision::RowError>> row_errors_;
};

}  // namespace panvo::binocular_odometry
