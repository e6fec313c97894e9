// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "panvo/landmarks/landmark_store.hpp"

namespace panvo::landmarks {

/// Comes before the first landmark that the run adds.
struct BegunRun {
  StoredRun run;
  DescriptionSettings settings;
};
struct NewLandmark {
  PanoramicLandmark landmark;
  DescriptionSettings settings;
  std::optional<LandmarkUse> use;
};
struct MovedLandmarks {
  std::vector<LandmarkPose> poses;
};
struct RemovedLandmark {
  std::uint32_t id = 0;
};
struct PassedLandmarks {
  std::vector<LandmarkPass> passes;
};

/// A change of a store, made by one transaction.
using StoreChange = std::variant<BegunRun, NewLandmark, MovedLandmarks, RemovedLandmark, PassedLandmarks>;

/// Ids of landmarks in a store, by those that a run knows them by.
struct StoredIds {
  /// A new landmark with an id up to this one may get another: its own may be that of a record that cannot be read, or of
  /// another robot's landmark in a database. Beyond, a taken id is an error: a second process writes to the file.
  std::uint32_t last_known = 0;
  std::map<std::uint32_t, std::uint32_t> known;  ///< 0: not in the store; those that are missing are the same there

  std::uint32_t of(std::uint32_t id) const;
  /// A landmark that is not in the store, or no longer: later changes leave alone whichever has its id there.
  void forget(std::uint32_t id) { known.insert_or_assign(id, 0); }
};

/// Makes the change, and remembers under which id a new landmark is stored.
void apply(const StoreChange& change, LandmarkStore& store, StoredIds& ids);

/// Changes that wait for a server, in order. A landmark is moved once, to its latest pose. Not thread-safe.
class PendingChanges {
 public:
  /// `most`: landmarks, removals and passes that may wait; more are refused. Poses are always taken: there is at most one
  /// for each landmark.
  explicit PendingChanges(std::size_t most) : most_(most) {}

  bool push(StoreChange change);
  /// The oldest, to be made now: it still counts until done() is called. Null if there is none.
  std::shared_ptr<const StoreChange> take();
  void done() { current_.reset(); }

  /// Without a run that has begun, of which nothing is lost.
  std::size_t size() const;
  /// Changes that came while there was no room.
  std::uint64_t refused() const noexcept { return refused_; }

 private:
  void push_poses(MovedLandmarks moved);

  std::size_t most_;
  std::size_t weight_ = 0;  // of those that wait
  std::uint64_t refused_ = 0;
  std::deque<std::shared_ptr<StoreChange>> waiting_;
  std::shared_ptr<const StoreChange> current_;
};

}  // namespace panvo::landmarks
