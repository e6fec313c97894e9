// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace panvo::fleet {

inline constexpr std::size_t kMaxCliqueNodes = 64;

/// A set of nodes, bit i for node i.
using NodeSet = std::uint64_t;

/// Largest set of nodes that are all neighbours of each other. `neighbours[i]`: those of node i, symmetric, without i.
/// Of several largest sets the first one in order of node numbers. At most `max_steps` steps of the search; what was
/// found by then is returned, which may be smaller than the largest. Throws std::invalid_argument for more than
/// kMaxCliqueNodes nodes.
NodeSet largest_clique(const std::vector<NodeSet>& neighbours, NodeSet among, int max_steps = 20'000);

}  // namespace panvo::fleet
