// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "local_endpoints.hpp"
#include "node_info.hpp"
#include "notifier.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/graph.hpp"
#include "participant.hpp"

namespace panvo::runtime::dds {

/// The nodes of this and other processes, as published on ros_discovery_info. Own endpoints belong to two participants;
/// all nodes are published under one of them, with the endpoints of both, so tools list each node once. Thread-safe.
class NodeGraph : public std::enable_shared_from_this<NodeGraph> {
 public:
  NodeGraph(std::shared_ptr<Notifier> notifier, std::shared_ptr<LocalEndpoints> endpoints, std::size_t gid_size)
      : notifier_(std::move(notifier)), endpoints_(std::move(endpoints)), gid_size_(gid_size) {}

  /// Starts publishing and listening. Call each once, before the other methods.
  void open_writer(const std::shared_ptr<Participant>& writers);
  void open_reader(const std::shared_ptr<Participant>& readers);

  void set_nodes(std::vector<NodeDescription> nodes);
  void participant_gone(const eprosima::fastrtps::rtps::GuidPrefix_t& prefix);
  std::vector<GraphNode> nodes() const;

 private:
  void tell_soon();
  void tell();
  NodeInfo own_info() const;
  void take(const SamplePtr& sample);
  void warn_of_clashes() const;

  const std::shared_ptr<Notifier> notifier_;
  const std::shared_ptr<LocalEndpoints> endpoints_;
  const std::size_t gid_size_;

  mutable std::mutex mutex_;
  std::vector<NodeDescription> own_nodes_;
  std::map<eprosima::fastrtps::rtps::GuidPrefix_t, NodeInfo> others_;
  NodeInfo::Guid own_participant_;
  bool will_tell_ = false;

  std::unique_ptr<BridgeWriter> writer_;
  std::unique_ptr<BridgeReader> reader_;  // its callback is take()
};

}  // namespace panvo::runtime::dds
