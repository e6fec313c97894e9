// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace panvo::test {

/// Path of the recording `name`: in $PANVO_DATA, or else in the folder shared/data beside the checkout, which is the
/// first one found beside `source` (the calling file) or one of the folders above it. The recording may not exist.
inline std::filesystem::path recorded_data(const std::string& name, const char* source = __builtin_FILE()) {
  const std::filesystem::path shared = "shared/data";
  const char* named = std::getenv("PANVO_DATA");
  if (named != nullptr && *named != '\0') return std::filesystem::path(named) / name;
  std::filesystem::path inner = source;
  for (auto outer = inner.parent_path(); outer != inner; inner = outer, outer = inner.parent_path()) {
    if (std::filesystem::exists(outer / shared)) return outer / shared / name;
  }
  return shared / name;
}

/// The reason for which a test or benchmark without `recording` is skipped.
inline std::string missing_recording(const std::filesystem::path& recording) {
  return recording.string() + " is missing; set PANVO_DATA to the folder of recordings";
}

}  // namespace panvo::test

/// Skips the test if `recording` does not exist. For sources that include GoogleTest.
#define PANVO_NEEDS_RECORDING(recording) \
  if (!std::filesystem::exists(recording)) GTEST_SKIP() << panvo::test::missing_recording(recording)
