// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "panvo/recorder/bag_metadata.hpp"
#include "panvo/recorder/bag_writer.hpp"
#include "panvo/recorder/topic_filter.hpp"

namespace panvo::recorder {

/// Writes metadata.yaml anew from what the databases hold. What only metadata.yaml knows (custom data, ROS
/// distribution) is kept if the present one can be read. Returns what was written; `warnings` tells of files that
/// could not be read. Throws BagError.
BagMetadata reindex_bag(const std::filesystem::path& bag, std::vector<std::string>& warnings);

struct CopyResult {
  std::uint64_t copied = 0;
  std::uint64_t lost = 0;  ///< could not be read
  std::vector<std::string> warnings;
};

/// Writes the readable messages of a bag to a new one, with their times: takes out topics, makes a sound bag of a
/// damaged one and a Jazzy bag of an older one. Throws BagError.
CopyResult copy_bag(const std::filesystem::path& from, const std::filesystem::path& to, const TopicFilter& topics = {},
                    const BagWriter::Options& options = {});

}  // namespace panvo::recorder
