// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/landmark_use.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/landmarks/store_error.hpp"
#include "panvo/landmarks/store_location.hpp"
#include "panvo/landmarks/stored_run.hpp"

namespace panvo::landmarks {

class StoreBackend;

/// Bytes used by all landmarks of a store together, by part.
struct StoredBytes {
  std::uint64_t pose = 0;  ///< includes stamp, covariance and all other fields of fixed size
  std::uint64_t histogram = 0, large = 0, small = 0;
  std::uint64_t keypoints = 0, thumbnail = 0;
  std::uint64_t file = 0;  ///< the whole file, or all tables, including the database structure
};

/// What to do with a landmark whose id is taken.
enum class IfTaken {
  kRefuse,  ///< throw StoreError: another process writes to a store that is not shared
  kNextId,  ///< give it the next free id; in a database always, so that no id is given twice, not even a removed one's
};

/// Landmarks in an SQLite file, or in a PostgreSQL database. Changes are on disk when the call returns, whole or not at
/// all. One process may write to a file while others read; any number may write to a database, of which no two get the
/// same id. Not thread-safe; every function may throw StoreError.
class LandmarkStore {
 public:
  static constexpr int kLayout = 1;                  ///< version of the tables, in a file `PRAGMA user_version`
  static constexpr int kApplicationId = 0x504e564c;  ///< "PNVL", as `PRAGMA application_id`
  static constexpr int kBusy_ms = 2000;              ///< timeout for locks of other processes on a file

  /// Opens a store read-only, whatever its settings.
  explicit LandmarkStore(const StoreLocation& location, const StorePatience& patience = {});
  /// Opens a store to add to it; creates the file, or the tables in the database, if they do not exist. Throws if the
  /// store was created with other settings.
  LandmarkStore(const StoreLocation& location, const DescriptionSettings& settings, const StorePatience& patience = {});
  ~LandmarkStore();
  LandmarkStore(const LandmarkStore&) = delete;
  LandmarkStore& operator=(const LandmarkStore&) = delete;

  /// Whether there is a file, or a database contains a store.
  static bool exists(const StoreLocation& location, const StorePatience& patience = {});

  /// File name or location of the database, without a password.
  const std::string& name() const noexcept { return name_; }
  const DescriptionSettings& settings() const noexcept { return settings_; }
  /// Throws if the store was made with other settings, naming each key that differs and both values.
  void require(const DescriptionSettings& settings) const;
  /// Sets the longest wait for locks of other processes on a file. Initially kBusy_ms; for a database, without effect.
  void wait_for_locks(int limit_ms) noexcept;

  /// Returns the landmark's id: its own, or the next free one if that is 0. Throws std::invalid_argument for a landmark
  /// that breaks the rules of its settings, StoreError if the id is taken. Keeps `use` with it, if given.
  std::uint32_t add(const PanoramicLandmark& landmark, IfTaken if_taken = IfTaken::kRefuse,
                    const std::optional<LandmarkUse>& use = {});
  /// Updates landmark poses in one transaction. Unknown ids are ignored.
  void set_poses(std::span<const LandmarkPose> poses);
  /// Removes landmarks in one transaction. Unknown ids are ignored.
  void remove(std::span<const std::uint32_t> ids);
  /// Keeps how landmarks served, in one transaction. Unknown ids are ignored.
  void set_uses(const std::map<std::uint32_t, LandmarkUse>& uses);
  /// Adds passes to how landmarks served, in one transaction, whatever other writers add. Unknown ids are ignored.
  void count(std::span<const LandmarkPass> passes);
  /// Of the landmarks of which it is known; stores of earlier versions know of none.
  std::map<std::uint32_t, LandmarkUse> uses() const;
  /// The number of a run that begins now, counted from 1. A database gives each number once.
  std::uint32_t next_session() const;
  /// A run that has begun, with the ids of the landmarks that it added; nullopt if it has not, or was forgotten.
  std::optional<StoredRun> find_run(const std::string& id) const;
  std::vector<StoredRun> runs() const;  ///< all that are not forgotten
  /// Keeps a run, unless it has begun already, and from now on with each landmark that is added its id in the run. A file
  /// forgets all other runs, as it has one writer; a database those that have added nothing for 30 days.
  void begin_run(const StoredRun& run);
  /// Appends all landmarks of another store of equal settings in one transaction, bit by bit, with new ids in their
  /// order; returns the first new id. How they served comes along, their sessions with new numbers.
  std::uint32_t append(const LandmarkStore& other);
  /// Takes over all landmarks of another store of equal settings, with their ids and how they served, in one transaction;
  /// reads them back and compares them before it ends. Returns their number. Landmarks that are there already are an
  /// error, or replaced. Landmarks that break the rules are left out and passed to `report`; without it, they are an
  /// error.
  std::size_t become_copy_of(const LandmarkStore& other, bool replace,
                             const std::function<void(const std::string&)>& report = {});

  std::size_t size() const;
  /// The highest id, also of a record that breaks the rules, or that a database has given; 0: none.
  std::uint32_t last_id() const;
  /// Passes all landmarks without keypoints and thumbnails, in order of ids: the content of a library. `visit` may read
  /// from the store. Records that break the rules of the store's settings are skipped and passed to `report`.
  void for_each(const std::function<void(PanoramicLandmark)>& visit,
                const std::function<void(const std::string&)>& report = {}) const;
  /// The same as a list: 8 kB each.
  std::vector<PanoramicLandmark> landmarks(const std::function<void(const std::string&)>& report = {}) const;
  /// Throws StoreError if the stored keypoints are invalid.
  std::vector<Keypoint> keypoints(std::uint32_t id) const;
  std::vector<std::uint8_t> thumbnail(std::uint32_t id) const;
  /// Total number of keypoints of all landmarks.
  std::uint64_t keypoint_count() const;
  StoredBytes stored_bytes() const;
  /// Runs `action`, which only reads, on one state of the store, whatever others write to a database.
  void read_one_state(const std::function<void()>& action) const;

  /// Checks everything including every landmark and describes the damage; nullopt if there is none.
  std::optional<std::string> find_damage() const;

 private:
  std::string name_;
  std::unique_ptr<StoreBackend> backend_;
  DescriptionSettings settings_;
  std::string run_;  // empty: no ids are kept
};

}  // namespace panvo::landmarks
