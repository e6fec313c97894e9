// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/clique.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>
#include <stdexcept>
#include <utility>

namespace panvo::fleet {
namespace {

std::vector<NodeSet> graph(std::size_t nodes, const std::vector<std::pair<int, int>>& edges) {
  std::vector<NodeSet> neighbours(nodes, 0);
  for (const auto& [a, b] : edges) {
    neighbours[static_cast<std::size_t>(a)] |= NodeSet{1} << b;
    neighbours[static_cast<std::size_t>(b)] |= NodeSet{1} << a;
  }
  return neighbours;
}

/// By trying every set.
int largest_of_all(const std::vector<NodeSet>& neighbours) {
  int largest = 0;
  for (NodeSet set = 0; set < NodeSet{1} << neighbours.size(); ++set) {
    bool is_clique = true;
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
      if ((set >> i & 1) != 0 && (set & ~neighbours[i] & ~(NodeSet{1} << i)) != 0) is_clique = false;
    }
    if (is_clique) largest = std::max(largest, std::popcount(set));
  }
  return largest;
}

TEST(LargestClique, IsTheSquareWithDiagonalsBesideATriangle) {
  const auto neighbours = graph(7, {{0, 1}, {1, 2}, {0, 2}, {2, 3}, {3, 4}, {3, 5}, {3, 6}, {4, 5}, {4, 6}, {5, 6}});
  EXPECT_EQ(largest_clique(neighbours, 0b1111111), NodeSet{0b1111000});
}

TEST(LargestClique, IsSearchedOnlyAmongTheGivenNodes) {
  const auto neighbours = graph(5, {{0, 1}, {1, 2}, {0, 2}, {3, 4}});
  EXPECT_EQ(largest_clique(neighbours, 0b11000), NodeSet{0b11000});
  EXPECT_EQ(largest_clique(neighbours, 0), NodeSet{0});
}

TEST(LargestClique, OfNodesWithoutNeighboursIsTheFirstOne) {
  EXPECT_EQ(largest_clique(graph(3, {}), 0b111), NodeSet{1});
}

TEST(LargestClique, IsAsLargeAsTheLargestOfAllSets) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<std::pair<int, int>> edges;
    for (int i = 0; i < 14; ++i) {
      for (int j = 0; j < i; ++j) {
        if (random() % 2 == 0) edges.emplace_back(i, j);
      }
    }
    const auto neighbours = graph(14, edges);
    EXPECT_EQ(std::popcount(largest_clique(neighbours, (1 << 14) - 1)), largest_of_all(neighbours));
  }
}

// 21 groups of three, joined with all nodes of other groups: 3^21 cliques of the same size.
TEST(LargestClique, EndsAfterItsStepsWithWhatItHas) {
  std::vector<std::pair<int, int>> edges;
  for (int i = 0; i < 63; ++i) {
    for (int j = 0; j < i; ++j) {
      if (i / 3 != j / 3) edges.emplace_back(i, j);
    }
  }
  const auto neighbours = graph(63, edges);
  EXPECT_EQ(std::popcount(largest_clique(neighbours, ~NodeSet{0} >> 1)), 21);
  EXPECT_EQ(std::popcount(largest_clique(neighbours, ~NodeSet{0} >> 1, 10)), 10);
}

TEST(LargestClique, RefusesMoreNodesThanItsSetHolds) {
  EXPECT_THROW(largest_clique(std::vector<NodeSet>(65, 0), 0), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::fleet
