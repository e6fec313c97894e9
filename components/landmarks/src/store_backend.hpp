// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/landmarks/stored_run.hpp"
#include "stored_landmark.hpp"

namespace panvo::landmarks {

/// The rows of a landmark store: what a kind of store must provide. LandmarkStore does the rest. Functions throw
/// StoreError.
class StoreBackend {
 public:
  enum class Parts { kDescription, kAll };  ///< kAll: with keypoints and thumbnail
  using Uses = std::map<std::uint32_t, LandmarkUse>;

  StoreBackend() = default;
  StoreBackend(const StoreBackend&) = delete;
  StoreBackend& operator=(const StoreBackend&) = delete;
  virtual ~StoreBackend() = default;

  /// Runs `action` in one transaction that other writers see whole or not at all. An exception rolls it back. Where a
  /// connection is lost, `action` runs again.
  virtual void transact(const std::function<void()>& action) = 0;
  /// Sets the longest wait for locks of other processes on a file.
  virtual void wait_for_locks(int) noexcept {}
  /// Runs `action`, which only reads, on one state of the store.
  virtual void read_one_state(const std::function<void()>& action) const = 0;

  // Within transact() only.
  /// The next free id; no other writer gets it.
  virtual std::int64_t next_id() = 0;
  /// Others add no landmarks before the transaction ends.
  virtual void keep_others_out() = 0;
  /// Whether the id is taken; another writer cannot take it before the transaction ends.
  virtual bool is_taken(std::int64_t id) = 0;
  virtual void insert(const StoredLandmark& landmark) = 0;
  virtual void set_pose(const StoredPose& pose) = 0;  ///< ignores unknown ids, like the next two
  virtual void erase(std::int64_t id) = 0;
  virtual void put_use(std::int64_t id, const LandmarkUse& use) = 0;
  /// The use of a landmark, which no other writer changes before the transaction ends.
  virtual LandmarkUse use_to_change(std::int64_t id) = 0;

  /// Keeps a run without its ids, unless it is kept already; forgets those that have ended. Returns false if the rights
  /// for it are missing.
  virtual bool put_run(const StoredRun& run) = 0;
  /// Keeps the id of a landmark in a run that is kept.
  virtual void put_run_id(const std::string& run, std::int64_t in_run, std::int64_t in_store) = 0;
  /// Keeps how many drives had missed a landmark before a run that is kept, unless that is kept already.
  virtual void put_missed(const std::string& run, std::int64_t id, std::int64_t missed) = 0;

  /// The number of a run that begins now. A server never gives it twice.
  virtual std::uint32_t next_session() = 0;

  virtual DescriptionSettings settings() const = 0;
  virtual Uses uses() const = 0;
  virtual std::vector<StoredRun> runs() const = 0;  ///< that are kept
  virtual std::size_t size() const = 0;
  /// The highest id up to interfaces::kMaxLandmarkId that is taken or that was given; 0: none.
  virtual std::int64_t last_id() const = 0;
  /// In order of ids.
  virtual void for_each(Parts parts, const std::function<void(const StoredLandmark&)>& visit) const = 0;
  virtual Bytes keypoints(std::uint32_t id) const = 0;  ///< empty for an unknown id, like the next
  virtual Bytes thumbnail(std::uint32_t id) const = 0;
  virtual std::uint64_t keypoint_count() const = 0;
  virtual StoredBytes stored_bytes() const = 0;
  /// Damage beneath the rows; empty if there is none.
  virtual std::string damage() const = 0;
  /// Whether several processes may write at once.
  virtual bool is_shared() const noexcept = 0;
};

/// As the constructors of LandmarkStore.
std::unique_ptr<StoreBackend> open_sqlite(const std::string& file, const DescriptionSettings* settings);
std::unique_ptr<StoreBackend> open_postgres(const StoreLocation& location, const DescriptionSettings* settings,
                                            const StorePatience& patience);
/// Whether a database contains a store.
bool has_store(const StoreLocation& location, const StorePatience& patience);

}  // namespace panvo::landmarks
