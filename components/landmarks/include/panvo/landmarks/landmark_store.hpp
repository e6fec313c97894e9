// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/keypoint_source.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/landmarks/store_error.hpp"

namespace panvo::landmarks {

class Database;

/// Where a landmark is by now.
struct LandmarkPose {
  std::uint32_t id = 0;
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// What all landmarks of a store take, by part.
struct StoredBytes {
  std::uint64_t pose = 0;  ///< with stamp, covariance and what else has a fixed size
  std::uint64_t histogram = 0, large = 0, small = 0;
  std::uint64_t keypoints = 0, thumbnail = 0;
  std::uint64_t file = 0;  ///< the whole file, the database's own structure included
};

/// A library of landmarks on disk, a SQLite file: what was added or moved is there when the call returns, whatever
/// happens to the process afterwards. One writes, others may read. For one thread; everything throws StoreError.
class LandmarkStore final : public KeypointSource {
 public:
  static constexpr int kLayout = 1;                  ///< of the tables, as `PRAGMA user_version`
  static constexpr int kApplicationId = 0x504e564c;  ///< "PNVL", as `PRAGMA application_id`
  static constexpr int kBusy_ms = 2000;              ///< how long to wait for another process

  /// Opens a store to read it, whatever its settings.
  explicit LandmarkStore(const std::filesystem::path& file);
  /// Opens a store to add to it; makes it if there is none. One that was made with other settings is refused, with what
  /// differs.
  LandmarkStore(const std::filesystem::path& file, const DescriptionSettings& settings);
  ~LandmarkStore() override;

  const std::filesystem::path& file() const noexcept { return file_; }
  const DescriptionSettings& settings() const noexcept { return settings_; }
  /// Throws if the store was made with other settings, naming each key that differs and both values.
  void require(const DescriptionSettings& settings) const;

  /// Returns the landmark's id: its own, or the next one if that is 0. Throws std::invalid_argument for a landmark with
  /// something that no landmark of its settings holds, StoreError for an id that is taken.
  std::uint32_t add(const PanoramicLandmark& landmark);
  /// Moves landmarks, all or none. Ids that are not there are passed over.
  void set_poses(std::span<const LandmarkPose> poses);
  /// Adds all landmarks of another store of equal settings behind the own ones, with new ids in their order, all or none;
  /// returns the first of these. Bit for bit.
  std::uint32_t append(const LandmarkStore& other);

  std::size_t size() const;
  /// All but keypoints and thumbnails, in order of ids: what a library holds. A record that no landmark of the store's settings can be is left out
  /// and told to `report`.
  std::vector<PanoramicLandmark> landmarks(const std::function<void(const std::string&)>& report = {}) const;
  /// Throws StoreError for some that are none.
  std::vector<Keypoint> keypoints(std::uint32_t id) const override;
  std::vector<std::uint8_t> thumbnail(std::uint32_t id) const;
  /// The number of keypoints of all landmarks together.
  std::uint64_t keypoint_count() const;
  StoredBytes stored_bytes() const;

  /// Reads the whole file, each landmark in it too, and tells what is damaged; nullopt when it is sound.
  std::optional<std::string> find_damage() const;

 private:
  template <class Action>
  decltype(auto) guarded(Action action) const;  // DatabaseError to StoreError

  void prepare(const DescriptionSettings& settings);
  void read_settings();
  std::uint32_t insert(const PanoramicLandmark& landmark);

  std::filesystem::path file_;
  std::unique_ptr<Database> database_;
  DescriptionSettings settings_;
};

}  // namespace panvo::landmarks
