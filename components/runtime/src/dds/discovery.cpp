// SPDX-License-Identifier: Apache-2.0
#include "discovery.hpp"

#include <fastdds/rtps/builtin/data/ReaderProxyData.h>
#include <fastdds/rtps/builtin/data/WriterProxyData.h>
#include <spdlog/fmt/fmt.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>

#include "names.hpp"

namespace panvo::runtime::dds {

namespace fdds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace {

std::string readable_type_name(const std::string& wire_name) {
  return type_name_from_wire(wire_name).value_or(wire_name);
}

// Fast DDS reports a participant's own endpoints too.
bool is_of_this_process(const fdds::DomainParticipant& participant, const rtps::GUID_t& endpoint) {
  return participant.guid().is_on_same_process_as(endpoint);
}

// What a reader should ask for to get all that this writer offers.
interfaces::Qos offered_qos(const eprosima::fastrtps::WriterQos& offered) {
  interfaces::Qos qos;
  qos.requested = offered.m_reliability.kind == fdds::RELIABLE_RELIABILITY_QOS ? interfaces::Reliability::kReliable
                                                                               : interfaces::Reliability::kBestEffort;
  qos.durability = offered.m_durability.kind == fdds::VOLATILE_DURABILITY_QOS ? interfaces::Durability::kVolatile
                                                                              : interfaces::Durability::kTransientLocal;
  return qos;
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
  ++open_here_[local];
  for (const auto& [guid, remote] : remote_endpoints_) warn_if_types_differ(local, remote);
}

void Discovery::topic_closed(const std::string& wire_name, const std::string& wire_type_name) {
  const std::lock_guard lock(mutex_);
  const auto open = open_here_.find({wire_name, wire_type_name});
  if (--open->second == 0) open_here_.erase(open);
}

void Discovery::on_publisher_discovery(fdds::DomainParticipant* participant, rtps::WriterDiscoveryInfo&& info) {
  if (is_of_this_process(*participant, info.info.guid())) return;
  const std::lock_guard lock(mutex_);
  if (info.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER) {
    remote_endpoints_.erase(info.info.guid());
    return;
  }
  const TypedTopic remote{info.info.topicName().to_string(), info.info.typeName().to_string()};
  remember(info.info.guid(), remote);

  const auto name = topic_name_from_wire(remote.name);
  const auto type_name = type_name_from_wire(remote.type_name);
  if (name && type_name) {
    announce({*name, *type_name, offered_qos(info.info.m_qos), interfaces::find_message_type(*type_name)});
  }
}

void Discovery::on_subscriber_discovery(fdds::DomainParticipant* participant, rtps::ReaderDiscoveryInfo&& info) {
  if (is_of_this_process(*participant, info.info.guid())) return;
  const std::lock_guard lock(mutex_);
  if (info.status == rtps::ReaderDiscoveryInfo::REMOVED_READER) {
    remote_endpoints_.erase(info.info.guid());
    return;
  }
  remember(info.info.guid(), {info.info.topicName().to_string(), info.info.typeName().to_string()});
}

void Discovery::remember(const rtps::GUID_t& guid, TypedTopic remote) {
  for (const auto& [local, participants] : open_here_) warn_if_types_differ(local, remote);
  remote_endpoints_.insert_or_assign(guid, std::move(remote));
}

void Discovery::warn_if_types_differ(const TypedTopic& local, const TypedTopic& remote) {
  if (local.name != remote.name || local.type_name == remote.type_name) return;
  notifier_->warn(
      fmt::format("topic {}: is {} here and {} in another process, so nothing passes between them. Remedy: remap one "
                  "of the two, or use the same "
                  "message type in both.",
                  topic_name_from_wire(local.name).value_or(local.name), readable_type_name(local.type_name),
                  readable_type_name(remote.type_name)));
}

void Discovery::announce(const TopicDescription& written) {
  const auto [known, is_new] = written_.try_emplace(written.name, written);
  if (is_new) {
    for (const auto& watcher : watchers_) notifier_->post([watcher, written] { watcher(written); });
  } else if (known->second.type_name != written.type_name) {
    notifier_->warn(fmt::format(
        "topic {}: is written with type {} and with type {} by other processes; only the first is taken. Remedy: "
        "remap one of the two.",
        written.name, known->second.type_name, written.type_name));
  }
}

}  // namespace panvo::runtime::dds
