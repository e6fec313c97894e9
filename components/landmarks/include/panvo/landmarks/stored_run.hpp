// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "panvo/landmarks/landmark_use.hpp"

namespace panvo::landmarks {

/// What a store keeps of a run that stores landmarks: its ids for them outlive the process with the store, as the other
/// processes go on using them when that one is restarted.
struct StoredRun {
  std::string id;             ///< empty: nothing is kept
  std::uint32_t session = 1;  ///< see LandmarkUse
  /// The highest id in the store when the run began. It has these landmarks by the same ids, and has not heard of those
  /// that others have added since.
  std::uint32_t last_id = 0;
  std::map<std::uint32_t, std::uint32_t> ids;  ///< in the store, of the landmarks that it stored, by its own ones
  /// Drives in a row that had missed a landmark before the run began, by ids in the store, of those that it has passed.
  std::map<std::uint32_t, std::uint32_t> missed{};

  /// Its own ids of the landmarks that it stored, by those in the store.
  std::map<std::uint32_t, std::uint32_t> own_ids() const {
    std::map<std::uint32_t, std::uint32_t> own;
    for (const auto& [in_run, in_store] : ids) own.emplace(in_store, in_run);
    return own;
  }
  /// Of a stored landmark that it did not store: another robot may have added it since the run began, and the run may
  /// have its id for one of its own.
  bool may_have_other_of_id(std::uint32_t stored_id) const { return stored_id > last_id || ids.contains(stored_id); }
  /// How a stored landmark served until the run began: what this drive has missed since counts once, with the next miss.
  LandmarkUse use_before(std::uint32_t stored_id, LandmarkUse now) const {
    if (const auto found = missed.find(stored_id); found != missed.end()) now.missed = found->second;
    return now;
  }
};

}  // namespace panvo::landmarks
