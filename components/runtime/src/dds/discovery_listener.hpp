// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>

#include <string>
#include <vector>

#include "fast_dds.hpp"

namespace panvo::runtime::dds {

/// A participant that another one has met, or has lost.
struct FoundParticipant {
  rtps::GUID_t guid;
  rtps::VendorId_t vendor;
  std::vector<rtps::Locator_t> ports;  ///< at which it hears announcements
  bool is_gone = false;
};

/// An endpoint that a participant has met, or has lost.
struct FoundEndpoint {
  rtps::GUID_t guid;
  std::string topic_name, type_name;  ///< as on the wire
  bool is_reliable = false, is_volatile = false;
  std::vector<rtps::octet> user_data;
  fdds::DataSharingQosPolicy data_sharing;  ///< of a reader
  std::string filter_class;                 ///< of a reader
  bool is_gone = false;
};

/// What Fast DDS tells of other participants and endpoints.
class DiscoveryListener : public fdds::DomainParticipantListener {
 private:
  virtual void on_participant(const rtps::GUID_t& own, const FoundParticipant& found) = 0;
  virtual void on_writer(const FoundEndpoint& found) = 0;
  virtual void on_reader(const FoundEndpoint& found) = 0;

#ifdef PANVO_FAST_DDS_3
  void on_participant_discovery(fdds::DomainParticipant* own, rtps::ParticipantDiscoveryStatus status,
                                const fdds::ParticipantBuiltinTopicData& data, bool& should_be_ignored) final;
  void on_data_writer_discovery(fdds::DomainParticipant* own, rtps::WriterDiscoveryStatus status,
                                const fdds::PublicationBuiltinTopicData& data, bool& should_be_ignored) final;
  void on_data_reader_discovery(fdds::DomainParticipant* own, rtps::ReaderDiscoveryStatus status,
                                const fdds::SubscriptionBuiltinTopicData& data, bool& should_be_ignored) final;
#else
  void on_participant_discovery(fdds::DomainParticipant* own, rtps::ParticipantDiscoveryInfo&& info) final;
  void on_publisher_discovery(fdds::DomainParticipant* own, rtps::WriterDiscoveryInfo&& info) final;
  void on_subscriber_discovery(fdds::DomainParticipant* own, rtps::ReaderDiscoveryInfo&& info) final;
#endif
};

}  // namespace panvo::runtime::dds
