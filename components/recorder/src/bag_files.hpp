// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/recorder/bag_metadata.hpp"

namespace panvo::recorder {

/// The existing files of a bag, in order.
struct BagFiles {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;  ///< .db3 and .mcap, compressed or not
  std::size_t missing = 0;                   ///< number of files listed in metadata.yaml that do not exist
  std::optional<BagMetadata> metadata;       ///< content of metadata.yaml, if it exists and is valid
};

/// Finds the files in metadata.yaml (if `use_metadata`) and in the folder. Appends recoverable faults to `warnings`.
/// Throws BagError if nothing can be read: no such folder, not a bag, an unsupported storage or compression, all files
/// missing.
BagFiles find_bag_files(const std::filesystem::path& bag, bool use_metadata, std::vector<std::string>& warnings);

}  // namespace panvo::recorder
