// SPDX-License-Identifier: Apache-2.0
#include "discovery_listener.hpp"

#ifndef PANVO_FAST_DDS_3
#include <fastdds/rtps/builtin/data/ReaderProxyData.h>
#include <fastdds/rtps/builtin/data/WriterProxyData.h>
#endif

namespace panvo::runtime::dds {

#ifdef PANVO_FAST_DDS_3

namespace {

template <class Data>
FoundEndpoint found(const Data& data, bool is_gone) {
  return {.guid = data.guid,
          .topic_name = data.topic_name.to_string(),
          .type_name = data.type_name.to_string(),
          .is_reliable = data.reliability.kind == fdds::RELIABLE_RELIABILITY_QOS,
          .is_volatile = data.durability.kind == fdds::VOLATILE_DURABILITY_QOS,
          .user_data = data.user_data.data_vec(),
          .data_sharing = {},
          .filter_class = {},
          .is_gone = is_gone};
}

}  // namespace

void DiscoveryListener::on_participant_discovery(fdds::DomainParticipant* own, rtps::ParticipantDiscoveryStatus status,
                                                 const fdds::ParticipantBuiltinTopicData& data, bool&) {
  const auto& ports = data.metatraffic_locators.unicast;
  on_participant(own->guid(), {.guid = data.guid,
                               .vendor = data.vendor_id,
                               .ports = {ports.begin(), ports.end()},
                               .is_gone = status == rtps::ParticipantDiscoveryStatus::REMOVED_PARTICIPANT ||
                                          status == rtps::ParticipantDiscoveryStatus::DROPPED_PARTICIPANT});
}

void DiscoveryListener::on_data_writer_discovery(fdds::DomainParticipant*, rtps::WriterDiscoveryStatus status,
                                                 const fdds::PublicationBuiltinTopicData& data, bool&) {
  on_writer(found(data, status == rtps::WriterDiscoveryStatus::REMOVED_WRITER));
}

void DiscoveryListener::on_data_reader_discovery(fdds::DomainParticipant*, rtps::ReaderDiscoveryStatus status,
                                                 const fdds::SubscriptionBuiltinTopicData& data, bool&) {
  auto reader = found(data, status == rtps::ReaderDiscoveryStatus::REMOVED_READER);
  reader.data_sharing = data.data_sharing;
  reader.filter_class = data.content_filter.filter_class_name.to_string();
  on_reader(reader);
}

#else

namespace {

template <class Proxy>
FoundEndpoint found(Proxy& proxy, bool is_gone) {
  return {.guid = proxy.guid(),
          .topic_name = proxy.topicName().to_string(),
          .type_name = proxy.typeName().to_string(),
          .is_reliable = proxy.m_qos.m_reliability.kind == fdds::RELIABLE_RELIABILITY_QOS,
          .is_volatile = proxy.m_qos.m_durability.kind == fdds::VOLATILE_DURABILITY_QOS,
          .user_data = proxy.m_qos.m_userData.data_vec(),
          .data_sharing = {},
          .filter_class = {},
          .is_gone = is_gone};
}

}  // namespace

void DiscoveryListener::on_participant_discovery(fdds::DomainParticipant* own, rtps::ParticipantDiscoveryInfo&& info) {
  using Info = rtps::ParticipantDiscoveryInfo;
  const auto& ports = info.info.metatraffic_locators.unicast;
  on_participant(own->guid(),
                 {.guid = info.info.m_guid,
                  .vendor = info.info.m_VendorId,
                  .ports = {ports.begin(), ports.end()},
                  .is_gone = info.status == Info::REMOVED_PARTICIPANT || info.status == Info::DROPPED_PARTICIPANT});
}

void DiscoveryListener::on_publisher_discovery(fdds::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) {
  on_writer(found(info.info, info.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER));
}

void DiscoveryListener::on_subscriber_discovery(fdds::DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) {
  auto reader = found(info.info, info.status == rtps::ReaderDiscoveryInfo::REMOVED_READER);
  reader.data_sharing = info.info.m_qos.data_sharing;
  reader.filter_class = info.info.content_filter().filter_class_name.to_string();
  on_reader(reader);
}

#endif

}  // namespace panvo::runtime::dds
