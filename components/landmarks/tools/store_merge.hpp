// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace panvo::landmarks {

/// Location of one store's landmarks in the merged store: ids first, first + 1, ...
struct MergedPart {
  std::string store;
  std::size_t landmarks = 0;
  std::uint32_t first = 1;
};

/// Merges several stores of equal settings into a new one, in the given order and by id within each. `out` is written
/// under a temporary name, so it is either complete or absent. Poses are copied: the stores must share one map. Throws
/// StoreError if settings differ, `out` exists and may not be replaced, or is a server.
std::vector<MergedPart> merge_stores(const std::vector<std::string>& stores, const std::filesystem::path& out,
                                     bool replace);

}  // namespace panvo::landmarks
