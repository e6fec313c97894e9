// SPDX-License-Identifier: Apache-2.0
#include "store_writer.hpp"

#include <exception>
#include <stdexcept>
#include <utility>

#include "panvo/interfaces/place_rules.hpp"
#include "panvo/postgres/worker.hpp"

namespace panvo::landmarks {
namespace {

/// Keeps changes while another process reads the file: its lock keeps a change from being completed.
class FileWriter final : public StoreWriter {
 public:
  FileWriter(StoreLocation location, std::unique_ptr<LandmarkStore> store, StoredRun run, std::size_t most_waiting,
             int lock_ms)
      : location_(std::move(location)), store_(std::move(store)), pending_(most_waiting), lock_ms_(lock_ms) {
    if (store_) ids_.last_known = store_->last_id();
    ids_.known = run.ids;
    // Made with the first change that there is: a run that changes nothing leaves the file alone.
    if (!run.id.empty()) pending_.push(BegunRun{std::move(run), {}});
  }

  void require(const DescriptionSettings& settings) override {
    if (!store_) store_ = std::make_unique<LandmarkStore>(location_, settings);
    store_->require(settings);
  }

  bool write(StoreChange change) override {
    if (!store_) throw std::logic_error("a change of a store that was not created");
    if (is_locked_) make_pending(0);  // first, for room
    if (!pending_.push(std::move(change))) {
      if (!is_full_) tell(true, "no room for more changes while it is locked: they are lost until there is");
      is_full_ = true;
      return false;
    }
    if (!is_locked_) make_pending(lock_ms_);
    return true;
  }

  std::vector<StoreNotice> notices() override { return std::exchange(notices_, {}); }
  std::size_t waiting() const override { return is_locked_ ? pending_.size() : 0; }

  void finish() override {
    if (!is_locked_) return;
    try {
      make_pending(lock_ms_);
    } catch (const std::exception& error) {
      tell(true, error.what());
    }
    if (pending_.size() == 0) return;
    tell(true, std::to_string(pending_.size()) + " changes are lost: it was locked until the end");
  }

 private:
  void tell(bool is_error, const std::string& text) { notices_.push_back({is_error, location_.shown() + ": " + text}); }

  void make_pending(int lock_ms) {
    store_->wait_for_locks(lock_ms);
    try {
      while (current_ || (current_ = pending_.take())) {
        apply(*current_, *store_, ids_);
        drop_current();
      }
      if (is_locked_) tell(false, "is free again; all changes are stored");
      is_locked_ = is_full_ = false;
    } catch (const StoreUnavailable& error) {
      if (!is_locked_)
        notices_.push_back({true, std::string(error.what()) + ". Changes are kept in memory until then"});
      is_locked_ = true;
    } catch (const std::exception&) {
      drop_current();  // it would fail again
      throw;
    }
  }

  void drop_current() {
    current_.reset();
    pending_.done();
  }

  const StoreLocation location_;
  std::unique_ptr<LandmarkStore> store_;
  StoredIds ids_;
  PendingChanges pending_;
  std::shared_ptr<const StoreChange> current_;  // of these, until it is made
  std::vector<StoreNotice> notices_;
  const int lock_ms_;
  bool is_locked_ = false;  // when a change was tried last
  bool is_full_ = false;
};

/// Keeps changes until a thread has brought them to the server. The worker's lock guards what both threads use.
class ServerWriter final : public StoreWriter {
 public:
  ServerWriter(StoreLocation location, std::optional<DescriptionSettings> settings, StorePatience patience,
               StoredRun run, std::size_t most_waiting)
      : location_(std::move(location)), patience_(std::move(patience)), run_(std::move(run)), pending_(most_waiting) {
    ids_.known = run_.ids;
    patience_.pause = [this](int attempt, const std::string& problem) { return pause(attempt, problem); };
    worker_ = std::make_unique<postgres::Worker>([this] { return step(); });
    if (settings) begin(*settings);
  }

  void require(const DescriptionSettings& settings) override {
    if (!settings_) begin(settings);  // another robot may be faster: seen when the first landmark is stored
    const auto found = differences(*settings_, settings);
    if (found.empty()) return;
    throw StoreError(location_.shown() + ": its landmarks were described with other settings: " + found.front() +
                     ". Use the settings of the store, or another database");
  }

  bool write(StoreChange change) override {
    bool is_taken = false;
    worker_->locked([&] {
      if (has_failed_) return;
      is_taken = pending_.push(std::move(change));
      if (is_taken || is_full_) return;
      is_full_ = true;
      tell(true, "no room for more changes while the server does not answer: they are lost until there is");
    });
    worker_->wake();
    return is_taken;
  }

  std::vector<StoreNotice> notices() override {
    std::vector<StoreNotice> told;
    worker_->locked([&] { told.swap(notices_); });
    return told;
  }

  std::vector<std::pair<std::string, std::string>> diagnostics() const override {
    std::vector<std::pair<std::string, std::string>> values;
    worker_->locked([&] {
      values = {{"store", location_.shown()},
                {"changes waiting", std::to_string(pending_.size())},
                {"changes stored", std::to_string(stored_)},
                {"changes lost", std::to_string(pending_.refused() + lost_)},
                {"store problem", problem_}};
    });
    return values;
  }

  void finish() override {
    if (worker_->finish(kFinish_ms)) return;
    worker_->locked([&] {
      lost_ += pending_.size();
      tell(true, std::to_string(pending_.size()) + " changes are lost: the server did not take them before the end");
    });
  }

 private:
  void tell(bool is_error, const std::string& text) { notices_.push_back({is_error, location_.shown() + ": " + text}); }

  /// The run is kept at once, not with its first landmark: until then, others may have added some.
  void begin(const DescriptionSettings& settings) {
    settings_ = settings;
    if (run_.id.empty()) return;
    worker_->locked([&] { pending_.push(BegunRun{run_, settings}); });
    worker_->wake();
  }

  // What follows runs on the worker's thread.
  bool step() {
    std::shared_ptr<const StoreChange> change;
    worker_->locked([&] { change = has_failed_ ? nullptr : pending_.take(); });
    if (!change) return false;
    for (int attempt = 0;; ++attempt) {
      try {
        make(*change);
        worker_->locked([&] { ended_well(*change); });
        return true;
      } catch (const StoreUnavailable& error) {
        if (!pause(attempt, error.what())) return false;
      } catch (const StoreError& error) {
        worker_->locked([&] { has_failed_ = true; });
        return give_up(*change, std::string(error.what()) + ". No more landmarks will be stored");
      } catch (const std::exception& error) {
        return give_up(*change, error.what() + std::string(": not stored"));
      }
    }
  }

  void make(const StoreChange& change) {
    if (!store_) {
      const auto* begun = std::get_if<BegunRun>(&change);
      const auto* landmark = std::get_if<NewLandmark>(&change);
      const auto settings = begun      ? begun->settings
                            : landmark ? landmark->settings
                                       : LandmarkStore(location_, patience_).settings();
      store_ = std::make_unique<LandmarkStore>(location_, settings, patience_);
    }
    apply(change, *store_, ids_);
  }

  void ended_well(const StoreChange& change) {
    pending_.done();
    if (!std::holds_alternative<BegunRun>(change)) ++stored_;
    is_full_ = false;
    if (!problem_.empty())
      tell(false, "the server answers again; " + std::to_string(pending_.size()) + " changes wait");
    problem_.clear();
  }

  bool give_up(const StoreChange& change, const std::string& why) {
    if (const auto* lost = std::get_if<NewLandmark>(&change)) ids_.forget(lost->landmark.id);
    worker_->locked([&] {
      pending_.done();
      ++lost_;
      notices_.push_back({true, why});
    });
    return true;
  }

  bool pause(int attempt, const std::string& problem) {
    worker_->locked([&] {
      if (problem_.empty()) {
        notices_.push_back({true, problem + ". Landmarks are kept in memory until it answers"});
      }
      problem_ = problem;
    });
    return worker_->pause(postgres::backoff_ms(attempt));
  }

  const StoreLocation location_;
  std::optional<DescriptionSettings> settings_;
  StorePatience patience_;
  const StoredRun run_;
  std::unique_ptr<LandmarkStore> store_;           // used by the worker only, like the ids
  StoredIds ids_{interfaces::kMaxLandmarkId, {}};  // others give ids, too
  PendingChanges pending_;
  std::vector<StoreNotice> notices_;
  std::string problem_;  // of the last attempt; empty: none
  std::uint64_t stored_ = 0, lost_ = 0;
  bool has_failed_ = false;  // of such an error that repetition does not help
  bool is_full_ = false;
  std::unique_ptr<postgres::Worker> worker_;  // ends first
};

}  // namespace

std::unique_ptr<StoreWriter> write_to_file(const StoreLocation& location, std::unique_ptr<LandmarkStore> store,
                                           StoredRun run, std::size_t most_waiting, int lock_ms) {
  return std::make_unique<FileWriter>(location, std::move(store), std::move(run), most_waiting, lock_ms);
}

std::unique_ptr<StoreWriter> write_to_server(const StoreLocation& location,
                                             const std::optional<DescriptionSettings>& settings,
                                             const StorePatience& patience, StoredRun run, std::size_t most_waiting) {
  return std::make_unique<ServerWriter>(location, settings, patience, std::move(run), most_waiting);
}

}  // namespace panvo::landmarks
