// SPDX-License-Identifier: Apache-2.0
#include "node_graph.hpp"

#include <spdlog/fmt/fmt.h>

#include <utility>

#include "fast_dds.hpp"
#include "names.hpp"
#include "panvo/runtime/names.hpp"
#include "reader.hpp"
#include "rmw_dds_common/msg/ParticipantEntitiesInfo.h"
#include "writer.hpp"

namespace panvo::runtime::dds {
namespace {

// Only the newest message of each participant counts; a reader must hold those of all participants.
constexpr interfaces::Qos kWriterQos{.durability = interfaces::Durability::kTransientLocal, .depth = 1};
constexpr interfaces::Qos kReaderQos{
    .durability = interfaces::Durability::kTransientLocal, .depth = 1000, .keep_all = true};

// Its type hash is that of later distributions; Humble has none.
TopicDescription topic(const interfaces::Qos& qos) {
  const auto& type = interfaces::message_type<rmw_dds_common::msg::ParticipantEntitiesInfo>();
  return {kNodesTopic, std::string(type.name), qos, &type};
}

WireTopic wire() {
  const auto& type = interfaces::message_type<rmw_dds_common::msg::ParticipantEntitiesInfo>();
  return {kNodesTopic, std::string(type.dds_name), kNodesTopic};
}

void append(std::vector<NodeInfo::Guid>& guids, const std::vector<NodeInfo::Guid>& more) {
  guids.insert(guids.end(), more.begin(), more.end());
}

}  // namespace

void NodeGraph::open_writer(const std::shared_ptr<Participant>& participant) {
  if (writer_) return;
  {
    const std::lock_guard lock(mutex_);
    own_participant_ = participant->guid();
  }
  auto writer = std::make_unique<Writer>(topic(kWriterQos), wire(), participant, notifier_);
  {
    // Not while the writer is created: it meets readers then, inside nodes_reader().
    const std::lock_guard lock(format_mutex_);
    writer_ = std::move(writer);
  }
  endpoints_->on_change([self = weak_from_this()] {
    if (const auto graph = self.lock()) graph->tell_soon();
  });
}

void NodeGraph::open_reader(const std::shared_ptr<Participant>& participant) {
  if (reader_) return;
  // A participant publishes the list of its nodes again with each endpoint that it opens, at least ten times per ROS 2
  // node: a robot that starts exceeds the limit of a topic. Without a participant's last message, its nodes would never
  // be listed.
  reader_ = std::make_unique<Reader>(
      topic(kReaderQos), wire(), [this](const SamplePtr& sample) { take(sample); }, participant, notifier_,
      Reader::Rate::kAny);
}

void NodeGraph::close() {
  reader_.reset();
  std::unique_ptr<Writer> closed;  // without the lock, which a callback may wait for
  const std::lock_guard lock(format_mutex_);
  closed.swap(writer_);
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
  const std::lock_guard lock(format_mutex_);
  const bool is_humbles = is_for_humble_ || !humble_readers_.empty();
  writer_->write(Sample::from_bytes(nullptr, "", encode(info, is_humbles ? kHumbleGidSize : kGidSize), 0));
}

void NodeGraph::nodes_reader(const rtps::GUID_t& reader, Discovery::NodesReader what) {
  const std::lock_guard lock(format_mutex_);
  const bool had_humble = !humble_readers_.empty();
  humble_readers_.erase(reader);
  later_readers_.erase(reader);
  if (what == Discovery::NodesReader::kOfHumble) humble_readers_.insert(reader);
  if (what == Discovery::NodesReader::kOfLaterDistribution) later_readers_.insert(reader);
  if (is_for_humble_) return;
  if (!humble_readers_.empty() && !later_readers_.empty()) {
    notifier_->warn(
        "nodes of ROS 2 Humble and of a later distribution are in this DDS domain, which need different messages about "
        "nodes; the later ones do not list the nodes of this process. Remedy: separate them by ROS_DOMAIN_ID.");
  }
  if (had_humble == !humble_readers_.empty() || !writer_) return;
  if (!had_humble) writer_->forget_messages();
  tell_soon();
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
    notifier_->warn(fmt::format("topic {}: ignored a malformed message; some nodes may not be listed", kNodesTopic));
    return;
  }
  const std::lock_guard lock(mutex_);
  others_[info->participant.guidPrefix] = std::move(*info);
  warn_of_clashes();
}

void NodeGraph::participant_gone(const rtps::GuidPrefix_t& prefix) {
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
