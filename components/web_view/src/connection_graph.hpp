// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "panvo/runtime/graph.hpp"

namespace panvo::web_view {

/// Who publishes, subscribes to and serves what: topics and services to full names of nodes.
struct ConnectionGraph {
  using Links = std::map<std::string, std::set<std::string>>;
  Links published, subscribed, services;
  bool operator==(const ConnectionGraph&) const = default;
};

ConnectionGraph connection_graph_of(const std::vector<runtime::NodeDescription>& nodes);

}  // namespace panvo::web_view
