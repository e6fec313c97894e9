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

#include "panvo/landmarks/keypoint_source.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// The landmarks that are known, found by where they are: L{P, H, F_l, F_s, S} [Lu2015 5.1]. Distances are horizontal, as
/// odometry knows the height least and a vehicle needs it least. Every list it gives is in order of ids, whatever the
/// order in which they came.
///
/// With a source for keypoints it keeps 8 kB a landmark, without one all of it.
class LandmarkLibrary {
 public:
  struct Near {
    const PanoramicLandmark* landmark;
    double distance_m;
  };

  /// `limits`: of what its landmarks will be compared with.
  explicit LandmarkLibrary(std::shared_ptr<KeypointSource> source = nullptr, DescriptionLimits limits = {});
  LandmarkLibrary(LandmarkLibrary&&) = default;
  LandmarkLibrary& operator=(LandmarkLibrary&&) = default;

  /// Takes a landmark in and returns its id: its own, or the next one if that is 0. Two may be at one place (see nearest).
  /// With a source, keypoints and thumbnail are dropped: they must be in the source.
  /// Throws std::invalid_argument: the id is taken, the pose is not finite, or the description does not fit the limits.
  std::uint32_t add(PanoramicLandmark landmark);

  /// Moves a landmark, as its position comes to be known better; false when there is none of this id. Throws
  /// std::invalid_argument for a pose that is not finite.
  bool set_pose(std::uint32_t id, const Eigen::Isometry3d& map_from_base,
                const Eigen::Matrix<double, 6, 6>& covariance);

  /// nullptr when there is none. Landmarks stay where they are in memory as long as the library lives.
  const PanoramicLandmark* find(std::uint32_t id) const;

  /// All, in order of ids; valid until the next add().
  std::span<const PanoramicLandmark* const> all() const noexcept { return by_id_; }

  /// Those whose base is at most `radius_m` from a position in the map, in order of ids [Lu2015 5.1, Fig. 4]. An infinite
  /// radius gives all; one that is negative or not a number, none.
  std::vector<const PanoramicLandmark*> within(const Eigen::Vector3d& position, double radius_m) const;

  /// The one nearest to a position in the map, of equally near ones that of the lowest id; nullopt in an empty library.
  std::optional<Near> nearest(const Eigen::Vector3d& position) const;

  /// The SIFT features of a landmark: those in memory, else those of the source.
  std::vector<Keypoint> keypoints(std::uint32_t id) const;

  std::size_t size() const noexcept { return by_id_.size(); }
  bool empty() const noexcept { return by_id_.empty(); }
  /// One more than the highest id.
  std::uint32_t next_id() const noexcept { return by_id_.empty() ? 1 : by_id_.back()->id + 1; }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  static Cell cell_of(const Eigen::Vector3d& position);
  std::size_t index_from(std::uint32_t id) const;  // in by_id_, of the first with this id or a higher one
  void put_into_cell(const PanoramicLandmark& landmark);
  void take_from_cell(const PanoramicLandmark& landmark);

  std::shared_ptr<KeypointSource> source_;
  DescriptionLimits limits_;
  std::deque<PanoramicLandmark> landmarks_;  // as they came
  std::vector<PanoramicLandmark*> by_id_;
  std::map<Cell, std::vector<const PanoramicLandmark*>> cells_;  // a uniform grid over the map
};

}  // namespace panvo::landmarks
