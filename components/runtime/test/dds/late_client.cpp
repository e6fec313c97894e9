// SPDX-License-Identifier: Apache-2.0
#include "late_client.hpp"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "dds/names.hpp"
#include "raw_type.hpp"
#include "test_messages.hpp"

namespace panvo::runtime::test {

using namespace eprosima::fastdds::dds;

struct LateClient::Entities {
  DomainParticipant* participant;
  DataWriter* requests;
  DataReader* replies;
};

LateClient::LateClient(int domain, const std::string& service, const std::string& service_type)
    : entities_(std::make_unique<Entities>()) {
  auto& [participant, requests, replies] = *entities_;
  participant = DomainParticipantFactory::get_instance()->create_participant(static_cast<DomainId_t>(domain),
                                                                             PARTICIPANT_QOS_DEFAULT);
  const auto topic = [&, on = participant](const std::string& name, const std::string& part) {
    const auto type = dds::wire_type_name(service_type + part).value();
    TypeSupport(new RawType(type)).register_type(on);
    return on->create_topic(name, type, TOPIC_QOS_DEFAULT);
  };
  SubscriberQos shown_later = SUBSCRIBER_QOS_DEFAULT;
  shown_later.entity_factory().autoenable_created_entities = false;
  DataReaderQos reader_qos = DATAREADER_QOS_DEFAULT;
  reader_qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
  reader_qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  replies = participant->create_subscriber(shown_later)
                ->create_datareader(topic(dds::wire_reply_name(service), "_Response"), reader_qos);
  DataWriterQos writer_qos = DATAWRITER_QOS_DEFAULT;
  writer_qos.history().depth = 100;
  writer_qos.data_sharing().off();
  writer_qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  requests = participant->create_publisher(PUBLISHER_QOS_DEFAULT)
                 ->create_datawriter(topic(dds::wire_request_name(service), "_Request"), writer_qos);
}

LateClient::~LateClient() {
  entities_->participant->delete_contained_entities();
  DomainParticipantFactory::get_instance()->delete_participant(entities_->participant);
}

bool LateClient::ask(std::vector<std::uint8_t> request) {
  rtps::WriteParams params;
  params.related_sample_identity().writer_guid(entities_->replies->guid());
  return dds::write(*entities_->requests, &request, params);
}

void LateClient::show_reader() { entities_->replies->enable(); }

std::vector<std::uint8_t> LateClient::reply() {
  entities_->replies->wait_for_unread_message({static_cast<std::int32_t>(kLimit.count()), 0});
  RawType::Payload payload;
  SampleInfo info;
  entities_->replies->take_next_sample(&payload, &info);
  return payload;
}

}  // namespace panvo::runtime::test
