// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_store.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "landmark_rules.hpp"
#include "record_bytes.hpp"
#include "store_backend.hpp"

namespace panvo::landmarks {
namespace {

std::string numbered(std::int64_t id) { return "landmark " + std::to_string(id) + ": "; }

/// Unless it breaks the rules: those of its settings, and of values that none has.
std::optional<PanoramicLandmark> valid_landmark(const StoredLandmark& stored, const DescriptionSettings& settings,
                                                std::string& problem) {
  try {
    auto landmark = from_stored(stored);
    if (const auto found = problem_of(landmark, settings)) {
      problem = numbered(stored.id) + *found;
      return std::nullopt;
    }
    return landmark;
  } catch (const std::range_error& error) {
    problem = numbered(stored.id) + error.what();
    return std::nullopt;
  }
}

/// The keypoints, or the reason why they are none.
std::optional<std::vector<Keypoint>> valid_keypoints(std::int64_t id, const Bytes& bytes, std::string& problem) {
  auto keypoints = keypoints_from(bytes);
  const auto found = keypoints ? problem_of(*keypoints) : "keypoints are truncated or not finite";
  if (!found) return keypoints;
  problem = numbered(id) + *found;
  return std::nullopt;
}

std::string copy_problem(const StoredLandmark& stored, const DescriptionSettings& settings) {
  std::string problem;
  const auto landmark = valid_landmark(stored, settings, problem);
  if (landmark) valid_keypoints(stored.id, stored.keypoints, problem);
  return problem;
}

/// Adds one landmark with its use; returns its id.
std::uint32_t add_row(StoreBackend& backend, const std::string& name, StoredLandmark row, IfTaken if_taken,
                      const std::optional<LandmarkUse>& use) {
  // Where others write, a free id may be that of a landmark which was removed: those who still know it would move the
  // new one instead.
  const bool gets_next = if_taken == IfTaken::kNextId && (backend.is_shared() || backend.is_taken(row.id));
  if (row.id == 0 || gets_next) {
    row.id = backend.next_id();
  } else if (backend.is_taken(row.id)) {
    throw StoreError(name + ": already contains landmark " + std::to_string(row.id) +
                     "; is another process writing to it? Use one file per run");
  }
  backend.insert(row);
  if (use) backend.put_use(row.id, *use);
  return static_cast<std::uint32_t>(row.id);
}

/// Before a copy.
void clear(StoreBackend& backend, const std::string& name, bool is_allowed) {
  backend.keep_others_out();
  std::vector<std::int64_t> old;
  backend.for_each(StoreBackend::Parts::kDescription, [&](const auto& row) { old.push_back(row.id); });
  if (!old.empty() && !is_allowed) {
    throw StoreError(name + ": already contains " + std::to_string(old.size()) +
                     " landmarks; name an empty one or pass --overwrite");
  }
  for (const auto id : old) backend.erase(id);
}

}  // namespace

LandmarkStore::LandmarkStore(const StoreLocation& location, const StorePatience& patience)
    : name_(location.shown()),
      backend_(location.is_server() ? open_postgres(location, nullptr, patience)
                                    : open_sqlite(location.text(), nullptr)),
      settings_(backend_->settings()) {}

LandmarkStore::LandmarkStore(const StoreLocation& location, const DescriptionSettings& settings,
                             const StorePatience& patience)
    : name_(location.shown()),
      backend_(location.is_server() ? open_postgres(location, &settings, patience)
                                    : open_sqlite(location.text(), &settings)),
      settings_(backend_->settings()) {
  require(settings);
}

LandmarkStore::~LandmarkStore() = default;

bool LandmarkStore::exists(const StoreLocation& location, const StorePatience& patience) {
  return location.is_server() ? has_store(location, patience) : std::filesystem::exists(location.text());
}

void LandmarkStore::require(const DescriptionSettings& settings) const {
  const auto found = differences(settings_, settings);
  if (found.empty()) return;
  std::string sentence = name_ + ": its landmarks were described with other settings: ";
  for (std::size_t i = 0; i < found.size(); ++i) sentence += (i == 0 ? "" : "; ") + found[i];
  throw StoreError(sentence + ". Use the settings of the store, or another " +
                   (backend_->is_shared() ? "database" : "file"));
}

void LandmarkStore::wait_for_locks(int limit_ms) noexcept { backend_->wait_for_locks(limit_ms); }

std::uint32_t LandmarkStore::add(const PanoramicLandmark& landmark, IfTaken if_taken,
                                 const std::optional<LandmarkUse>& use) {
  if (const auto problem = problem_of(landmark, settings_))
    throw std::invalid_argument(numbered(landmark.id) + *problem);
  const auto row = to_stored(landmark);
  std::uint32_t id = 0;
  backend_->transact([&] {
    id = add_row(*backend_, name_, row, if_taken, use);
    if (!run_.empty() && landmark.id != 0) backend_->put_run_id(run_, landmark.id, id);
  });
  return id;
}

void LandmarkStore::set_poses(std::span<const LandmarkPose> poses) {
  std::map<std::int64_t, StoredPose> rows;  // in order of ids, so that two writers never wait for each other
  for (const auto& pose : poses) {
    if (const auto problem = problem_of_pose(pose.map_from_base, pose.covariance)) {
      throw std::invalid_argument(numbered(pose.id) + *problem);
    }
    rows.insert_or_assign(pose.id, to_stored(pose.id, pose.map_from_base, pose.covariance));
  }
  backend_->transact([&] {
    for (const auto& [id, row] : rows) backend_->set_pose(row);
  });
}

void LandmarkStore::remove(std::span<const std::uint32_t> ids) {
  std::vector<std::uint32_t> in_order(ids.begin(), ids.end());
  std::ranges::sort(in_order);
  backend_->transact([&] {
    for (const auto id : in_order) backend_->erase(id);
  });
}

void LandmarkStore::set_uses(const std::map<std::uint32_t, LandmarkUse>& uses) {
  backend_->transact([&] {
    for (const auto& [id, use] : uses) backend_->put_use(id, use);
  });
}

void LandmarkStore::count(std::span<const LandmarkPass> passes) {
  std::map<std::uint32_t, std::vector<LandmarkPass>> by_id;
  for (const auto& pass : passes) by_id[pass.id].push_back(pass);
  backend_->transact([&] {
    for (const auto& [id, of_one] : by_id) {
      auto use = backend_->use_to_change(id);
      if (!run_.empty()) backend_->put_missed(run_, id, use.missed);
      for (const auto& pass : of_one) panvo::landmarks::add(pass, use);
      backend_->put_use(id, use);
    }
  });
}

std::map<std::uint32_t, LandmarkUse> LandmarkStore::uses() const { return backend_->uses(); }

std::uint32_t LandmarkStore::next_session() const { return backend_->next_session(); }

std::vector<StoredRun> LandmarkStore::runs() const { return backend_->runs(); }

std::optional<StoredRun> LandmarkStore::find_run(const std::string& id) const {
  auto all = runs();
  const auto found = std::ranges::find(all, id, &StoredRun::id);
  return found == all.end() ? std::nullopt : std::optional(std::move(*found));
}

void LandmarkStore::begin_run(const StoredRun& run) {
  backend_->transact([&] { run_ = backend_->put_run(run) ? run.id : ""; });
}

std::uint32_t LandmarkStore::append(const LandmarkStore& other) {
  require(other.settings());
  std::int64_t first = 0;
  backend_->transact([&] {
    first = backend_->next_id();
    std::map<std::int64_t, std::int64_t> new_ids;
    other.read_one_state([&] {
      const auto first_session = backend_->next_session();
      auto uses = other.uses();
      other.backend_->for_each(StoreBackend::Parts::kAll, [&](const StoredLandmark& stored) {
        auto row = stored;
        row.id = first + static_cast<std::int64_t>(new_ids.size());
        new_ids.emplace(stored.id, row.id);
        backend_->insert(row);
      });
      for (const auto& [old_id, new_id] : new_ids) {
        auto use = uses[static_cast<std::uint32_t>(old_id)];
        use.session += first_session;
        backend_->put_use(new_id, use);
      }
    });
  });
  return static_cast<std::uint32_t>(first);
}

std::size_t LandmarkStore::become_copy_of(const LandmarkStore& other, bool replace,
                                          const std::function<void(const std::string&)>& report) {
  require(other.settings());
  std::map<std::int64_t, std::uint64_t> digests;
  backend_->transact([&] {
    digests.clear();
    clear(*backend_, name_, replace);
    StoreBackend::Uses uses;
    other.read_one_state([&] {
      other.backend_->for_each(StoreBackend::Parts::kAll, [&](const StoredLandmark& row) {
        if (const auto problem = copy_problem(row, settings_); !problem.empty()) {
          if (!report) throw StoreError(other.name() + ": is damaged: " + problem + "; nothing was copied");
          return report(problem);
        }
        digests.emplace(row.id, digest_of(row));
        backend_->insert(row);
      });
      uses = other.uses();
    });
    std::erase_if(uses, [&](const auto& use) { return !digests.contains(use.first); });
    for (const auto& [id, use] : uses) backend_->put_use(id, use);

    std::size_t found = 0;
    backend_->for_each(StoreBackend::Parts::kAll, [&](const StoredLandmark& row) {
      const auto digest = digests.find(row.id);
      if (digest == digests.end() || digest->second != digest_of(row)) {
        throw StoreError(name_ + ": " + numbered(row.id) + "differs from the original; nothing was copied");
      }
      ++found;
    });
    if (found != digests.size() || backend_->uses() != uses) {
      throw StoreError(name_ + ": lacks a part of the original; nothing was copied");
    }
  });
  return digests.size();
}

std::size_t LandmarkStore::size() const { return backend_->size(); }

std::uint32_t LandmarkStore::last_id() const { return static_cast<std::uint32_t>(backend_->last_id()); }

void LandmarkStore::for_each(const std::function<void(PanoramicLandmark)>& visit,
                             const std::function<void(const std::string&)>& report) const {
  backend_->for_each(StoreBackend::Parts::kDescription, [&](const StoredLandmark& row) {
    std::string problem;
    if (auto landmark = valid_landmark(row, settings_, problem)) {
      visit(std::move(*landmark));
    } else if (report) {
      report(problem);
    }
  });
}

std::vector<PanoramicLandmark> LandmarkStore::landmarks(const std::function<void(const std::string&)>& report) const {
  std::vector<PanoramicLandmark> landmarks;
  for_each([&](PanoramicLandmark landmark) { landmarks.push_back(std::move(landmark)); }, report);
  return landmarks;
}

std::vector<Keypoint> LandmarkStore::keypoints(std::uint32_t id) const {
  std::string problem;
  auto keypoints = valid_keypoints(id, backend_->keypoints(id), problem);
  if (!keypoints) throw StoreError(name_ + ": is damaged: " + problem + "; restore a copy");
  return std::move(*keypoints);
}

std::vector<std::uint8_t> LandmarkStore::thumbnail(std::uint32_t id) const { return backend_->thumbnail(id); }

std::uint64_t LandmarkStore::keypoint_count() const { return backend_->keypoint_count(); }

StoredBytes LandmarkStore::stored_bytes() const { return backend_->stored_bytes(); }

void LandmarkStore::read_one_state(const std::function<void()>& action) const { backend_->read_one_state(action); }

std::optional<std::string> LandmarkStore::find_damage() const {
  auto damage = backend_->damage();
  if (!damage.empty()) return damage;  // records of a corrupt page cannot be checked
  constexpr int kMaxTold = 3;
  int found = 0;
  const auto tell = [&](const std::string& problem) {
    if (++found <= kMaxTold) damage += (damage.empty() ? "" : "; ") + problem;
  };
  read_one_state([&] {
    for (const auto& landmark : landmarks(tell)) {
      try {
        keypoints(landmark.id);
      } catch (const StoreUnavailable&) {
        throw;
      } catch (const StoreError& error) {
        tell(error.what());
      }
    }
  });
  if (found > kMaxTold) damage += "; and " + std::to_string(found - kMaxTold) + " more";
  return damage.empty() ? std::nullopt : std::optional(std::move(damage));
}

}  // namespace panvo::landmarks
