// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "panvo/panoramic_compass/azimuth_change.hpp"
#include "panvo/panoramic_compass/compass_parameters.hpp"
#include "panvo/panoramic_compass/turn_fit.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::panoramic_compass {

/// Returns why a panorama is unusable, with figures; nullopt if it is usable. Checks for: empty, not CV_8UC1 or
/// CV_8UC3, not 2:1, too small, black, saturated or constant near the horizon, or covered over more than a third of the
/// turn.
std::optional<std::string> find_fault(const cv::Mat& panorama);

/// Mounting of an upright, forward-looking camera: panorama axes X right, Y down, Z forward.
Eigen::Matrix3d upright_base_from_panorama();

/// Points of a reference panorama, found in a later one.
struct PointTracks {
  std::int64_t from_stamp_ns = 0;  ///< of the reference
  std::vector<BearingPair> pairs;
};

/// What a panorama shows of the points of its reference and, for some time, of the reference before.
struct TrackedPoints {
  std::int64_t stamp_ns = 0;
  Eigen::Matrix3d now_from_then = Eigen::Matrix3d::Identity();  ///< rotation of the vehicle's axes since the reference
  std::vector<PointTracks> tracks;                              ///< that of the reference first
};

/// Estimates the turn of the vehicle between panoramas, from the panoramas alone [Lu2015 6].
class PanoramicCompass {
 public:
  /// `base_from_panorama`: rotation from the panorama frame to the vehicle frame; the camera may hang upside down.
  /// Throws std::invalid_argument for inconsistent parameters.
  explicit PanoramicCompass(const CompassParameters& parameters, std::uint64_t seed = 1,
                            const Eigen::Matrix3d& base_from_panorama = upright_base_from_panorama(),
                            vision::StageObserver* observer = nullptr);
  ~PanoramicCompass();
  PanoramicCompass(PanoramicCompass&&) noexcept;

  /// Processes panoramas (CV_8UC1 or CV_8UC3, 2:1; resized to 1080 x 540) in order of stamps. `expected_turn_rad`: turn
  /// since the last panorama, start of the search (default 0). Returns nullopt up to the first usable panorama,
  /// afterwards a result, which is not valid, with a reason, if the panorama is unusable or the turn cannot be
  /// determined.
  std::optional<AzimuthChange> track(std::int64_t stamp_ns, const cv::Mat& panorama,
                                     std::optional<double> expected_turn_rad = std::nullopt);

  /// From now on, ignores what the vehicle covers: 0 in `seen` (CV_8UC1, any size, for the whole panorama). Method
  /// `two_patches` does not.
  void set_seen(const cv::Mat& seen);

  /// From now on, points() has the points of the reference before, too.
  void keep_earlier_points();

  /// The points behind the last valid turn; nullptr if it was not valid, and with method `two_patches`. Valid until the
  /// next call of track().
  const TrackedPoints* points() const;

  class Method;

 private:
  std::unique_ptr<Method> method_;
  bool hangs_;  // upside down: the method gets upright pictures
};

}  // namespace panvo::panoramic_compass
