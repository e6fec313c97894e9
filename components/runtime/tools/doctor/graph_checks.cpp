// SPDX-License-Identifier: Apache-2.0
#include "graph_checks.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "../graph/session.hpp"

namespace panvo::runtime::doctor {
namespace {

using interfaces::Durability;
using interfaces::Reliability;

std::string owner(const Graph& graph, const GraphEndpoint& endpoint) {
  const auto node = graph::node_of(graph, endpoint);
  return node.empty() ? "an unknown node" : node;
}

void check_names(const Graph& graph, Findings& findings) {
  std::map<std::string, int> count;
  for (const auto& node : graph.nodes) ++count[graph::full_name_of(node)];
  for (const auto& [name, times] : count) {
    if (times == 1) continue;
    findings.push_back({Severity::kProblem, "nodes",
                        fmt::format("{} nodes are named {}: requests reach all of them", times, name),
                        "rename all but one (-r __node:=NAME), or use another ROS_DOMAIN_ID"});
  }
}

void check_types(const Graph& graph, Findings& findings) {
  std::map<std::string, std::map<std::string, std::string>> owner_by_type;  // by topic
  for (const auto& endpoint : graph.endpoints) {
    if (endpoint.kind == EndpointKind::kTopic)
      owner_by_type[endpoint.name].emplace(endpoint.type_name, owner(graph, endpoint));
  }
  for (const auto& [topic, types] : owner_by_type) {
    if (types.size() == 1) continue;
    std::string text = topic + " has several types, between which no messages go:";
    for (const auto& [type, node] : types) text += fmt::format(" {} ({})", type, node);
    findings.push_back({Severity::kProblem, "topics", text, "remap the topic in one of the nodes"});
  }
}

/// Why a reader does not receive from a writer of its topic and type; empty if it does.
std::string difference(const interfaces::Qos& offered, const interfaces::Qos& requested) {
  if (requested.requested == Reliability::kReliable && offered.requested == Reliability::kBestEffort)
    return "requests reliable delivery, which is not offered";
  if (requested.durability == Durability::kTransientLocal && offered.durability == Durability::kVolatile)
    return "requests earlier messages (transient local), which are not kept";
  return "";
}

void check_qos(const Graph& graph, Findings& findings) {
  std::set<std::string> texts;  // nodes may have several endpoints of a topic
  for (const auto& reader : graph.endpoints) {
    for (const auto& writer : graph.endpoints) {
      if (reader.is_writer || !writer.is_writer || reader.kind != EndpointKind::kTopic || writer.kind != reader.kind ||
          reader.name != writer.name || reader.type_name != writer.type_name)
        continue;
      if (const auto why = difference(writer.qos, reader.qos); !why.empty()) {
        texts.insert(fmt::format("{}: {} receives nothing from {}: it {}", reader.name, owner(graph, reader),
                                 owner(graph, writer), why));
      }
    }
  }
  for (const auto& text : texts)
    findings.push_back(
        {Severity::kProblem, "topics", text, "change the quality of service of one side (qos_overrides)"});
}

void check_time(const Graph& graph, Findings& findings) {
  std::set<std::string> sources;
  for (const auto& endpoint : graph.endpoints) {
    if (endpoint.is_writer && endpoint.kind == EndpointKind::kTopic && endpoint.name == "/clock")
      sources.insert(endpoint.gid);
  }
  if (sources.size() < 2) return;
  findings.push_back({Severity::kProblem, "time",
                      fmt::format("{} publishers of /clock: time jumps back and forth", sources.size()),
                      "stop all but one, or use another ROS_DOMAIN_ID"});
}

void check_distributions(const Graph& graph, Findings& findings) {
  bool has_humble = false, has_later = false;
  for (const auto& endpoint : graph.endpoints) {
    if (endpoint.is_writer || endpoint.name != kNodesTopic) continue;
    (endpoint.type_hash.empty() ? has_humble : has_later) = true;
  }
  if (!has_humble || !has_later) return;
  findings.push_back(
      {Severity::kWarning, "distributions",
       "ROS 2 Humble and a later distribution are in the domain, which do not list each other's nodes; the "
       "messages of the later one can exhaust the memory of Humble's nodes",
       "separate them by ROS_DOMAIN_ID"});
}

}  // namespace

Findings check_graph(const Graph& graph) {
  Findings findings;
  for (const auto check : {check_names, check_types, check_qos, check_time, check_distributions})
    check(graph, findings);
  if (!findings.empty()) return findings;
  return {{Severity::kOk, "domain",
           fmt::format("{} nodes in {} processes, no conflicts", graph.nodes.size(), graph.participants.size())}};
}

}  // namespace panvo::runtime::doctor
