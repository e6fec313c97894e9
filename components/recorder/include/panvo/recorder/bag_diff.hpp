// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/recorder/topic_filter.hpp"

namespace panvo::recorder {

/// One topic of two bags, message by message.
struct TopicComparison {
  std::string name;
  std::uint64_t equal_messages = 0;         ///< before the first difference
  std::optional<std::string> difference{};  ///< the first: "message 12 differs at byte 96: 0x3f, 0x40"
};

struct DiffOptions {
  TopicFilter topics{};
  bool times = false;  ///< recording times must be equal too
};

/// Compares the bytes of the messages of each topic, in the order in which they were recorded. How the topics'
/// messages lie between each other does not count: in a live run it is a matter of chance. Topics without a message
/// in either bag are left out. Sorted by name. Throws BagError when a bag cannot be read, or not all of it.
std::vector<TopicComparison> compare_bags(const std::filesystem::path& first, const std::filesystem::path& second,
                                          const DiffOptions& options = {});

}  // namespace panvo::recorder
