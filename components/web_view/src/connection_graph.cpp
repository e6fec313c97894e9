// SPDX-License-Identifier: Apache-2.0
#include "connection_graph.hpp"

#include "panvo/runtime/names.hpp"

namespace panvo::web_view {

ConnectionGraph connection_graph_of(const std::vector<runtime::NodeDescription>& nodes) {
  ConnectionGraph graph;
  for (const auto& node : nodes) {
    const std::string name = runtime::full_name(node.name_space, node.name);
    for (const auto& topic : node.publishes) graph.published[topic].insert(name);
    for (const auto& topic : node.subscribes) graph.subscribed[topic].insert(name);
    for (const auto& service : node.serves) graph.services[service].insert(name);
  }
  return graph;
}

}  // namespace panvo::web_view
