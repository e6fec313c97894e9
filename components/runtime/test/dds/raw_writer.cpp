// SPDX-License-Identifier: Apache-2.0
#include "raw_writer.hpp"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "dds/fast_dds_transports.hpp"
#include "raw_type.hpp"

namespace panvo::runtime::test {

using namespace eprosima::fastdds::dds;

namespace {

void look_on_localhost(DomainParticipantQos& qos) {
  auto& builtin = qos.wire_protocol().builtin;
  builtin.metatrafficUnicastLocatorList.push_back(rtps::Locator_t());  // no multicast
  rtps::Locator_t this_machine;
  rtps::IPLocator::setIPv4(this_machine, "127.0.0.1");
  builtin.initialPeersList.push_back(this_machine);
  auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  udp->maxInitialPeersRange = 32;
  qos.transport().user_transports.push_back(udp);
  qos.transport().use_builtin_transports = false;
}

}  // namespace

struct RawWriter::Entities {
  DomainParticipant* participant;
  Publisher* publisher;
  Topic* topic;
  DataWriter* writer;
};

RawWriter::RawWriter(int domain, const std::string& wire_topic_name, const std::string& wire_type_name, Offer offer)
    : entities_(std::make_unique<Entities>()) {
  auto& [participant, publisher, topic, writer] = *entities_;
  DomainParticipantQos participant_qos = PARTICIPANT_QOS_DEFAULT;
  participant_qos.wire_protocol().builtin.discovery_config.leaseDuration = dds::kInfinite;
  if (offer.on_localhost) look_on_localhost(participant_qos);
  participant =
      DomainParticipantFactory::get_instance()->create_participant(static_cast<DomainId_t>(domain), participant_qos);
  TypeSupport(new RawType(wire_type_name)).register_type(participant);
  topic = participant->create_topic(wire_topic_name, wire_type_name, TOPIC_QOS_DEFAULT);
  publisher = participant->create_publisher(PUBLISHER_QOS_DEFAULT);
  DataWriterQos qos = DATAWRITER_QOS_DEFAULT;
  qos.reliability().kind = offer.reliable ? RELIABLE_RELIABILITY_QOS : BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = offer.transient_local ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
  qos.history().depth = 100;
  qos.data_sharing().off();
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  writer = publisher->create_datawriter(topic, qos);
}

RawWriter::~RawWriter() {
  entities_->participant->delete_contained_entities();
  DomainParticipantFactory::get_instance()->delete_participant(entities_->participant);
}

bool RawWriter::write(std::vector<std::uint8_t> payload) { return dds::write(*entities_->writer, &payload); }

int RawWriter::matched_readers() const {
  PublicationMatchedStatus status;
  entities_->writer->get_publication_matched_status(status);
  return status.current_count;
}

}  // namespace panvo::runtime::test
