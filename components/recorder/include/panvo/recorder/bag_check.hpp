// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace panvo::recorder {

struct TopicCheck {
  std::string name, type;
  bool is_decodable = false;  ///< the type is known here, so its messages can be decoded
  std::uint64_t readable = 0;
  std::uint64_t undecodable = 0;
  std::string first_error{};  ///< the first decoding error
  std::uint64_t invalid =
      0;  ///< decoded, but violate the rules of their type: recorded as sent, rejected by components that read them
  std::string first_problem{};
};

/// Result of check_bag().
struct BagCheck {
  std::uint64_t readable = 0;
  std::uint64_t lost = 0;             ///< recorded but unreadable, as far as known
  std::vector<std::string> problems;  ///< each names its file
  std::vector<TopicCheck> topics;

  bool is_sound() const;
};

/// Reads a whole bag: runs SQLite's integrity check or verifies MCAP's checksums and counts, reads every message, and
/// decodes those of known types. Throws BagError if the bag cannot be opened.
BagCheck check_bag(const std::filesystem::path& bag);

}  // namespace panvo::recorder
