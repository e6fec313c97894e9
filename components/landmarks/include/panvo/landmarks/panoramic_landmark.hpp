// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace panvo::landmarks {

/// A selected row of the measurement matrix, weighted by its Hellinger distance [Lu2015 Eq. 8].
struct AdaptiveFeature {
  std::uint16_t row = 0;  ///< with n matrix rows: 0 to n - 1 intensity, n to 2n - 1 SURF statistics
  float value = 0;        ///< the landmark's normalised response
  float scale = 1;        ///< spread of the response, the divisor of differences [Lu2015 Eq. 11]
  float weight = 0;       ///< h, the Hellinger distance between the responses at the place and around it, [0, 1]

  bool operator==(const AdaptiveFeature&) const = default;
};

/// A SIFT feature of the landmark's panorama: its bearing, and its position if known.
struct Keypoint {
  Eigen::Vector3f bearing = Eigen::Vector3f::UnitZ();  ///< unit, panorama frame
  float size_px = 0;                                   ///< diameter in the panorama of 1080 columns
  std::array<std::uint8_t, 128> descriptor{};
  bool has_point = false;                                       ///< the two fields below are valid
  Eigen::Vector3f point_in_panorama = Eigen::Vector3f::Zero();  ///< m, panorama frame
  float inverse_range_sigma = 0;                                ///< 1/m

  bool operator==(const Keypoint&) const = default;
};

/// Appearance of a place: all levels of its description except the SIFT features [Lu2015 4.2].
struct PanoramaDescription {
  std::vector<float> histogram;        ///< H, fraction of pixels per intensity bin, sum 1
  std::vector<AdaptiveFeature> large;  ///< F_l, by descending weight
  std::vector<AdaptiveFeature> small;  ///< F_s, by descending weight

  bool operator==(const PanoramaDescription&) const = default;
};

/// Sizes of the measurement matrices and of the histogram.
struct DescriptionLimits {
  std::size_t rows = std::numeric_limits<std::size_t>::max();  ///< intensity and SURF rows together
  std::optional<std::size_t> bins;                             ///< of the histogram; nullopt: any
};

/// Whether all rows exist in the matrix and the histogram has the right length. Comparisons do not check this again.
bool fits(const PanoramaDescription& description, const DescriptionLimits& limits);

/// A place that can be recognised at any heading: its pose and its appearance.
struct PanoramicLandmark {
  std::uint32_t id = 0;  ///< 1, 2, ... within a library, up to interfaces::kMaxLandmarkId; 0: not yet assigned
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  /// Of map_from_base; order and axes as in ROS PoseWithCovariance: x y z [m], rotations about the map's x y z [rad].
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
  bool is_junction = false;  ///< false: added by the distance rule
  PanoramaDescription description;
  std::vector<Keypoint> keypoints;      ///< S
  std::vector<std::uint8_t> thumbnail;  ///< JPEG, 540x270, for display; may be empty
};

/// Current pose of a landmark.
struct LandmarkPose {
  std::uint32_t id = 0;
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

}  // namespace panvo::landmarks
