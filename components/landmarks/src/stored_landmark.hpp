// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "panvo/landmarks/landmark_use.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/landmarks/stored_run.hpp"
#include "record_bytes.hpp"

/// A landmark as the columns of its rows, which are the same in each kind of store.
namespace panvo::landmarks {

/// Position in m, then the quaternion x, y, z, w.
using PoseNumbers = std::array<double, 7>;

struct StoredPose {
  std::int64_t id = 0;
  PoseNumbers map_from_base{};
  Bytes covariance;
};

struct StoredLandmark {
  std::int64_t id = 0, stamp_ns = 0, is_junction = 0;
  PoseNumbers map_from_base{};
  Bytes covariance;
  PoseNumbers base_from_panorama{};
  Bytes histogram, large, small;
  std::int64_t keypoint_count = 0;  ///< these three: only if they were read, too
  Bytes keypoints, thumbnail;

  bool operator==(const StoredLandmark&) const = default;
};

/// Bytes of the columns of fixed size: id, stamp, junction, two poses.
inline constexpr std::uint64_t kFixedBytes = 8 + 8 + 1 + 2 * sizeof(PoseNumbers);

StoredPose to_stored(std::int64_t id, const Eigen::Isometry3d& map_from_base,
                     const Eigen::Matrix<double, 6, 6>& covariance);
StoredLandmark to_stored(const PanoramicLandmark& landmark);
/// Without keypoints and thumbnail. Throws std::range_error for values that no landmark has.
PanoramicLandmark from_stored(const StoredLandmark& stored);

/// A number of a column of landmark_use, which may be damaged.
std::uint32_t use_number(std::int64_t stored);

/// An id of a column that may be damaged; 0: none.
std::uint32_t id_number(std::int64_t stored);

/// A row of a run and of a landmark that it added, if it did: session, last id, id in the run, id in the store. The rows of
/// one run follow each other.
void add_run_row(std::vector<StoredRun>& runs, const std::string& run, const std::array<std::int64_t, 4>& row);

/// How often a landmark was missed before a run, if that is one of these.
void add_missed(std::vector<StoredRun>& runs, const std::string& run, std::int64_t id, std::int64_t missed);

/// A number that differs if any bit differs, to compare copies (FNV-1a).
std::uint64_t digest_of(const StoredLandmark& stored);

}  // namespace panvo::landmarks
