// SPDX-License-Identifier: Apache-2.0
#include "topic_access.hpp"

#include <map>
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
    for (auto& [name, topic] : topics) sorted.push_back(std::move(topic));
    return sorted;
  }

  std::shared_ptr<void> read(const TopicDescription& topic, std::function<void(const SamplePtr&)> callback) override {
    return std::make_shared<Reading>(host_.bus.channel(topic), std::move(callback));
  }

  std::shared_ptr<UntypedOutput> write(const TopicDescription& topic) override {
    if (host_.replay_order) throw ConfigError("not possible in a replay");
    return open_(topic);
  }

 private:
  Host& host_;
  const Open open_;
};

}  // namespace

std::unique_ptr<TopicAccess> make_topic_access(
    Host& host, std::function<std::shared_ptr<UntypedOutput>(const TopicDescription&)> open) {
  return std::make_unique<BusTopicAccess>(host, std::move(open));
}

}  // namespace panvo::runtime
