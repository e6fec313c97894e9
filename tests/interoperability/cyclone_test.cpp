// SPDX-License-Identifier: Apache-2.0
// Another vendor's DDS as the witness: a process of Cyclone DDS, with types that its own compiler made of our IDL, reads what we write and
// writes what we read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <mutex>

#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/test_domain.hpp"
#include "panvo_messages.hpp"
#include "process.hpp"

namespace panvo::test {
namespace {

using interfaces::Durability;
using interfaces::Reliability;
using runtime::Sample;
using runtime::SamplePtr;

constexpr std::chrono::seconds kLimit(60);
constexpr int kMessages = 5;

/// A topic that the two share.
struct Subject {
  std::string topic, type;
  interfaces::Qos qos;
  SamplePtr (*sample)(int n);
  bool (*equals)(const SamplePtr& received, int n);
};

template <class Message>
Subject subject(const interfaces::Topic<Message>& topic) {
  const auto& type = interfaces::message_type<Message>();
  std::string name(topic.name);
  if (!name.starts_with("/")) name = "/" + name;
  interfaces::Qos qos = topic.qos;
  qos.requested = Reliability::kReliable;  // so that each message has to come
  return {name, std::string(type.name), qos,
          [](int n) {
            return Sample::of(interfaces::message_type<Message>(), std::make_shared<Message>(made<Message>(n)), 0);
          },
          [](const SamplePtr& received, int n) { return *Sample::as<Message>(received) == made<Message>(n); }};
}

std::ostream& operator<<(std::ostream& out, const Subject& subject) { return out << subject.topic; }

/// A process with our bridge (this one) and one with Cyclone DDS, on the loopback interface alone.
class Cyclone : public testing::TestWithParam<Subject> {
 protected:
  void SetUp() override {
    if (std::string_view(CYCLONE_PEER).empty()) GTEST_SKIP() << "built without Cyclone DDS (package cyclonedds-dev)";
    setenv("CYCLONEDDS_URI", ("file://" + std::string(CONFIG) + "/dds/cyclone_localhost.xml").c_str(), 1);
    bridge_ = runtime::make_dds_bridge(
        {.domain = domain_, .profiles = CONFIG "/dds/localhost.xml", .name = "panvo_interoperability"});
  }

  runtime::TopicDescription topic() const {
    const Subject& subject = GetParam();
    return {subject.topic, subject.type, subject.qos, interfaces::find_message_type(subject.type)};
  }

  std::vector<std::string> peer(const std::string& verb) const {
    const Subject& subject = GetParam();
    return {CYCLONE_PEER,  std::to_string(domain_),   verb,       subject.type,
            subject.topic, std::to_string(kMessages), "reliable", is_kept() ? "transient_local" : "volatile"};
  }

  static bool says(const Process& peer, const std::string& word) {
    return peer.output().find(word) != std::string::npos;
  }

  bool is_kept() const { return GetParam().qos.durability == Durability::kTransientLocal; }

  void write_all(runtime::BridgeWriter& writer) const {
    for (int n = 0; n < kMessages; ++n) ASSERT_TRUE(writer.write(GetParam().sample(n))) << n;
  }

  static void expect_all_right(Process& peer) {
    EXPECT_EQ(peer.wait(kLimit), 0) << peer.output();
    const std::string said = peer.output();
    for (int n = 0; n < kMessages; ++n) EXPECT_THAT(said, testing::HasSubstr("right " + std::to_string(n)));
    EXPECT_THAT(said, testing::Not(testing::HasSubstr("wrong")));
  }

  std::unique_ptr<runtime::BridgeReader> open_reader() {
    return bridge_->open_reader(topic(), [this](const SamplePtr& sample) {
      const std::lock_guard lock(mutex_);
      received_.push_back(sample);
      arrived_.notify_all();
    });
  }

  void expect_all_received() {
    std::unique_lock lock(mutex_);
    ASSERT_TRUE(arrived_.wait_for(lock, kLimit, [this] { return received_.size() >= kMessages; }))
        << received_.size() << " came";
    ASSERT_EQ(received_.size(), std::size_t{kMessages});
    for (int n = 0; n < kMessages; ++n) EXPECT_TRUE(GetParam().equals(received_[n], n)) << "message " << n;
  }

  const int domain_ = runtime::test_domain();
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<SamplePtr> received_;
  std::unique_ptr<runtime::Bridge> bridge_;  // goes first
};

TEST_P(Cyclone, ReadsWhatWeWrite) {
  const auto writer = bridge_->open_writer(topic());
  Process reading(peer("read"));
  // Both sides must know of each other: what comes from a writer that is not known yet is not kept.
  ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 1 && says(reading, "matched"); }, kLimit))
      << reading.output();
  // Cyclone takes what comes from the first heartbeat on, which overtakes the fragments of an image: an overture that may be lost.
  ASSERT_TRUE(writer->write(GetParam().sample(kMessages)));
  ASSERT_TRUE(writer->wait_for_acknowledgments(kLimit));
  write_all(*writer);
  expect_all_right(reading);
}

TEST_P(Cyclone, WritesWhatWeRead) {
  const auto reader = open_reader();
  Process writing(peer("write"));
  expect_all_received();
  EXPECT_EQ(reader->counters().undecodable, 0U);
}

/// On topics that are kept for those who come late.
class CycloneOnKeptTopics : public Cyclone {};

TEST_P(CycloneOnKeptTopics, ComingLateReadsWhatWasWrittenBefore) {
  const auto writer = bridge_->open_writer(topic());
  write_all(*writer);
  Process reading(peer("read"));
  expect_all_right(reading);
}

TEST_P(CycloneOnKeptTopics, HavingComeFirstIsReadByUsWhoComeLate) {
  const Process writing(peer("write"));
  ASSERT_TRUE(eventually([&] { return says(writing, "written"); }, kLimit)) << writing.output();
  const auto reader = open_reader();
  expect_all_received();
}

std::string topic_in_a_name(const testing::TestParamInfo<Subject>& tested) {
  std::string name = tested.param.topic.substr(1);
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

/// As image_transport names it.
constexpr interfaces::Topic<sensor_msgs::msg::CompressedImage> kCompressed{"panorama/image/compressed",
                                                                           interfaces::qos::kSensorData};

INSTANTIATE_TEST_SUITE_P(, Cyclone,
                         testing::Values(subject(topics::kOdometryEnhanced), subject(topics::kPanorama),
                                         subject(kCompressed), subject(topics::kTf), subject(topics::kTfStatic),
                                         subject(topics::kLandmarks)),
                         topic_in_a_name);
INSTANTIATE_TEST_SUITE_P(, CycloneOnKeptTopics,
                         testing::Values(subject(topics::kTfStatic), subject(topics::kLandmarks)), topic_in_a_name);

}  // namespace
}  // namespace panvo::test
