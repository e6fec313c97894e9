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

/// Rewrites metadata.yaml from the content of the files. Custom data and the ROS distribution, which only metadata.yaml
/// holds, are kept if the existing file is readable. Returns the written metadata; sets `warnings` to those of the
/// reader, e.g. for unreadable files. Throws BagError.
BagMetadata reindex_bag(const std::filesystem::path& bag, std::vector<std::string>& warnings);

struct CopyResult {
  std::uint64_t copied = 0;
  std::uint64_t lost = 0;  ///< unreadable messages
  std::vector<std::string> warnings;
};

/// The part of a bag to copy.
struct CopySelection {
  TopicFilter topics{};
  /// Recording times in [from_ns, to_ns). Latched messages recorded before from_ns, e.g. static transforms and maps,
  /// are also copied, with from_ns as their time.
  std::int64_t from_ns = INT64_MIN, to_ns = INT64_MAX;
};

/// Writes the readable messages of a bag, with their times, to a new one: selects topics or a time range, repairs a
/// damaged bag, upgrades an older bag to Jazzy's format, converts the storage. Throws BagError.
CopyResult copy_bag(const std::filesystem::path& from, const std::filesystem::path& to,
                    const CopySelection& selection = {}, const BagWriter::Options& options = {});

/// Parses a time in a bag: seconds from its start ("12.5"), or a stamp in seconds or nanoseconds since 1970. Numbers
/// below 1e8 are seconds from the start. Returns ns since 1970. Throws BagError.
std::int64_t parse_bag_time(const std::string& text, std::int64_t start_ns);

}  // namespace panvo::recorder
