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

/// One chosen row of the measurement matrix, with what Hellinger's distance says it is worth [Lu2015 Eq. 8].
struct AdaptiveFeature {
  std::uint16_t row = 0;  ///< below the matrix's rows: its intensity; that much more: its SURF statistics
  float value = 0;        ///< the landmark's normalised response
  float scale = 1;        ///< spread of the response: what differences are divided by [Lu2015 Eq. 11]
  float weight = 0;       ///< h, the Hellinger distance between the responses at the place and around it, [0, 1]

  bool operator==(const AdaptiveFeature&) const = default;
};

/// A SIFT feature of the landmark's panorama: where it is seen, and where it stands if that could be found out.
struct Keypoint {
  Eigen::Vector3f bearing = Eigen::Vector3f::UnitZ();  ///< unit, panorama frame
  float size_px = 0;                                   ///< diameter in the panorama of 1080 columns
  std::array<std::uint8_t, 128> descriptor{};
  bool has_point = false;                                       ///< the two below are known
  Eigen::Vector3f point_in_panorama = Eigen::Vector3f::Zero();  ///< m, panorama frame
  float inverse_range_sigma = 0;                                ///< 1/m

  bool operator==(const Keypoint&) const = default;
};

/// How a place looks: all levels of its description but the SIFT features [Lu2015 4.2].
struct PanoramaDescription {
  std::vector<float> histogram;        ///< H, shares of the intensities, sum 1
  std::vector<AdaptiveFeature> large;  ///< F_l, by descending weight
  std::vector<AdaptiveFeature> small;  ///< F_s, by descending weight

  bool operator==(const PanoramaDescription&) const = default;
};

/// How large the matrices and histograms are that descriptions are compared by.
struct DescriptionLimits {
  std::size_t rows = std::numeric_limits<std::size_t>::max();  ///< of both halves of a measurement matrix
  std::optional<std::size_t> bins;                             ///< of the histogram; none: any
};

/// Whether every row is one of the matrix, and the histogram of its length: what is compared without looking again.
bool fits(const PanoramaDescription& description, const DescriptionLimits& limits);

/// A place that can be recognised from any heading: where it is and how it looks.
struct PanoramicLandmark {
  std::uint32_t id = 0;  ///< 1, 2, ... within a library; 0: in none yet
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  /// Of map_from_base, order and axes as in ROS's PoseWithCovariance: x y z [m], rotations about the map's x y z [rad].
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
  bool is_junction = false;  ///< else it is here by the distance rule
  PanoramaDescription description;
  std::vector<Keypoint> keypoints;      ///< S
  std::vector<std::uint8_t> thumbnail;  ///< JPEG, 540x270, so that people can see the place; may be empty
};

}  // namespace panvo::landmarks
