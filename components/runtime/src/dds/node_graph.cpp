// SPDX-License-Identifier: Apache-2.0
#include "node_graph.hpp"

#include <spdlog/fmt/fmt.h>

#include <utility>

#include "names.hpp"
#include "panvo/runtime/names.hpp"
#include "reader.hpp"
#include "rmw_dds_common/msg/ParticipantEntitiesInfo.h"
#include "writer.hpp"

namespace panvo::runtime::dds {
namespace {

constexpr const char* kTopic = "ros_discovery_info";

// Only the newest message of each participant counts; a reader must hold those of all participants.
constexpr interfaces::Qos kWriterQos{.durability = interfaces::Durability::kTransientLocal, .depth = 1};
constexpr interfaces::Qos kReaderQos{
    .durability = interfaces::Durability::kTransientLocal, .depth = 1000, .keep_all = true};

// The type hash applies to 16-byte GIDs; Humble has no hashes.
TopicDescription topic(const interfaces::Qos& qos, std::size_t gid_size) {
  const auto& type = interfaces::message_type<rmw_dds_common::msg::ParticipantEntitiesInfo>();
  return {kTopic, std::string(type.name), qos, gid_size == kGidSize ? &type : nullptr};
}

WireTopic wire() {
  const auto& type = interfaces::message_type<rmw_dds_common::msg::ParticipantEntitiesInfo>();
  return {kTopic, std::string(type.dds_name), kTopic};
}

void append(std::vector<NodeInfo::Guid>& guids, const std::vector<NodeInfo::Guid>& more) {
  guids.insert(guids.end(), more.begin(), more.end());
}

}  // namespace

void NodeGraph::open_writer(const std::shared_ptr<Participant>& writers) {
  if (writer_) return;
  {
    const std::lock_guard lock(mutex_);
    own_participant_ = writers->guid();
  }
  writer_ = std::make_unique<Writer>(topic(kWriterQos, gid_size_), wire(), writers, notifier_);
  endpoints_->on_change([self = weak_from_this()] {
    if (const auto graph = self.lock()) graph->tell_soon();
  });
}

void NodeGraph::open_reader(const std::shared_ptr<Participant>& readers) {
  if (reader_) return;
  reader_ = std::make_unique<Reader>(
      topic(kReaderQos, gid_size_), wire(), [this](const SamplePtr& sample) { take(sample); }, readers, notifier_);
}

void NodeGraph::set_nodes(std::vector<NodeDescription> nodes) {
  {
    const std::lock_guard lock(mutex_);
    own_nodes_ = std::move(nodes);
    warn_of_clashes();
  }
  tell_soon();
}

void NodeGraph::tell_soon() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(will_tell_, true)) return;  // several changes are published together
  }
  notifier_->post([self = weak_from_this()] {
    if (const auto graph = self.lock()) graph->tell();
  });
}

void NodeGraph::tell() {
  NodeInfo info;
  {
    const std::lock_guard lock(mutex_);
    will_tell_ = false;
    info = own_info();
  }
  writer_->write(Sample::from_bytes(nullptr, "", encode(info, gid_size_), 0));
}

NodeInfo NodeGraph::own_info() const {
  NodeInfo info{.participant = own_participant_, .nodes = {}};
  for (const auto& described : own_nodes_) {
    NodeInfo::Node node{described.name_space, described.name, {}, {}};
    for (const auto& name : described.publishes) append(node.writers, endpoints_->of(wire_topic_name(name), true));
    for (const auto& name : described.subscribes) append(node.readers, endpoints_->of(wire_topic_name(name), false));
    for (const auto& name : described.serves) {
      append(node.readers, endpoints_->of(wire_request_name(name), false));
      append(node.writers, endpoints_->of(wire_reply_name(name), true));
    }
    info.nodes.push_back(std::move(node));
  }
  return info;
}

void NodeGraph::take(const SamplePtr& sample) {
  auto info = decode_node_info(sample->bytes());
  if (!info) {
    notifier_->warn(fmt::format("topic {}: ignored a malformed message; some nodes may not be listed", kTopic));
    return;
  }
  const std::lock_guard lock(mutex_);
  others_[info->participant.guidPrefix] = std::move(*info);
  warn_of_clashes();
}

void NodeGraph::participant_gone(const eprosima::fastrtps::rtps::GuidPrefix_t& prefix) {
  const std::lock_guard lock(mutex_);
  others_.erase(prefix);
}

void NodeGraph::warn_of_clashes() const {
  for (const auto& own : own_nodes_) {
    const std::string name = full_name(own.name_space, own.name);
    for (const auto& [prefix, info] : others_) {
      for (const auto& other : info.nodes) {
        if (full_name(other.name_space, other.name) != name) continue;
        notifier_->warn(
            fmt::format("node {}: another process in this DDS domain has a node of the same name; requests reach "
                        "both. Remedy: give one of them another name or namespace in its system file, or use another "
                        "ROS_DOMAIN_ID.",
                        name));
      }
    }
  }
}

std::vector<GraphNode> NodeGraph::nodes() const {
  const std::lock_guard lock(mutex_);
  std::vector<GraphNode> nodes;
  for (const auto& [prefix, info] : others_) {
    for (const auto& node : info.nodes) {
      GraphNode shown{node.name_space, node.name, {}, {}};
      for (const auto& guid : node.readers) shown.readers.push_back(hexadecimal(guid));
      for (const auto& guid : node.writers) shown.writers.push_back(hexadecimal(guid));
      nodes.push_back(std::move(shown));
    }
  }
  return nodes;
}

}  // namespace panvo::runtime::dds
