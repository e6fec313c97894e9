// SPDX-License-Identifier: Apache-2.0
#include "topic_access.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <mutex>
#include <utility>

#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/graph.hpp"

namespace panvo::runtime {
namespace {

/// One reader of a channel, removed at its destruction.
class Reading {
 public:
  Reading(Channel& channel, std::function<void(const SamplePtr&)> callback) : channel_(channel) {
    // All messages, as for a recorder: a viewer shows what is sent, and bytes of other processes are not decoded here.
    channel_.add_reader(
        this, [callback = std::move(callback)](const TopicDescription&, const SamplePtr& sample) { callback(sample); },
        Channel::Wants::kAll);
  }
  ~Reading() { channel_.remove_reader(this); }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

 private:
  Channel& channel_;
};

void add_written(const Graph& graph, std::map<std::string, TopicDescription>& topics) {
  std::map<std::string, TopicDescription> found;
  for (const auto& endpoint : graph.endpoints) {
    if (endpoint.kind != EndpointKind::kTopic || !endpoint.is_writer || topics.contains(endpoint.name)) continue;
    const auto [entry, is_new] =
        found.try_emplace(endpoint.name, TopicDescription{endpoint.name, endpoint.type_name, endpoint.qos, nullptr});
    auto& [name, topic] = *entry;
    if (is_new) topic.type = interfaces::find_message_type(topic.type_name);
    if (endpoint.qos.requested == interfaces::Reliability::kBestEffort)
      topic.qos.requested = interfaces::Reliability::kBestEffort;
    if (endpoint.qos.durability == interfaces::Durability::kVolatile)
      topic.qos.durability = interfaces::Durability::kVolatile;
  }
  topics.merge(found);
}

/// Nodes of other processes.
std::vector<NodeDescription> nodes_of(const Graph& graph) {
  std::map<std::string, const GraphEndpoint*> endpoints;
  for (const auto& endpoint : graph.endpoints) endpoints.emplace(endpoint.gid, &endpoint);
  std::vector<NodeDescription> nodes;
  for (const auto& node : graph.nodes) {
    auto& known = nodes.emplace_back(NodeDescription{node.name_space, node.name, {}, {}, {}});
    const auto add = [&](const std::vector<std::string>& gids, EndpointKind kind, std::vector<std::string>& names) {
      for (const auto& gid : gids) {
        const auto found = endpoints.find(gid);
        if (found != endpoints.end() && found->second->kind == kind) names.push_back(found->second->name);
      }
    };
    add(node.writers, EndpointKind::kTopic, known.publishes);
    add(node.readers, EndpointKind::kTopic, known.subscribes);
    add(node.readers, EndpointKind::kRequest, known.serves);
  }
  return nodes;
}

class BusTopicAccess final : public TopicAccess {
 public:
  using Open = std::function<std::shared_ptr<UntypedOutput>(const TopicDescription&)>;
  BusTopicAccess(Host& host, Open open) : host_(host), open_(std::move(open)) {}

  std::vector<TopicDescription> published() const override {
    std::map<std::string, TopicDescription> topics;
    for (const Channel* channel : host_.bus.channels()) {
      if (channel->has_publisher_other_than(nullptr)) topics.emplace(channel->topic().name, channel->topic());
    }
    if (Bridge* const bridge = host_.bus.bridge()) add_written(bridge->graph(), topics);
    std::vector<TopicDescription> sorted;
    sorted.reserve(topics.size());
    for (auto& [name, topic] : topics) sorted.push_back(std::move(topic));
    return sorted;
  }

  std::shared_ptr<void> read(const TopicDescription& topic, std::function<void(const SamplePtr&)> callback) override {
    return std::make_shared<Reading>(host_.bus.channel(topic), std::move(callback));
  }

  std::shared_ptr<UntypedOutput> write(const TopicDescription& topic) override {
    refuse_in_replay();
    return open_(topic);
  }

  std::vector<NodeDescription> nodes() const override {
    auto nodes = host_.nodes.get();
    if (Bridge* const bridge = host_.bus.bridge())
      std::ranges::move(nodes_of(bridge->graph()), std::back_inserter(nodes));
    return nodes;
  }

  std::vector<ServiceDescription> services() const override {
    std::map<std::string, ServiceDescription> services;
    for (auto& service : host_.services.services()) services.emplace(service.name, std::move(service));
    if (Bridge* const bridge = host_.bus.bridge()) {
      for (const auto& endpoint : bridge->graph().endpoints) {
        if (endpoint.kind == EndpointKind::kRequest && !endpoint.is_writer)
          services.try_emplace(endpoint.name, ServiceDescription{endpoint.name, endpoint.type_name});
      }
    }
    std::vector<ServiceDescription> sorted;
    sorted.reserve(services.size());
    for (auto& [name, service] : services) sorted.push_back(std::move(service));
    return sorted;
  }

  std::optional<interfaces::Bytes> call(const ServiceDescription& service, interfaces::Bytes request,
                                        std::chrono::milliseconds limit) override {
    refuse_in_replay();
    const auto end = std::chrono::steady_clock::now() + limit;
    bool is_here = false;
    auto answer = answer_to(
        [&](const std::shared_ptr<Reply>& reply) { is_here = host_.services.call(service, request, reply); }, limit);
    if (is_here || !host_.bus.bridge()) return answer;
    const auto client = client_of(service);
    if (!client->wait_for_service(limit)) return std::nullopt;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    return client->call(request, std::max(left, std::chrono::milliseconds(1)));
  }

 private:
  void refuse_in_replay() const {
    if (host_.replay_order) throw ConfigError("not possible in a replay");
  }

  std::shared_ptr<BridgeClient> client_of(const ServiceDescription& service) {
    const std::lock_guard lock(clients_mutex_);
    if (clients_.size() >= kMaxClients) clients_.clear();  // those that are in use live on until their call ends
    auto& client = clients_[{service.name, service.type_name}];
    if (!client) client = host_.bus.bridge()->open_client(service);
    return client;
  }

  static constexpr std::size_t kMaxClients = 64;  // each has two DDS endpoints

  Host& host_;
  const Open open_;
  std::mutex clients_mutex_;
  std::map<std::pair<std::string, std::string>, std::shared_ptr<BridgeClient>> clients_;  // by name and type
};

}  // namespace

std::unique_ptr<TopicAccess> make_topic_access(
    Host& host, std::function<std::shared_ptr<UntypedOutput>(const TopicDescription&)> open) {
  return std::make_unique<BusTopicAccess>(host, std::move(open));
}

}  // namespace panvo::runtime
