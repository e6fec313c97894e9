// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "panvo/landmarks/landmark_store.hpp"
#include "store_changes.hpp"

namespace panvo::landmarks {

/// Something to tell the user.
struct StoreNotice {
  bool is_error = false;
  std::string text;
};

/// Writes the changes of a run to its store.
class StoreWriter {
 public:
  StoreWriter() = default;
  StoreWriter(const StoreWriter&) = delete;
  StoreWriter& operator=(const StoreWriter&) = delete;
  virtual ~StoreWriter() = default;

  /// Throws StoreError if the store has other settings. Creates the store if there is none.
  virtual void require(const DescriptionSettings& settings) = 0;
  /// To a file: at once, or with a later change if another process holds its lock; throws StoreError, or
  /// std::invalid_argument for a landmark that breaks the rules. To a server: later, and never waits. Returns false if
  /// the change would have to wait and too many wait already: it is lost.
  virtual bool write(StoreChange change) = 0;
  /// What there was to tell since the last call.
  virtual std::vector<StoreNotice> notices() { return {}; }
  /// State, for diagnostics; may be called on another thread.
  virtual std::vector<std::pair<std::string, std::string>> diagnostics() const { return {}; }
  /// Changes that wait for another process that reads the file.
  virtual std::size_t waiting() const { return 0; }
  /// Ends writing: what cannot be stored in time is lost, which a notice tells.
  virtual void finish() {}
};

/// Longest wait of finish() for a server, in addition to that for the answer that is due.
inline constexpr int kFinish_ms = 5000;

/// `store`: opened to write, if it exists. `run`: ids that it has are those of the run before a restart. `most_waiting`: see PendingChanges. `lock_ms`: longest wait for the lock of
/// another process; while changes wait, later ones do not wait for it.
std::unique_ptr<StoreWriter> write_to_file(const StoreLocation& location, std::unique_ptr<LandmarkStore> store,
                                           StoredRun run, std::size_t most_waiting,
                                           int lock_ms = LandmarkStore::kBusy_ms);
/// `settings`: of the store, if it exists.
std::unique_ptr<StoreWriter> write_to_server(const StoreLocation& location,
                                             const std::optional<DescriptionSettings>& settings,
                                             const StorePatience& patience, StoredRun run, std::size_t most_waiting);

}  // namespace panvo::landmarks
