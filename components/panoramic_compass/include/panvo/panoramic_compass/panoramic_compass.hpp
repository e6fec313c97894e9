// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "panvo/panoramic_compass/azimuth_change.hpp"
#include "panvo/panoramic_compass/compass_parameters.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::panoramic_compass {

/// Why a panorama tells nothing of the turn, in numbers; nullopt when it may. Found are: empty, not CV_8UC1 or CV_8UC3, not twice
/// as wide as high, too small, black, saturated or constant about the horizon, and covered over more than a third of the full turn.
std::optional<std::string> find_fault(const cv::Mat& panorama);

/// An upright camera that looks where the vehicle drives: panorama axes X right, Y down, Z forward.
Eigen::Matrix3d upright_base_from_panorama();

/// The turn of the vehicle from one panorama to the next, from the panoramas alone [Lu2015 6].
class PanoramicCompass {
 public:
  /// `base_from_panorama`: rotation of the panorama's frame on the vehicle. Throws std::invalid_argument for parameters that
  /// contradict each other.
  explicit PanoramicCompass(const CompassParameters& parameters, std::uint64_t seed = 1,
                            const Eigen::Matrix3d& base_from_panorama = upright_base_from_panorama(),
                            vision::StageObserver* observer = nullptr);
  ~PanoramicCompass();
  PanoramicCompass(PanoramicCompass&&) noexcept;

  /// Panoramas (CV_8UC1 or CV_8UC3, 2:1; other sizes than 1080x540 are resized) in order of stamps. `expected_turn_rad` since the
  /// last panorama: where the search begins, 0 where it is not known. nullopt for the first that can be used, and before. A
  /// panorama of no use, or a turn that cannot be told, is a result that is not valid, with the reason.
  std::optional<AzimuthChange> track(std::int64_t stamp_ns, const cv::Mat& panorama,
                                     std::optional<double> expected_turn_rad = std::nullopt);

  class Method;

 private:
  std::unique_ptr<Method> method_;
};

}  // namespace panvo::panoramic_compass
