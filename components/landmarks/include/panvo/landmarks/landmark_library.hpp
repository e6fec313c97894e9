// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "panvo/landmarks/landmark_source.hpp"
#include "panvo/landmarks/large_scale_index.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// Landmarks indexed by position: L{P, H, F_l, F_s, S} [Lu2015 5.1]. Distances are horizontal, as height is the least
/// accurate component of odometry and the least relevant one for a vehicle. Every returned list is in order of ids,
/// whatever the order of insertion.
///
/// Uses 2.5 kB per landmark with a source; without one, description, keypoints and thumbnail are kept in memory as well.
class LandmarkLibrary {
 public:
  struct Near {
    const PanoramicLandmark* landmark;
    double distance_m;
  };

  /// `limits`: sizes of the matrices and histograms that the landmarks will be compared with.
  explicit LandmarkLibrary(std::shared_ptr<const LandmarkSource> source = nullptr, DescriptionLimits limits = {});
  LandmarkLibrary(LandmarkLibrary&&) = default;
  LandmarkLibrary& operator=(LandmarkLibrary&&) = default;

  /// Adds a landmark and returns its id: its own, or the next free one if that is 0. Several may be at one place (see
  /// nearest). With a source, description, keypoints and thumbnail are dropped: the first two must be in the source. Throws
  /// std::invalid_argument: the id is taken or too high, the pose is not finite, or the description does not fit the
  /// limits.
  std::uint32_t add(PanoramicLandmark landmark);

  /// Updates the pose of a landmark, e.g. after an optimisation; false if the id is unknown. Throws
  /// std::invalid_argument for a pose that is not finite.
  bool set_pose(std::uint32_t id, const Eigen::Isometry3d& map_from_base,
                const Eigen::Matrix<double, 6, 6>& covariance);

  /// nullptr if the id is unknown. The address of a landmark is valid for the lifetime of the library.
  const PanoramicLandmark* find(std::uint32_t id) const;

  /// All landmarks in order of ids; valid until the next add().
  std::span<const PanoramicLandmark* const> all() const noexcept { return by_id_; }

  /// Landmarks whose base is at most `radius_m` from a position in the map, in order of ids [Lu2015 5.1, Fig. 4]. An
  /// infinite radius returns all; a negative one or NaN, none.
  std::vector<const PanoramicLandmark*> within(const Eigen::Vector3d& position, double radius_m) const;

  /// The landmark nearest to a position in the map; ties go to the lowest id. nullopt if the library is empty.
  std::optional<Near> nearest(const Eigen::Vector3d& position) const;

  /// Of the landmarks that are asked for, those most similar to a query at the large scale, about as by
  /// match_large_scale.
  LargeScaleIndex::Ranking rank(const QueryDescription& query, std::size_t count,
                                const LargeScaleIndex::Asked& is_asked) const {
    return index_.rank(query, count, is_asked);
  }

  /// The SIFT features and the description of a landmark: from the source if there is one, else from memory. Empty if
  /// the id is unknown.
  std::vector<Keypoint> keypoints(std::uint32_t id) const;
  PanoramaDescription description(std::uint32_t id) const;

  std::size_t size() const noexcept { return by_id_.size(); }
  bool empty() const noexcept { return by_id_.empty(); }
  /// One more than the highest id; never 0.
  std::uint32_t next_id() const noexcept { return by_id_.empty() ? 1 : by_id_.back()->id + 1; }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  static Cell cell_of(const Eigen::Vector3d& position);
  std::size_t index_from(std::uint32_t id) const;  // index in by_id_ of the first landmark with this id or a higher one
  void put_into_cell(const PanoramicLandmark& landmark);
  void take_from_cell(const PanoramicLandmark& landmark);

  std::shared_ptr<const LandmarkSource> source_;
  DescriptionLimits limits_;
  std::deque<PanoramicLandmark> landmarks_;  // in order of insertion
  std::vector<PanoramicLandmark*> by_id_;
  std::map<Cell, std::vector<const PanoramicLandmark*>> cells_;  // a uniform grid over the map
  LargeScaleIndex index_;
};

}  // namespace panvo::landmarks
