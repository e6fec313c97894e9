// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/clique.hpp"

#include <bit>
#include <stdexcept>

namespace panvo::fleet {
namespace {

/// Branch and bound: a set is given up when a colouring shows that it cannot beat the best one.
class CliqueSearch {
 public:
  CliqueSearch(const std::vector<NodeSet>& neighbours, int max_steps) : neighbours_(neighbours), steps_(max_steps) {}

  NodeSet run(NodeSet among) {
    extend(0, among);
    return best_;
  }

 private:
  static NodeSet bit(int node) { return NodeSet{1} << node; }

  /// Upper bound of the largest clique in `rest`: the number of colours of a greedy colouring, in which no two
  /// neighbours share one.
  int colours(NodeSet rest) const {
    int count = 0;
    while (rest != 0) {
      ++count;
      for (NodeSet free = rest; free != 0;) {
        const int node = std::countr_zero(free);
        rest &= ~bit(node);
        free &= ~bit(node) & ~neighbours_[static_cast<std::size_t>(node)];
      }
    }
    return count;
  }

  void extend(NodeSet clique, NodeSet candidates) {
    if (std::popcount(clique) > std::popcount(best_)) best_ = clique;
    while (candidates != 0) {
      if (--steps_ < 0 || std::popcount(clique) + colours(candidates) <= std::popcount(best_)) return;
      const int node = std::countr_zero(candidates);
      extend(clique | bit(node), candidates & neighbours_[static_cast<std::size_t>(node)]);
      candidates &= ~bit(node);
    }
  }

  const std::vector<NodeSet>& neighbours_;
  int steps_;
  NodeSet best_ = 0;
};

}  // namespace

NodeSet largest_clique(const std::vector<NodeSet>& neighbours, NodeSet among, int max_steps) {
  if (neighbours.size() > kMaxCliqueNodes) throw std::invalid_argument("a clique is searched among 64 nodes at most");
  return CliqueSearch(neighbours, max_steps).run(among);
}

}  // namespace panvo::fleet
