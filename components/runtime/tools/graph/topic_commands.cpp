// SPDX-License-Identifier: Apache-2.0
#include "topic_commands.hpp"

#include <spdlog/fmt/fmt.h>

#include <iostream>
#include <map>
#include <memory>
#include <set>

#include "commands.hpp"

namespace panvo::runtime::graph {
namespace {

struct Counts {
  std::set<std::string> types;
  std::size_t writers = 0, readers = 0;
};

std::map<std::string, Counts> topics_of(const Graph& graph) {
  std::map<std::string, Counts> topics;
  for (const auto& endpoint : graph.endpoints) {
    if (endpoint.kind != EndpointKind::kTopic) continue;
    Counts& counts = topics[endpoint.name];
    counts.types.insert(endpoint.type_name);
    ++(endpoint.is_writer ? counts.writers : counts.readers);
  }
  return topics;
}

void list_topics(const SessionOptions& options, bool with_types) {
  Session session(options);
  for (const auto& [name, counts] : topics_of(session.settled_graph()))
    std::cout << name << (with_types ? " [" + fmt::format("{}", fmt::join(counts.types, ", ")) + "]" : "") << "\n";
}

void print_endpoint(const Graph& graph, const GraphEndpoint& endpoint) {
  const std::string node = node_of(graph, endpoint);
  std::cout << "\nNode: " << (node.empty() ? "(not a ROS 2 node)" : node)
            << "\nEndpoint: " << (endpoint.is_writer ? "publisher" : "subscription") << "\nType: " << endpoint.type_name
            << "\nType hash: " << (endpoint.type_hash.empty() ? "(unknown)" : endpoint.type_hash)
            << "\nGID: " << endpoint.gid << "\nReliability: "
            << (endpoint.qos.requested == interfaces::Reliability::kReliable ? "reliable" : "best effort")
            << "\nDurability: "
            << (endpoint.qos.durability == interfaces::Durability::kTransientLocal ? "transient local" : "volatile")
            << "\n";
}

void topic_info(const SessionOptions& options, const std::string& name, bool verbose) {
  Session session(options);
  const Graph graph = session.settled_graph();
  const auto topics = topics_of(graph);
  const auto found = topics.find(name);
  if (found == topics.end()) throw Failure("there is no topic " + name + " (panvo topic list)");
  const auto& [types, writers, readers] = found->second;
  std::cout << "Type: " << fmt::format("{}", fmt::join(types, ", ")) << "\nPublishers: " << writers
            << "\nSubscriptions: " << readers << "\n";
  if (!verbose) return;
  for (const bool is_writer : {true, false}) {
    for (const auto& endpoint : graph.endpoints) {
      if (endpoint.kind == EndpointKind::kTopic && endpoint.name == name && endpoint.is_writer == is_writer)
        print_endpoint(graph, endpoint);
    }
  }
}

}  // namespace

void add_topic_commands(CLI::App& app, const SessionOptions& options) {
  auto* topic = app.add_subcommand("topic", "topics of the domain");
  topic->require_subcommand(1);
  const auto reading = std::make_shared<TopicReading>();
  const auto flag = std::make_shared<bool>(false);
  auto* list_command = topic->add_subcommand("list", "list the topics");
  list_command->add_flag("-t,--show-types", *flag, "also show types");
  list_command->callback([&options, flag] { list_topics(options, *flag); });

  auto* info_command = topic->add_subcommand("info", "show type, publishers and subscriptions of a topic");
  info_command->add_option("TOPIC", reading->topic, "such as /odometry/binocular")->required();
  info_command->add_flag("-v,--verbose", *flag, "also show nodes, type hashes and quality of service");
  info_command->callback([&options, reading, flag] { topic_info(options, absolute(reading->topic), *flag); });

  const auto add = [&](const char* name, const char* what, void (*run)(const SessionOptions&, const TopicReading&)) {
    auto* command = topic->add_subcommand(name, what);
    command->add_option("TOPIC", reading->topic)->required();
    command->add_option("--type", reading->type_name, "such as nav_msgs/msg/Odometry (default: the publisher's)");
    command->callback([&options, reading, run] {
      reading->topic = absolute(reading->topic);
      run(options, *reading);
    });
    return command;
  };
  auto* echo_command = add("echo", "print messages as YAML until Ctrl-C", echo);
  echo_command->add_option("-n,--count", reading->count, "stop after this many messages");
  echo_command->add_flag_callback(
      "--once", [reading] { reading->count = 1; }, "stop after the first message");
  echo_command->add_flag("-f,--full-length", reading->whole, "do not shorten long lists and texts");
  for (auto* command : {add("hz", "report the message rate once per second until Ctrl-C", hz),
                        add("bw", "report the bandwidth once per second until Ctrl-C", bw)}) {
    command->add_option("-n,--count", reading->count, "stop after this many reports");
    command->add_option("-w,--window", reading->window, "number of messages that a report covers")
        ->check(CLI::Range(2, 1'000'000))
        ->capture_default_str();
  }
}

}  // namespace panvo::runtime::graph
