// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace panvo::recorder::fuzz {

/// Damages a file, reproducibly for a seed: changes bytes, inserts huge sizes, removes, duplicates or zeroes parts,
/// truncates.
inline std::string mutated(std::string file, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](std::size_t limit) { return limit == 0 ? 0 : static_cast<std::size_t>(random() % limit); };
  const auto rounds = 1 + below(6);
  for (std::size_t round = 0; round < rounds && !file.empty(); ++round) {
    const auto at = below(file.size());
    const auto length = std::min(file.size() - at, below(2) == 0 ? below(16) : below(file.size()));
    switch (below(8)) {
      case 0:
        file[at] = static_cast<char>(file[at] ^ (1 << below(8)));
        break;
      case 1:
        file[at] = static_cast<char>(random());
        break;
      case 2:  // a number that is small, huge or negative
        for (std::size_t i = 0; i < std::min<std::size_t>(length, 8); ++i) {
          file[at + i] = static_cast<char>(below(3) == 0 ? 0 : below(2) == 0 ? 0xff : 0x7f);
        }
        break;
      case 3:
        file.erase(at, length);
        break;
      case 4:
        file.insert(below(file.size()), file.substr(at, length));
        break;
      case 5:
        file.replace(at, length, std::string(length, '\0'));
        break;
      case 6:
        file.resize(at);
        break;
      default:
        file[at] = static_cast<char>(file[at] + (below(2) == 0 ? 1 : -1));
        break;
    }
  }
  return file;
}

}  // namespace panvo::recorder::fuzz
