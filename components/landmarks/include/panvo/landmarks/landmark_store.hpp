// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/keypoint_source.hpp"
#include "panvo/landmarks/landmark_use.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/landmarks/store_error.hpp"

namespace panvo::sqlite {
class Database;
}

namespace panvo::landmarks {

/// Current pose of a landmark.
struct LandmarkPose {
  std::uint32_t id = 0;
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Bytes used by all landmarks of a store together, by part.
struct StoredBytes {
  std::uint64_t pose = 0;  ///< includes stamp, covariance and all other fields of fixed size
  std::uint64_t histogram = 0, large = 0, small = 0;
  std::uint64_t keypoints = 0, thumbnail = 0;
  std::uint64_t file = 0;  ///< the whole file, including the database structure
};

/// Landmarks in a SQLite file. Additions and moves are on disk when the call returns. One process may write while
/// others read. Not thread-safe; every function may throw StoreError.
class LandmarkStore final : public KeypointSource {
 public:
  static constexpr int kLayout = 1;                  ///< version of the tables, stored as `PRAGMA user_version`
  static constexpr int kApplicationId = 0x504e564c;  ///< "PNVL", as `PRAGMA application_id`
  static constexpr int kBusy_ms = 2000;              ///< timeout for locks of other processes

  /// Opens a store read-only, whatever its settings.
  explicit LandmarkStore(const std::filesystem::path& file);
  /// Opens a store to add to it; creates the file if it does not exist. Throws if the store was created with other
  /// settings.
  LandmarkStore(const std::filesystem::path& file, const DescriptionSettings& settings);
  ~LandmarkStore() override;

  const std::filesystem::path& file() const noexcept { return file_; }
  const DescriptionSettings& settings() const noexcept { return settings_; }
  /// Throws if the store was made with other settings, naming each key that differs and both values.
  void require(const DescriptionSettings& settings) const;

  /// Returns the landmark's id: its own, or the next free one if that is 0. Throws std::invalid_argument for a landmark
  /// that breaks the rules of its settings, StoreError if the id is taken.
  std::uint32_t add(const PanoramicLandmark& landmark);
  /// Updates landmark poses in one transaction. Unknown ids are ignored.
  void set_poses(std::span<const LandmarkPose> poses);
  /// Removes landmarks in one transaction. Unknown ids are ignored.
  void remove(std::span<const std::uint32_t> ids);
  /// Keeps how landmarks served, in one transaction. Unknown ids are ignored.
  void set_uses(const std::map<std::uint32_t, LandmarkUse>& uses);
  /// Of the landmarks of which it is known; stores of earlier versions know of none.
  std::map<std::uint32_t, LandmarkUse> uses() const;
  /// The number of a run that begins now, counted from 1.
  std::uint32_t next_session() const;
  /// Appends all landmarks of another store of equal settings in one transaction, bit by bit, with new ids in their
  /// order; returns the first new id. How they served comes along, their sessions with new numbers.
  std::uint32_t append(const LandmarkStore& other);

  std::size_t size() const;
  /// All landmarks without keypoints and thumbnails, in order of ids: the content of a library. Records that break the
  /// rules of the store's settings are skipped and passed to `report`.
  std::vector<PanoramicLandmark> landmarks(const std::function<void(const std::string&)>& report = {}) const;
  /// Throws StoreError if the stored keypoints are invalid.
  std::vector<Keypoint> keypoints(std::uint32_t id) const override;
  std::vector<std::uint8_t> thumbnail(std::uint32_t id) const;
  /// Total number of keypoints of all landmarks.
  std::uint64_t keypoint_count() const;
  StoredBytes stored_bytes() const;

  /// Checks the whole file including every landmark and describes the damage; nullopt if there is none.
  std::optional<std::string> find_damage() const;

 private:
  template <class Action>
  decltype(auto) guarded(Action action) const;  // translates DatabaseError to StoreError

  void prepare(const DescriptionSettings& settings);
  void read_settings();
  std::uint32_t insert(const PanoramicLandmark& landmark);
  bool has_uses() const;
  void append_uses(const LandmarkStore& other, const std::map<std::int64_t, std::int64_t>& new_ids);

  std::filesystem::path file_;
  std::unique_ptr<sqlite::Database> database_;
  DescriptionSettings settings_;
};

}  // namespace panvo::landmarks
