// SPDX-License-Identifier: Apache-2.0
#include "raw_reader.hpp"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "raw_type.hpp"

namespace panvo::runtime::test {

using namespace eprosima::fastdds::dds;

RawReader::RawReader(int domain, const std::string& wire_topic_name, const std::string& wire_type_name,
                     const std::string& user_data, std::function<void(const std::vector<std::uint8_t>&)> on_message)
    : on_message_(std::move(on_message)) {
  participant_ = DomainParticipantFactory::get_instance()->create_participant(static_cast<DomainId_t>(domain),
                                                                              PARTICIPANT_QOS_DEFAULT);
  TypeSupport(new RawType(wire_type_name)).register_type(participant_);
  auto* topic = participant_->create_topic(wire_topic_name, wire_type_name, TOPIC_QOS_DEFAULT);
  DataReaderQos qos = DATAREADER_QOS_DEFAULT;
  qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = TRANSIENT_LOCAL_DURABILITY_QOS;
  qos.history().kind = KEEP_ALL_HISTORY_QOS;
  qos.user_data().setValue(std::vector<rtps::octet>(user_data.begin(), user_data.end()));
  qos.data_sharing().off();
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  participant_->create_subscriber(SUBSCRIBER_QOS_DEFAULT)->create_datareader(topic, qos, this);
}

RawReader::~RawReader() {
  participant_->delete_contained_entities();
  DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

void RawReader::on_data_available(DataReader* reader) {
  SampleInfo info;
  for (RawType::Payload payload; reader->take_next_sample(&payload, &info) == kOk;) {
    if (info.valid_data) on_message_(payload);
  }
}

}  // namespace panvo::runtime::test
