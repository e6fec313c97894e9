// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace panvo::recorder {

struct TopicCheck {
  std::string name, type;
  bool is_decodable = false;  ///< whether the type is known here, so that its messages could be decoded
  std::uint64_t readable = 0;
  std::uint64_t undecodable = 0;
  std::string first_error{};  ///< of decoding
  std::uint64_t invalid =
      0;  ///< decode, but break the rules of their type: recorded as they were sent, and left out by those who read them
  std::string first_problem{};
};

/// What is wrong with a bag.
struct BagCheck {
  std::uint64_t readable = 0;
  std::uint64_t lost = 0;             ///< as far as can be known
  std::vector<std::string> problems;  ///< each names its file
  std::vector<TopicCheck> topics;

  bool is_sound() const;
};

/// Reads all of a bag: SQLite's own check or MCAP's checksums and counts, every message, and every message decoded
/// whose type is known. Throws BagError when there is no bag to read.
BagCheck check_bag(const std::filesystem::path& bag);

}  // namespace panvo::recorder
