// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "discovery_listener.hpp"
#include "notifier.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/graph.hpp"

namespace panvo::runtime::dds {

/// Tracks the endpoints of other processes: reports each published topic to watchers, and warns if the types of a topic
/// differ, which DDS ignores silently. Thread-safe.
class Discovery final : public DiscoveryListener {
 public:
  using Watcher = std::function<void(const TopicDescription&)>;

  explicit Discovery(std::shared_ptr<Notifier> notifier) : notifier_(std::move(notifier)) {}

  void watch(const Watcher& watcher);

  /// Registers a topic opened by this process, to detect other types. Wire names.
  void topic_opened(const std::string& wire_name, const std::string& wire_type_name);
  void topic_closed(const std::string& wire_name, const std::string& wire_type_name);

  std::vector<GraphEndpoint> endpoints() const;
  /// Prefixes of other processes' participants, in hexadecimal.
  std::vector<std::string> participants() const;
  /// Whether a participant is of Cyclone DDS, by the vendor that it announces.
  bool is_of_cyclone(const rtps::GuidPrefix_t& participant) const;
  /// Whether a participant of Cyclone DDS is on this host, by its addresses.
  bool is_of_cyclone_here(const rtps::GuidPrefix_t& participant) const;
  /// Which client of ROS 2 on Cyclone DDS an endpoint is of; empty if it does not say.
  std::string client_of(const rtps::GUID_t& endpoint) const;
  /// Whether a reader on this machine shares memory with us on the topic.
  bool has_sharing_reader(const std::string& wire_name) const;

  /// Whether a program other than panvo reads the topic.
  bool has_foreign_reader(const std::string& wire_name) const;

  /// Sets the callback for a participant that no participant of this process sees any longer. It may run inside Fast DDS.
  void on_participant_gone(std::function<void(const rtps::GuidPrefix_t&)> callback);

  /// What becomes known of a reader of ros_discovery_info of another process.
  enum class NodesReader { kOfHumble, kOfLaterDistribution, kGone };
  /// Sets the callback for these readers. It runs inside Fast DDS, before our writer meets the reader.
  void on_nodes_reader(std::function<void(const rtps::GUID_t&, NodesReader)> callback);

 private:
  void on_participant(const rtps::GUID_t& own, const FoundParticipant& found) override;
  void on_writer(const FoundEndpoint& found) override;
  void on_reader(const FoundEndpoint& found) override;

  struct TypedTopic {
    std::string name, type_name;  // as on the wire
    auto operator<=>(const TypedTopic&) const = default;
  };

  struct RemoteEndpoint {
    TypedTopic topic;
    GraphEndpoint shown;
    std::string client;
    bool shares = false;      // memory with us
    bool is_foreign = false;  // a reader of another program, or with a discovery server any
  };

  struct RemoteParticipant {
    std::set<rtps::GUID_t> seen_by;  // own participants: with a discovery server there are two
    std::vector<rtps::Locator_t> ports;
    bool is_of_cyclone = false;
    bool is_here = false;  // of Cyclone DDS and on this host
  };

  /// Drops participants whose ports on the same host are now used by `newcomer`.
  void let_go_replaced_by(const rtps::GUID_t& newcomer, const std::vector<rtps::Locator_t>& ports);
  void remember(const rtps::GUID_t& guid, RemoteEndpoint remote);
  void warn_if_types_differ(const TypedTopic& local, const TypedTopic& remote);
  void announce(const TopicDescription& written);

  const std::shared_ptr<Notifier> notifier_;
  mutable std::mutex mutex_;
  std::multiset<TypedTopic> open_here_;  // once for each participant that opened it
  std::map<rtps::GUID_t, RemoteEndpoint> remote_endpoints_;
  std::map<rtps::GuidPrefix_t, RemoteParticipant> remote_participants_;
  std::function<void(const rtps::GuidPrefix_t&)> on_participant_gone_;
  std::function<void(const rtps::GUID_t&, NodesReader)> on_nodes_reader_;
  std::map<std::string, TopicDescription> written_;  // by other processes, now or before
  std::vector<Watcher> watchers_;
};

}  // namespace panvo::runtime::dds
