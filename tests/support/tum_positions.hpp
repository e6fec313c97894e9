// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace panvo::test {

struct Position {
  double x, y, z;  // m
};

/// In metres.
double distance(const Position& a, const Position& b);

/// Positions in a TUM trajectory file, by stamp as the file spells it.
std::map<std::string, Position> read_tum(const std::filesystem::path& file);

}  // namespace panvo::test
