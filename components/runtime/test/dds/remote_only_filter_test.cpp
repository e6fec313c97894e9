// SPDX-License-Identifier: Apache-2.0
#include "dds/remote_only_filter.hpp"
#include "dds/fast_dds.hpp"

#include <gtest/gtest.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "panvo/runtime/test_domain.hpp"
#include "raw_type.hpp"

namespace panvo::runtime::test {
namespace {

using Payload = RawType::Payload;

/// A participant with a writer, whose readers have the filter.
class RemoteOnlyFilter : public testing::Test {
 protected:
  RemoteOnlyFilter() {
    participant_->register_content_filter_factory(dds::kRemoteOnlyClass, &dds::remote_only_filters());
    fdds::TypeSupport(new RawType("bytes")).register_type(participant_);
    topic_ = participant_->create_topic("topic", "bytes", fdds::TOPIC_QOS_DEFAULT);
    filtered_ = participant_->create_contentfilteredtopic("filtered", topic_, dds::kRemoteOnlyExpression, {},
                                                          dds::kRemoteOnlyClass);
    fdds::DataWriterQos qos = fdds::DATAWRITER_QOS_DEFAULT;
    qos.durability().kind = fdds::TRANSIENT_LOCAL_DURABILITY_QOS;
    qos.history().depth = 2;
    qos.data_sharing().off();
    writer_ = participant_->create_publisher(fdds::PUBLISHER_QOS_DEFAULT)->create_datawriter(topic_, qos);
  }
  ~RemoteOnlyFilter() override {
    participant_->delete_contained_entities();
    fdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  fdds::DataReader* open_reader() {
    fdds::DataReaderQos qos = fdds::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = fdds::RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = fdds::TRANSIENT_LOCAL_DURABILITY_QOS;
    qos.history().depth = 2;
    qos.data_sharing().off();
    return participant_->create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT)->create_datareader(filtered_, qos);
  }

  bool write(Payload payload, rtps::GUID_t stated_writer) {
    auto params = dds::written_by(stated_writer);
    return dds::write(*writer_, &payload, params);
  }

  /// Fast DDS delivers within a process before write() returns.
  static std::vector<Payload> taken(fdds::DataReader* reader) {
    std::vector<Payload> all;
    fdds::SampleInfo info;
    for (Payload payload; reader->take_next_sample(&payload, &info) == kOk;) all.push_back(payload);
    return all;
  }

  fdds::DomainParticipant* const participant_ = fdds::DomainParticipantFactory::get_instance()->create_participant(
      static_cast<fdds::DomainId_t>(test_domain()), fdds::PARTICIPANT_QOS_DEFAULT);
  fdds::Topic* topic_ = nullptr;
  fdds::ContentFilteredTopic* filtered_ = nullptr;
  fdds::DataWriter* writer_ = nullptr;
};

TEST_F(RemoteOnlyFilter, DropsWhatAWriterOfItsParticipantWrites) {
  auto* reader = open_reader();
  ASSERT_TRUE(write({1}, writer_->guid()));
  EXPECT_EQ(taken(reader), std::vector<Payload>());
  // Of an unknown writer, and as if of another participant: the reader is connected, only the filter drops messages.
  ASSERT_TRUE(write({2}, {}));
  EXPECT_EQ(taken(reader), std::vector<Payload>{{2}});
  auto other = writer_->guid();
  ++other.guidPrefix.value[11];
  ASSERT_TRUE(write({3}, other));
  EXPECT_EQ(taken(reader), std::vector<Payload>{{3}});
}

TEST_F(RemoteOnlyFilter, DropsAKeptMessageForALateReader) {
  ASSERT_TRUE(write({1}, writer_->guid()));
  ASSERT_TRUE(write({2}, {}));
  auto* reader = open_reader();
  ASSERT_TRUE(reader->wait_for_unread_message({30, 0}));
  EXPECT_EQ(taken(reader), std::vector<Payload>{{2}});
}

}  // namespace
}  // namespace panvo::runtime::test
