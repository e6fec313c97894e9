// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace panvo::landmarks {

struct SavedCopy {
  std::filesystem::path file;
  std::size_t landmarks = 0;
};

/// Copies a store file, which may be in use, beside it under a name with the time: "<stem>_<UTC>Z<suffix>". Blocks
/// until the copy is on disk. Throws StoreError; then nothing is left behind.
SavedCopy save_beside(const std::filesystem::path& file, std::int64_t time_ns);

}  // namespace panvo::landmarks
