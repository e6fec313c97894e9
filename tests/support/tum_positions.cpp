// SPDX-License-Identifier: Apache-2.0
#include "tum_positions.hpp"

#include <cmath>
#include <sstream>

#include "process.hpp"

namespace panvo::test {

double distance(const Position& a, const Position& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

std::map<std::string, Position> read_tum(const std::filesystem::path& file) {
  std::map<std::string, Position> positions;
  std::istringstream lines(read_file(file));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string stamp;
    Position position{};
    words >> stamp >> position.x >> position.y >> position.z;
    positions[stamp] = position;
  }
  return positions;
}

}  // namespace panvo::test
