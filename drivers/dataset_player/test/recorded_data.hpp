// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>

namespace panvo::dataset_player::testing {

/// Folder of a recording in $PANVO_DATA, or in shared/data next to the checkout. It may not exist.
inline std::filesystem::path recorded_data(const char* name) {
  const char* root = std::getenv("PANVO_DATA");
  return (root != nullptr ? std::filesystem::path(root) : std::filesystem::path(PANVO_SHARED_DATA)) / name;
}

}  // namespace panvo::dataset_player::testing

/// Skips the test with a message if the recording is missing.
#define PANVO_NEEDS_RECORDING(path)   \
  if (!std::filesystem::exists(path)) \
  GTEST_SKIP() << (path).string() << " is missing; set PANVO_DATA to the folder of recordings"
