// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

namespace panvo::runtime {

struct ShmLeftovers {
  std::size_t segments = 0;
  std::uintmax_t bytes = 0;
};

/// Removes shared memory for images left by killed processes, which Fast DDS 2.9 does not remove. A segment is removed
/// if its lock file (`fast_datasharing_ID_el`, locked by the owner for its lifetime) is not locked and it is older than
/// 5 s, to spare segments under creation. Segments that cannot be removed (other users) are skipped silently.
ShmLeftovers remove_shm_leftovers(const std::filesystem::path& folder = "/dev/shm");

}  // namespace panvo::runtime
