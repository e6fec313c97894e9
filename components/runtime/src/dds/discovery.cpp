// SPDX-License-Identifier: Apache-2.0
#include "discovery.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <string_view>

#include "fast_dds.hpp"
#include "image_sharing.hpp"
#include "names.hpp"
#include "node_info.hpp"
#include "own_participants.hpp"
#include "remote_only_filter.hpp"
#include "same_host.hpp"
#include "udp_transport.hpp"

namespace panvo::runtime::dds {

namespace {

// Vendor ids of DDS implementations are assigned by the OMG.
constexpr rtps::VendorId_t kCyclone{0x01, 0x10};

std::string readable_type_name(const std::string& wire_name) {
  return type_name_from_wire(wire_name).value_or(wire_name);
}

// A reader's requested QoS, or the QoS a reader needs to get everything the writer offers.
interfaces::Qos qos_of(const FoundEndpoint& endpoint) {
  interfaces::Qos qos;
  qos.requested = endpoint.is_reliable ? interfaces::Reliability::kReliable : interfaces::Reliability::kBestEffort;
  qos.durability = endpoint.is_volatile ? interfaces::Durability::kVolatile : interfaces::Durability::kTransientLocal;
  return qos;
}

// ROS 2 puts "typehash=RIHS01_...;" into the user data; on Cyclone DDS, both endpoints of a client have the same
// "clientid=...;".
std::string value_in(const std::vector<rtps::octet>& user_data, std::string_view key) {
  const std::string_view text(reinterpret_cast<const char*>(user_data.data()), user_data.size());
  const auto begin = text.find(key);
  if (begin == std::string_view::npos) return "";
  const auto value = text.substr(begin + key.size());
  return std::string(value.substr(0, value.find(';')));
}
std::string type_hash(const FoundEndpoint& found) { return value_in(found.user_data, "typehash="); }
std::string client(const FoundEndpoint& found) { return value_in(found.user_data, "clientid="); }

// An endpoint with ROS 2 names.
GraphEndpoint shown(const FoundEndpoint& found, bool is_writer) {
  GraphEndpoint endpoint{.kind = EndpointKind::kOther,
                         .name = found.topic_name,
                         .type_name = found.type_name,
                         .is_writer = is_writer,
                         .qos = qos_of(found),
                         .type_hash = type_hash(found),
                         .gid = hexadecimal(found.guid)};
  const auto type_name = type_name_from_wire(found.type_name);
  if (!type_name) return endpoint;
  const auto set = [&](EndpointKind kind, const std::optional<std::string>& name) {
    if (!name) return;
    endpoint.kind = kind;
    endpoint.name = *name;
    endpoint.type_name = kind == EndpointKind::kTopic ? *type_name : service_type_name(*type_name);
  };
  set(EndpointKind::kTopic, topic_name_from_wire(found.topic_name));
  set(EndpointKind::kRequest, service_from_wire_request(found.topic_name));
  set(EndpointKind::kReply, service_from_wire_reply(found.topic_name));
  return endpoint;
}

}  // namespace

void Discovery::watch(const Watcher& watcher) {
  const std::lock_guard lock(mutex_);
  watchers_.push_back(watcher);
  for (const auto& [name, topic] : written_) notifier_->post([watcher, known = topic] { watcher(known); });
}

void Discovery::topic_opened(const std::string& wire_name, const std::string& wire_type_name) {
  const std::lock_guard lock(mutex_);
  const TypedTopic local{wire_name, wire_type_name};
  open_here_.insert(local);
  for (const auto& [guid, remote] : remote_endpoints_) warn_if_types_differ(local, remote.topic);
}

void Discovery::topic_closed(const std::string& wire_name, const std::string& wire_type_name) {
  const std::lock_guard lock(mutex_);
  open_here_.erase(open_here_.find({wire_name, wire_type_name}));
}

std::vector<GraphEndpoint> Discovery::endpoints() const {
  const std::lock_guard lock(mutex_);
  std::vector<GraphEndpoint> endpoints;
  for (const auto& [guid, endpoint] : remote_endpoints_) endpoints.push_back(endpoint.shown);
  return endpoints;
}

std::vector<std::string> Discovery::participants() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> participants;
  for (const auto& [prefix, participant] : remote_participants_) {
    const rtps::GUID_t guid(prefix, rtps::c_EntityId_RTPSParticipant);
    if (!is_of_this_process(guid)) participants.push_back(hexadecimal(guid).substr(0, 2 * rtps::GuidPrefix_t::size));
  }
  return participants;
}

bool Discovery::is_of_cyclone(const rtps::GuidPrefix_t& participant) const {
  const std::lock_guard lock(mutex_);
  const auto found = remote_participants_.find(participant);
  return found != remote_participants_.end() && found->second.is_of_cyclone;
}

bool Discovery::is_of_cyclone_here(const rtps::GuidPrefix_t& participant) const {
  const std::lock_guard lock(mutex_);
  const auto found = remote_participants_.find(participant);
  return found != remote_participants_.end() && found->second.is_here;
}

std::string Discovery::client_of(const rtps::GUID_t& endpoint) const {
  const std::lock_guard lock(mutex_);
  const auto found = remote_endpoints_.find(endpoint);
  return found == remote_endpoints_.end() ? "" : found->second.client;
}

bool Discovery::has_sharing_reader(const std::string& wire_name) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(remote_endpoints_, [&](const auto& known) {
    const RemoteEndpoint& endpoint = known.second;
    return endpoint.shares && !endpoint.shown.is_writer && endpoint.topic.name == wire_name;
  });
}

bool Discovery::has_foreign_reader(const std::string& wire_name) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(remote_endpoints_, [&](const auto& known) {
    const RemoteEndpoint& endpoint = known.second;
    return endpoint.is_foreign && endpoint.topic.name == wire_name;
  });
}

void Discovery::on_participant_gone(std::function<void(const rtps::GuidPrefix_t&)> callback) {
  const std::lock_guard lock(mutex_);
  on_participant_gone_ = std::move(callback);
}

void Discovery::on_participant(const rtps::GUID_t& own, const FoundParticipant& found) {
  const auto prefix = found.guid.guidPrefix;
  const std::lock_guard lock(mutex_);
  if (!found.is_gone) {
    let_go_replaced_by(found.guid, found.ports);
    auto& remote = remote_participants_[prefix];
    remote.seen_by.insert(own);
    remote.ports = found.ports;
    remote.is_of_cyclone = found.vendor == kCyclone;
    remote.is_here = remote.is_of_cyclone && are_on_this_host(found.ports);
    return;
  }
  auto& seen_by = remote_participants_[prefix].seen_by;
  seen_by.erase(own);
  if (!seen_by.empty()) return;
  remote_participants_.erase(prefix);
  if (on_participant_gone_) on_participant_gone_(prefix);
}

void Discovery::let_go_replaced_by(const rtps::GUID_t& newcomer, const std::vector<rtps::Locator_t>& ports) {
  if (ports.empty()) return;
  for (const auto& [prefix, known] : remote_participants_) {
    const rtps::GUID_t guid(prefix, rtps::c_EntityId_RTPSParticipant);
    if (prefix != newcomer.guidPrefix && known.ports == ports && is_on_same_host(newcomer, guid))
      let_go_replaced(prefix);
  }
}

void Discovery::on_writer(const FoundEndpoint& found) {
  if (is_of_this_process(found.guid)) return;  // Fast DDS reports a participant's own endpoints too
  const std::lock_guard lock(mutex_);
  if (found.is_gone) {
    remote_endpoints_.erase(found.guid);
    return;
  }
  const RemoteEndpoint remote{{found.topic_name, found.type_name}, shown(found, true), client(found)};
  remember(found.guid, remote);
  const auto& [kind, name, type_name, is_writer, qos, hash, gid] = remote.shown;
  if (kind == EndpointKind::kTopic) announce({name, type_name, qos, interfaces::find_message_type(type_name)});
}

void Discovery::on_reader(const FoundEndpoint& found) {
  if (is_of_this_process(found.guid)) return;
  const RemoteEndpoint remote{{found.topic_name, found.type_name},
                              shown(found, false),
                              client(found),
                              is_in_neighbourhood(found.data_sharing),
                              found.filter_class != kRemoteOnlyClass};
  std::function<void(const rtps::GUID_t&, NodesReader)> on_nodes_reader;
  {
    const std::lock_guard lock(mutex_);
    if (found.is_gone) {
      remote_endpoints_.erase(found.guid);
    } else {
      remember(found.guid, remote);
    }
    on_nodes_reader = on_nodes_reader_;
  }
  if (remote.topic.name != kNodesTopic || !on_nodes_reader) return;
  // Distributions since Iron put type hashes into the user data of their endpoints.
  on_nodes_reader(found.guid, found.is_gone                    ? NodesReader::kGone
                              : remote.shown.type_hash.empty() ? NodesReader::kOfHumble
                                                               : NodesReader::kOfLaterDistribution);
}

void Discovery::on_nodes_reader(std::function<void(const rtps::GUID_t&, NodesReader)> callback) {
  const std::lock_guard lock(mutex_);
  on_nodes_reader_ = std::move(callback);
}

void Discovery::remember(const rtps::GUID_t& guid, RemoteEndpoint remote) {
  for (const auto& local : open_here_) warn_if_types_differ(local, remote.topic);
  remote_endpoints_.insert_or_assign(guid, std::move(remote));
}

void Discovery::warn_if_types_differ(const TypedTopic& local, const TypedTopic& remote) {
  if (local.name != remote.name || local.type_name == remote.type_name) return;
  notifier_->warn(
      fmt::format("topic {}: has type {} here and {} in another process, so no messages are exchanged. Remedy: remap "
                  "one of the two, or use the same message type in both.",
                  topic_name_from_wire(local.name).value_or(local.name), readable_type_name(local.type_name),
                  readable_type_name(remote.type_name)));
}

void Discovery::announce(const TopicDescription& written) {
  const auto [known, is_new] = written_.try_emplace(written.name, written);
  if (is_new) {
    for (const auto& watcher : watchers_) notifier_->post([watcher, written] { watcher(written); });
  } else if (known->second.type_name != written.type_name) {
    notifier_->warn(fmt::format(
        "topic {}: is published with type {} and with type {} by other processes; only the first is used. Remedy: "
        "remap one of the two.",
        written.name, known->second.type_name, written.type_name));
  }
}

}  // namespace panvo::runtime::dds
