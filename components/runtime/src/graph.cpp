// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/graph.hpp"

#include <algorithm>
#include <set>

namespace panvo::runtime {
namespace {

constexpr std::size_t kPrefixDigits = 24;  // participant part of a gid

/// Of the program fast-discovery-server, as opposed to a server by a profile: "DS", its number, "_EPROSIMA". It has no
/// endpoints.
bool is_discovery_server(const std::string& prefix) {
  return prefix.starts_with("4453") && prefix.ends_with("5f4550524f53494d41");
}

}  // namespace

bool is_complete(const Graph& graph) {
  std::set<std::string> endpoints, with_endpoints, told;
  for (const auto& endpoint : graph.endpoints) {
    endpoints.insert(endpoint.gid);
    with_endpoints.insert(endpoint.gid.substr(0, kPrefixDigits));
  }
  const auto is_known = [&](const std::string& gid) { return endpoints.contains(gid); };
  for (const auto& node : graph.nodes) {
    if (!std::ranges::all_of(node.writers, is_known) || !std::ranges::all_of(node.readers, is_known)) return false;
    for (const auto& gid : node.writers) told.insert(gid.substr(0, kPrefixDigits));
  }
  const bool have_all_told = std::ranges::all_of(graph.endpoints, [&](const GraphEndpoint& endpoint) {
    return !endpoint.is_writer || endpoint.name != kNodesTopic || told.contains(endpoint.gid.substr(0, kPrefixDigits));
  });
  return have_all_told && std::ranges::all_of(graph.participants, [&](const std::string& participant) {
           return with_endpoints.contains(participant) || is_discovery_server(participant);
         });
}

}  // namespace panvo::runtime
