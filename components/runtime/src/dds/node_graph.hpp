// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "discovery.hpp"
#include "fast_dds.hpp"
#include "local_endpoints.hpp"
#include "node_info.hpp"
#include "notifier.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/graph.hpp"
#include "participant.hpp"
#include "writer.hpp"

namespace panvo::runtime::dds {

/// The nodes of this and other processes, as published on ros_discovery_info. Thread-safe.
///
/// Humble has another format than later distributions, whose message makes Humble's nodes run out of memory; Humble's is
/// harmless to later nodes, which then list no nodes of ours. So we send Humble's as long as there is a reader of Humble.
class NodeGraph : public std::enable_shared_from_this<NodeGraph> {
 public:
  /// `is_for_humble`: always in Humble's format.
  NodeGraph(std::shared_ptr<Notifier> notifier, std::shared_ptr<LocalEndpoints> endpoints, bool is_for_humble)
      : notifier_(std::move(notifier)), endpoints_(std::move(endpoints)), is_for_humble_(is_for_humble) {}

  /// Starts publishing and listening. Call each once, before the other methods.
  void open_writer(const std::shared_ptr<Participant>& participant);
  void open_reader(const std::shared_ptr<Participant>& participant);

  /// Ends both on this thread: one of Fast DDS that holds the graph during a callback cannot, as they wait for it. No
  /// other method but those of Fast DDS's callbacks is called from then on.
  void close();

  void set_nodes(std::vector<NodeDescription> nodes);
  /// To be called before the reader meets our writer.
  void nodes_reader(const rtps::GUID_t& reader, Discovery::NodesReader what);
  void participant_gone(const rtps::GuidPrefix_t& prefix);
  std::vector<GraphNode> nodes() const;

 private:
  void tell_soon();
  void tell();
  NodeInfo own_info() const;
  void take(const SamplePtr& sample);
  void warn_of_clashes() const;

  const std::shared_ptr<Notifier> notifier_;
  const std::shared_ptr<LocalEndpoints> endpoints_;
  const bool is_for_humble_;

  mutable std::mutex mutex_;
  std::vector<NodeDescription> own_nodes_;
  std::map<rtps::GuidPrefix_t, NodeInfo> others_;
  NodeInfo::Guid own_participant_;
  bool will_tell_ = false;

  std::mutex format_mutex_;  // held while a message is written; guards the next three, except for the writer's creation
  std::set<rtps::GUID_t> humble_readers_, later_readers_;
  std::unique_ptr<Writer> writer_;
  std::unique_ptr<BridgeReader> reader_;  // its callback is take()
};

}  // namespace panvo::runtime::dds
