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
#include "peer_process.hpp"
#include "raw_type.hpp"

namespace panvo::runtime::test {
namespace {

using Payload = RawType::Payload;

/// A participant with a writer, whose readers have the filter, and another participant with a writer.
class RemoteOnlyFilter : public testing::Test {
 protected:
  RemoteOnlyFilter() {
    participant_->register_content_filter_factory(dds::kRemoteOnlyClass, &dds::remote_only_filters());
    writer_ = open_writer(*participant_);
    other_writer_ = open_writer(*other_);
    filtered_ = participant_->create_contentfilteredtopic("filtered", writer_->get_topic(), dds::kRemoteOnlyExpression,
                                                          {}, dds::kRemoteOnlyClass);
  }
  ~RemoteOnlyFilter() override {
    for (auto* participant : {participant_, other_}) {
      participant->delete_contained_entities();
      fdds::DomainParticipantFactory::get_instance()->delete_participant(participant);
    }
  }

  static fdds::DomainParticipant* open_participant() {
    return fdds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<fdds::DomainId_t>(test_domain()), fdds::PARTICIPANT_QOS_DEFAULT);
  }

  static fdds::DataWriter* open_writer(fdds::DomainParticipant& participant) {
    fdds::TypeSupport(new RawType("bytes")).register_type(&participant);
    auto* topic = participant.create_topic("topic", "bytes", fdds::TOPIC_QOS_DEFAULT);
    fdds::DataWriterQos qos = fdds::DATAWRITER_QOS_DEFAULT;
    qos.durability().kind = fdds::TRANSIENT_LOCAL_DURABILITY_QOS;
    qos.history().depth = 2;
    qos.data_sharing().off();
    return participant.create_publisher(fdds::PUBLISHER_QOS_DEFAULT)->create_datawriter(topic, qos);
  }

  fdds::DataReader* open_reader() {
    fdds::DataReaderQos qos = fdds::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = fdds::RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = fdds::TRANSIENT_LOCAL_DURABILITY_QOS;
    qos.history().depth = 2;
    qos.data_sharing().off();
    return participant_->create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT)->create_datareader(filtered_, qos);
  }

  /// Writes as the runtime does.
  static bool write(fdds::DataWriter& writer, Payload payload) {
    auto params = dds::written_by(writer.guid());
    return dds::write(writer, &payload, params);
  }

  /// Waits until the writer's reader has, or has refused, all of its messages.
  static bool has_settled(fdds::DataWriter& writer) {
    const auto is_matched = [&] {
      fdds::PublicationMatchedStatus status;
      writer.get_publication_matched_status(status);
      return status.current_count == 1;
    };
    return eventually(is_matched) && writer.wait_for_acknowledgments({30, 0}) == kOk;
  }

  static std::vector<Payload> taken(fdds::DataReader* reader) {
    std::vector<Payload> all;
    fdds::SampleInfo info;
    for (Payload payload; reader->take_next_sample(&payload, &info) == kOk;) all.push_back(payload);
    return all;
  }

  fdds::DomainParticipant* const participant_ = open_participant();
  fdds::DomainParticipant* const other_ = open_participant();
  fdds::DataWriter* writer_ = nullptr;
  fdds::DataWriter* other_writer_ = nullptr;
  fdds::ContentFilteredTopic* filtered_ = nullptr;
};

TEST_F(RemoteOnlyFilter, DropsWhatAWriterOfItsParticipantWrites) {
  auto* reader = open_reader();
  ASSERT_TRUE(has_settled(*writer_) && has_settled(*other_writer_));
  ASSERT_TRUE(write(*writer_, {1}));
  ASSERT_TRUE(write(*other_writer_, {2}));
  ASSERT_TRUE(has_settled(*writer_) && has_settled(*other_writer_));
  EXPECT_EQ(taken(reader), std::vector<Payload>{{2}});
}

TEST_F(RemoteOnlyFilter, DropsAKeptMessageForALateReader) {
  ASSERT_TRUE(write(*writer_, {1}));
  ASSERT_TRUE(write(*other_writer_, {2}));
  auto* reader = open_reader();
  ASSERT_TRUE(has_settled(*writer_) && has_settled(*other_writer_));
  EXPECT_EQ(taken(reader), std::vector<Payload>{{2}});
}

}  // namespace
}  // namespace panvo::runtime::test
