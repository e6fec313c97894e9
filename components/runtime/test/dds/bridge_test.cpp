// SPDX-License-Identifier: Apache-2.0
// Messages between two processes.
#include <atomic>

#include "bridge_fixture.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::runtime::test {
namespace {

constexpr std::size_t kPanoramaSize = 1080 * 540 * 3;
constexpr interfaces::Qos kLatched{.durability = interfaces::Durability::kTransientLocal, .depth = 3};

std::string size_and_hash(const Sample& sample) {
  return std::to_string(sample.bytes().size()) + " " + std::to_string(hash(sample.bytes()));
}

TEST_F(BetweenProcesses, APanoramaArrivesByteForByte) {
  const auto name = unique_topic("panorama");
  const auto reader = bridge->open_reader(topic(name, kImageType), inbox.callback());
  peer.ask("open_writer " + name + " " + kImageType + " reliable volatile 5");
  ASSERT_TRUE(peer.matches(name, 1));
  ASSERT_EQ(peer.ask("write_image " + name + " " + std::to_string(kPanoramaSize) + " 7"), "written");

  const auto samples = inbox.wait_for_count(1);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0]->bytes(), image_sample(kPanoramaSize, 7)->bytes());
  EXPECT_EQ(samples[0]->type_name(), kImageType);
  EXPECT_GT(samples[0]->time_ns(), 0);
  EXPECT_EQ(Sample::as<sensor_msgs::msg::Image>(samples[0])->header().frame_id(), "camera");
  EXPECT_EQ(reader->counters().received, 1U);
  EXPECT_EQ(reader->counters().lost, 0U);
}

TEST_F(BetweenProcesses, APanoramaIsSentByteForByteToABestEffortReader) {
  const auto name = unique_topic("panorama");
  const auto writer = bridge->open_writer(topic(name, kImageType, interfaces::qos::kSensorData));
  peer.ask("open_reader " + name + " " + kImageType + " best_effort volatile 5");
  ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 1; }) && peer.matches(name, 1));
  const auto sample = image_sample(kPanoramaSize, 8);
  ASSERT_TRUE(writer->write(sample));
  EXPECT_EQ(peer.next_received(name), size_and_hash(*sample));
}

TEST_F(BetweenProcesses, MessagesOfAReliableTopicArriveAllAndInOrder) {
  const auto name = unique_topic("text");
  const auto writer = bridge->open_writer(topic(name, kStringType, {.depth = 10, .keep_all = true}));
  peer.ask("open_reader " + name + " " + kStringType + " reliable volatile 10 keep_all");
  ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 1; }) && peer.matches(name, 1));
  // A write to a reader stalled beyond the write limit fails and is repeated.
  for (int i = 100; i < 300; ++i) {
    const auto sample = text_sample(std::to_string(i));
    ASSERT_TRUE(eventually([&] { return writer->write(sample); }));
  }
  EXPECT_TRUE(writer->wait_for_acknowledgments(kLimit));
  for (int i = 100; i < 300; ++i) ASSERT_EQ(peer.next_received(name), size_and_hash(*text_sample(std::to_string(i))));
}

TEST_F(BetweenProcesses, EndpointsOfOneProcessNeverMeet) {
  const auto name = unique_topic("text");
  const auto other_bridge = make_dds_bridge({.domain = domain, .profiles = "", .name = "second"});
  Inbox<SamplePtr> own;
  const auto reader = bridge->open_reader(topic(name, kStringType), own.callback());
  const auto writer = bridge->open_writer(topic(name, kStringType));
  const auto other_writer = other_bridge->open_writer(topic(name, kStringType));
  peer.ask("open_reader " + name + " " + kStringType + " reliable volatile 10");
  peer.ask("open_writer " + name + " " + kStringType + " reliable volatile 10");

  // Once the other process is discovered everywhere, this one would be as well.
  ASSERT_TRUE(eventually([&] {
    return writer->matched_readers() >= 1 && other_writer->matched_readers() >= 1 && reader->matched_writers() >= 1;
  }));
  ASSERT_TRUE(peer.matches(name, 1));
  ASSERT_TRUE(writer->write(text_sample("own")));
  ASSERT_TRUE(other_writer->write(text_sample("own")));
  ASSERT_TRUE(writer->wait_for_acknowledgments(kLimit) && other_writer->wait_for_acknowledgments(kLimit));
  ASSERT_EQ(peer.ask("write_text " + name + " not"), "written");

  ASSERT_EQ(own.wait_for_count(1).size(), 1U);
  EXPECT_EQ(own.items().front()->bytes(), text_sample("not")->bytes());
  EXPECT_EQ(writer->matched_readers(), 1U);
  EXPECT_EQ(reader->matched_writers(), 1U);
}

// A type with its normal codec that counts calls.
std::atomic<int> serialisations = 0;
interfaces::MessageType counting_type() {
  interfaces::MessageType type = *interfaces::find_message_type(kStringType);
  type.serialize = [](const void* message, std::span<std::uint8_t> out) {
    ++serialisations;
    interfaces::find_message_type(kStringType)->serialize(message, out);
  };
  return type;
}

TEST_F(BetweenProcesses, NothingIsSerialisedWithoutAMatchedReaderAndOnceWithTwo) {
  serialisations = 0;
  const auto type = counting_type();
  const auto message = text_sample("hey");
  const auto counted = [&] { return Sample::of(type, {message, message->message()}, 0); };
  const auto name = unique_topic("text");
  const auto writer = bridge->open_writer(topic(name, kStringType));
  ASSERT_TRUE(writer->write(counted()));
  EXPECT_EQ(serialisations, 0);

  PeerProcess second_peer(domain);
  peer.ask("open_reader " + name + " " + kStringType + " reliable volatile 10");
  second_peer.ask("open_reader " + name + " " + kStringType + " reliable volatile 10");
  ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 2; }) && peer.matches(name, 1) &&
              second_peer.matches(name, 1));
  ASSERT_TRUE(writer->write(counted()));
  EXPECT_EQ(peer.next_received(name), size_and_hash(*message));
  EXPECT_EQ(second_peer.next_received(name), size_and_hash(*message));
  EXPECT_EQ(serialisations, 1);
}

TEST_F(BetweenProcesses, ALateJoinerGetsTheNewestOfATransientLocalTopic) {
  const auto name = unique_topic("latched");
  const auto writer = bridge->open_writer(topic(name, kStringType, kLatched));
  for (const char* text : {"one", "two", "six", "ten"}) ASSERT_TRUE(writer->write(text_sample(text)));
  peer.ask("open_reader " + name + " " + kStringType + " reliable transient_local 3");
  for (const char* text : {"two", "six", "ten"}) EXPECT_EQ(peer.next_received(name), size_and_hash(*text_sample(text)));
}

TEST_F(BetweenProcesses, AKeptHistoryThatIsFullLetsTheOldestGoWhileNobodyReads) {
  const auto name = unique_topic("history");
  auto qos = kLatched;
  qos.keep_all = true;
  const auto writer = bridge->open_writer(topic(name, kStringType, qos));
  for (const char* text : {"one", "two", "six", "ten"}) ASSERT_TRUE(writer->write(text_sample(text)));
  peer.ask("open_reader " + name + " " + kStringType + " reliable transient_local 3 keep_all");
  for (const char* text : {"two", "six", "ten"}) EXPECT_EQ(peer.next_received(name), size_and_hash(*text_sample(text)));
}

TEST_F(BetweenProcesses, ALateJoinerGetsNothingOldOfAVolatileTopic) {
  const auto name = unique_topic("volatile");
  const auto writer = bridge->open_writer(topic(name, kStringType));
  ASSERT_TRUE(writer->write(text_sample("old")));
  peer.ask("open_reader " + name + " " + kStringType + " reliable volatile 3");
  ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 1; }) && peer.matches(name, 1));
  ASSERT_TRUE(writer->write(text_sample("new")));
  EXPECT_EQ(peer.next_received(name), size_and_hash(*text_sample("new")));
}

TEST_F(BetweenProcesses, AMessageOfAnUnknownTypeIsCarriedAsBytes) {
  const auto name = unique_topic("unknown");
  const std::vector<std::uint8_t> bytes{0, 1, 0, 0, 1, 2, 3, 4};
  const auto reader = bridge->open_reader(topic(name, "others_msgs/msg/Unknown"), inbox.callback());
  peer.ask("open_writer " + name + " others_msgs/msg/Unknown reliable volatile 5");
  ASSERT_TRUE(peer.matches(name, 1));
  ASSERT_EQ(peer.ask("write_bytes " + name + " 0 1 0 0 1 2 3 4"), "written");
  ASSERT_EQ(inbox.wait_for_count(1).size(), 1U);
  const auto sample = inbox.items().front();
  EXPECT_EQ(sample->type(), nullptr);
  EXPECT_EQ(sample->type_name(), "others_msgs/msg/Unknown");
  EXPECT_EQ(sample->bytes(), bytes);
}

}  // namespace
}  // namespace panvo::runtime::test
