// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

namespace panvo::runtime {

struct ShmLeftovers {
  std::size_t segments = 0;
  std::uintmax_t bytes = 0;
};

/// Removes the shared memory for images that killed processes have left behind, which Fast DDS 2.9 does not. A segment goes when nobody holds the
/// lock beside it (`fast_datasharing_ID_el`, held by its owner for life) and it is some seconds old, so that one that is just being made is let be.
/// What cannot be removed (another user's) stays, without complaint.
ShmLeftovers remove_shm_leftovers(const std::filesystem::path& folder = "/dev/shm");

}  // namespace panvo::runtime
