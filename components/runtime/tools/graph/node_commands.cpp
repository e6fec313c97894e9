// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "commands.hpp"

namespace panvo::runtime::graph {
namespace {

void list(const SessionOptions& options) {
  Session session(options);
  std::map<std::string, int> nodes;
  for (const auto& node : session.settled_graph().nodes) ++nodes[full_name_of(node)];
  for (const auto& [name, count] : nodes) {
    std::cout << name << "\n";
    if (count > 1) std::cerr << "panvo: " << count << " nodes have the name " << name << "\n";
  }
}

/// Topics or services with their types, sorted.
using Lines = std::set<std::string>;

void print_lines(const char* title, const Lines& lines) {
  std::cout << "  " << title << ":\n";
  for (const auto& line : lines) std::cout << "    " << line << "\n";
}

void info(const SessionOptions& options, const std::string& name) {
  Session session(options);
  const Graph graph = session.settled_graph();
  Lines subscribed, published, served, called;
  std::vector<GraphNode> nodes = graph.nodes;
  std::erase_if(nodes, [&](const GraphNode& node) { return full_name_of(node) != name; });
  if (nodes.empty()) throw Failure("no node named " + name + "; `panvo node list` shows the nodes");
  for (const auto& endpoint : graph.endpoints) {
    if (std::ranges::none_of(nodes, [&](const GraphNode& node) { return has(node, endpoint); })) continue;
    const std::string line = endpoint.name + ": " + endpoint.type_name;
    if (endpoint.kind == EndpointKind::kTopic) (endpoint.is_writer ? published : subscribed).insert(line);
    if (endpoint.kind == EndpointKind::kRequest) (endpoint.is_writer ? called : served).insert(line);
  }
  std::cout << name << "\n";
  print_lines("Subscribers", subscribed);
  print_lines("Publishers", published);
  print_lines("Service Servers", served);
  print_lines("Service Clients", called);
}

}  // namespace

void add_node_commands(CLI::App& app, const SessionOptions& options) {
  auto* node = app.add_subcommand("node", "nodes of the domain");
  node->require_subcommand(1);
  node->add_subcommand("list", "list the nodes")->callback([&options] { list(options); });
  auto* info_command = node->add_subcommand("info", "show the topics and services of a node");
  const auto name = std::make_shared<std::string>();
  info_command->add_option("NODE", *name, "such as /binocular_odometry")->required();
  info_command->callback([&options, name] { info(options, absolute(*name)); });
}

}  // namespace panvo::runtime::graph
