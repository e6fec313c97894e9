// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/recorder/bag_metadata.hpp"

namespace panvo::recorder {

/// The files of a bag, in order, all of which exist.
struct BagFiles {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;  ///< .db3 and .mcap, compressed or not
  std::size_t missing = 0;                   ///< files that metadata.yaml lists and that are not there
  std::optional<BagMetadata> metadata;       ///< what metadata.yaml says, where it is there and can be understood
};

/// Finds them: by metadata.yaml where `use_metadata`, and in the folder. What is not as it should be is added to
/// `warnings`. Throws BagError when there is nothing to read: no such folder, no bag, another storage or
/// compression, every file missing.
BagFiles find_bag_files(const std::filesystem::path& bag, bool use_metadata, std::vector<std::string>& warnings);

}  // namespace panvo::recorder
