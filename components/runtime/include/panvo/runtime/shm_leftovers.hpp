// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

namespace panvo::runtime {

struct ShmLeftovers {
  std::size_t segments = 0;
  std::uintmax_t bytes = 0;
};

/// Removes shared memory for images left by killed processes, which Fast DDS 2.9 does not remove. The segments of a DDS
/// participant are removed if its mark (the file `fast_datasharing_PARTICIPANT_el`, locked by the owner for its lifetime)
/// is not locked and is older than 5 s, to spare marks under creation. Segments without a mark are of other programs.
/// Segments that cannot be removed (other users) are skipped silently.
ShmLeftovers remove_shm_leftovers(const std::filesystem::path& folder = "/dev/shm");

}  // namespace panvo::runtime
