// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/recorder/topic_filter.hpp"

namespace panvo::recorder {

/// Comparison of one topic in two bags.
struct TopicComparison {
  std::string name;
  std::uint64_t equal_messages = 0;         ///< before the first difference
  std::optional<std::string> difference{};  ///< the first one: "message 12 differs at byte 96 of 112: 0x3f, 0x40"
};

struct DiffOptions {
  TopicFilter topics{};
  bool times = false;  ///< also compare recording times
};

/// Compares the message bytes of each topic in recording order. The interleaving of topics is ignored, since it is
/// random in a live run. Topics without messages in both bags are omitted. Sorted by name. Throws BagError if a bag
/// cannot be read completely.
std::vector<TopicComparison> compare_bags(const std::filesystem::path& first, const std::filesystem::path& second,
                                          const DiffOptions& options = {});

}  // namespace panvo::recorder
