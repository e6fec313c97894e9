// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/graph.hpp"

#include <algorithm>
#include <set>

namespace panvo::runtime {
namespace {

constexpr std::size_t kPrefixDigits = 24;  // participant part of a gid

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
           return with_endpoints.contains(participant);
         });
}

}  // namespace panvo::runtime
