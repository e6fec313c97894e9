// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace panvo::landmarks {

/// Where the landmarks of one store are in the merged one: they have the ids first, first + 1, ...
struct MergedPart {
  std::filesystem::path store;
  std::size_t landmarks = 0;
  std::uint32_t first = 1;
};

/// Writes the landmarks of several stores of equal settings, in the order given and each in order of ids, into a new one.
/// `out` is there when all is in it, or not at all: it is written under a temporary name. Poses are taken as they are: the
/// stores must be of one map. Throws StoreError: other settings, `out` is there already (unless it may be replaced).
std::vector<MergedPart> merge_stores(const std::vector<std::filesystem::path>& stores, const std::filesystem::path& out,
                                     bool replace);

}  // namespace panvo::landmarks
