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

/// Writes metadata.yaml anew from what the files hold. What only metadata.yaml knows (custom data, ROS
/// distribution) is kept if the present one can be read. Returns what was written; `warnings` tells of files that
/// could not be read. Throws BagError.
BagMetadata reindex_bag(const std::filesystem::path& bag, std::vector<std::string>& warnings);

struct CopyResult {
  std::uint64_t copied = 0;
  std::uint64_t lost = 0;  ///< could not be read
  std::vector<std::string> warnings;
};

/// What of a bag to copy.
struct CopySelection {
  TopicFilter topics{};
  /// Recorded from here on, and before there. Latched messages from before the beginning are kept, as if they had been
  /// recorded at it: transforms and maps that hold for what follows.
  std::int64_t from_ns = INT64_MIN, to_ns = INT64_MAX;
};

/// Writes the readable messages of a bag to a new one, with their times: takes out topics or a stretch of time, makes
/// a sound bag of a damaged one, a Jazzy bag of an older one, and another storage. Throws BagError.
CopyResult copy_bag(const std::filesystem::path& from, const std::filesystem::path& to,
                    const CopySelection& selection = {}, const BagWriter::Options& options = {});

/// A time of a bag as one writes it: "12.5", seconds from its beginning; a stamp in seconds, or in nanoseconds since
/// 1970, which both are too large to be taken for that. Throws BagError.
std::int64_t parse_bag_time(const std::string& text, std::int64_t start_ns);

}  // namespace panvo::recorder
