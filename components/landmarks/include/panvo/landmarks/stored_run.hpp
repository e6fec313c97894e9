// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

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
};

}  // namespace panvo::landmarks
