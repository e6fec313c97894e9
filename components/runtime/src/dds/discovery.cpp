// SPDX-License-Identifier: Apache-2.0
#include "discovery.hpp"

#include <fastdds/rtps/builtin/data/ReaderProxyData.h>
#include <fastdds/rtps/builtin/data/WriterProxyData.h>
#include <spdlog/fmt/fmt.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>

#include <algorithm>
#include <string_view>

#include "image_sharing.hpp"
#include "names.hpp"
#include "node_info.hpp"
#include "own_participants.hpp"
#include "remote_only_filter.hpp"
#include "same_host.hpp"
#include "udp_transport.hpp"

namespace panvo::runtime::dds {

namespace fdds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace {

// Vendor ids of DDS implementations are assigned by the OMG.
constexpr rtps::VendorId_t kCyclone{0x01, 0x10};

std::string readable_type_name(const std::string& wire_name) {
  return type_name_from_wire(wire_name).value_or(wire_name);
}

// A reader's requested QoS, or the QoS a reader needs to get everything the writer offers.
template <class EndpointQos>
interfaces::Qos qos_of(const EndpointQos& endpoint) {
  interfaces::Qos qos;
  qos.requested = endpoint.m_reliability.kind == fdds::RELIABLE_RELIABILITY_QOS ? interfaces::Reliability::kReliable
                                                                                : interfaces::Reliability::kBestEffort;
  qos.durability = endpoint.m_durability.kind == fdds::VOLATILE_DURABILITY_QOS
                       ? interfaces::Durability::kVolatile
                       : interfaces::Durability::kTransientLocal;
  return qos;
}

// ROS 2 puts "typehash=RIHS01_...;" into the user data.
std::string type_hash(const std::vector<rtps::octet>& user_data) {
  constexpr std::string_view kKey = "typehash=";
  const std::string_view text(reinterpret_cast<const char*>(user_data.data()), user_data.size());
  const auto begin = text.find(kKey);
  if (begin == std::string_view::npos) return "";
  const auto value = text.substr(begin + kKey.size());
  return std::string(value.substr(0, value.find(';')));
}

// An endpoint with ROS 2 names.
template <class Proxy>
GraphEndpoint shown(Proxy& proxy, bool is_writer) {
  const std::string wire_name = proxy.topicName().to_string(), wire_type = proxy.typeName().to_string();
  GraphEndpoint endpoint{.kind = EndpointKind::kOther,
                         .name = wire_name,
                         .type_name = wire_type,
                         .is_writer = is_writer,
                         .qos = qos_of(proxy.m_qos),
                         .type_hash = type_hash(proxy.m_qos.m_userData.data_vec()),
                         .gid = hexadecimal(proxy.guid())};
  const auto type_name = type_name_from_wire(wire_type);
  if (!type_name) return endpoint;
  const auto set = [&](EndpointKind kind, const std::optional<std::string>& name) {
    if (!name) return;
    endpoint.kind = kind;
    endpoint.name = *name;
    endpoint.type_name = kind == EndpointKind::kTopic ? *type_name : service_type_name(*type_name);
  };
  set(EndpointKind::kTopic, topic_name_from_wire(wire_name));
  set(EndpointKind::kRequest, service_from_wire_request(wire_name));
  set(EndpointKind::kReply, service_from_wire_reply(wire_name));
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

void Discovery::on_participant_discovery(fdds::DomainParticipant* participant, rtps::ParticipantDiscoveryInfo&& info) {
  using Info = rtps::ParticipantDiscoveryInfo;
  const auto prefix = info.info.m_guid.guidPrefix;
  const std::lock_guard lock(mutex_);
  if (info.status != Info::REMOVED_PARTICIPANT && info.status != Info::DROPPED_PARTICIPANT) {
    const auto& listened = info.info.metatraffic_locators.unicast;
    const std::vector<rtps::Locator_t> ports(listened.begin(), listened.end());
    let_go_replaced_by(info.info.m_guid, ports);
    auto& remote = remote_participants_[prefix];
    remote.seen_by.insert(participant->guid());
    remote.ports = ports;
    remote.is_of_cyclone = info.info.m_VendorId == kCyclone;
    remote.is_here = remote.is_of_cyclone && are_on_this_host(ports);
    return;
  }
  auto& seen_by = remote_participants_[prefix].seen_by;
  seen_by.erase(participant->guid());
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

void Discovery::on_publisher_discovery(fdds::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) {
  if (is_of_this_process(info.info.guid())) return;  // Fast DDS reports a participant's own endpoints too
  const std::lock_guard lock(mutex_);
  if (info.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER) {
    remote_endpoints_.erase(info.info.guid());
    return;
  }
  const RemoteEndpoint remote{{info.info.topicName().to_string(), info.info.typeName().to_string()},
                              shown(info.info, true)};
  remember(info.info.guid(), remote);
  const auto& [kind, name, type_name, is_writer, qos, hash, gid] = remote.shown;
  if (kind == EndpointKind::kTopic) announce({name, type_name, qos, interfaces::find_message_type(type_name)});
}

void Discovery::on_subscriber_discovery(fdds::DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) {
  const auto guid = info.info.guid();
  if (is_of_this_process(guid)) return;
  const RemoteEndpoint remote{{info.info.topicName().to_string(), info.info.typeName().to_string()},
                              shown(info.info, false),
                              is_in_neighbourhood(info.info.m_qos.data_sharing),
                              std::string_view(info.info.content_filter().filter_class_name) != kRemoteOnlyClass};
  const bool is_gone = info.status == rtps::ReaderDiscoveryInfo::REMOVED_READER;
  std::function<void(const rtps::GUID_t&, NodesReader)> on_nodes_reader;
  {
    const std::lock_guard lock(mutex_);
    if (is_gone) {
      remote_endpoints_.erase(guid);
    } else {
      remember(guid, remote);
    }
    on_nodes_reader = on_nodes_reader_;
  }
  if (remote.topic.name != kNodesTopic || !on_nodes_reader) return;
  // Distributions since Iron put type hashes into the user data of their endpoints.
  on_nodes_reader(guid, is_gone                          ? NodesReader::kGone
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
