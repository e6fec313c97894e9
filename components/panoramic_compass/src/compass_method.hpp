// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/panoramic_compass/panoramic_compass.hpp"

namespace panvo::panoramic_compass {

/// Interface of the compass methods.
class PanoramicCompass::Method {
 public:
  virtual ~Method() = default;
  virtual std::optional<AzimuthChange> track(std::int64_t stamp_ns, const cv::Mat& panorama,
                                             double expected_turn_rad) = 0;
  virtual void set_seen(const cv::Mat& /*seen*/) {}
  virtual void keep_earlier_points() {}
  virtual const TrackedPoints* points() const { return nullptr; }
};

std::unique_ptr<PanoramicCompass::Method> make_two_patches(const CompassParameters& parameters, std::uint64_t seed,
                                                           const Eigen::Matrix3d& base_from_panorama,
                                                           vision::StageObserver* observer);
std::unique_ptr<PanoramicCompass::Method> make_all_round(const CompassParameters& parameters, std::uint64_t seed,
                                                         const Eigen::Matrix3d& base_from_panorama,
                                                         vision::StageObserver* observer);

/// Cuts the rows between two elevations from a panorama, at 1080 x 540 px and in grey.
struct BandCutter {
  static constexpr int kColumns = 1080, kRows = 540;
  static constexpr double kRowsPerDegree = kRows / 180.0;

  int first_row = 0;
  int rows = 0;

  /// Degrees above and below the horizon; makes `rows` even.
  static BandCutter between(double top_deg, double bottom_deg);

  /// Returns CV_8UC1, kColumns x rows; shares the pixels if possible. The panorama must have passed find_fault().
  cv::Mat cut(const cv::Mat& panorama) const;
};

}  // namespace panvo::panoramic_compass
