// SPDX-License-Identifier: Apache-2.0
// Reports on topics of other processes.
#include "bridge_fixture.hpp"

namespace panvo::runtime::test {
namespace {

class DiscoveredTopics : public BetweenProcesses {
 protected:
  ~DiscoveredTopics() override { bridge.reset(); }  // before `topics`, which its callbacks fill

  Inbox<TopicDescription> topics;

  std::optional<TopicDescription> found(const std::string& name) {
    if (!topics.wait_for([&](const TopicDescription& found) { return found.name == name; })) return std::nullopt;
    for (const auto& topic : topics.items()) {
      if (topic.name == name) return topic;
    }
    return std::nullopt;
  }
};

TEST_F(DiscoveredTopics, AreToldOnceWithTypeAndQosOfTheirWriter) {
  const auto sensor = unique_topic("sensor"), latched = unique_topic("latched"), last = unique_topic("last");
  bridge->watch_topics(topics.callback());
  const auto own_writer = bridge->open_writer(topic(unique_topic("own"), kStringType));
  PeerProcess second_peer(domain);
  peer.ask("open_raw_writer " + sensor + " " + kImageType + " best_effort volatile");
  peer.ask("open_writer " + latched + " " + kStringType + " reliable transient_local 5");
  second_peer.ask("open_writer " + latched + " " + kStringType + " reliable transient_local 5");
  ASSERT_TRUE(found(sensor));
  ASSERT_TRUE(found(latched));
  second_peer.ask("open_writer " + last + " " + kStringType + " reliable volatile 5");
  ASSERT_TRUE(found(last));

  EXPECT_EQ(found(sensor)->type_name, kImageType);
  EXPECT_EQ(found(sensor)->type, interfaces::find_message_type(kImageType));
  EXPECT_EQ(found(sensor)->qos.requested, interfaces::Reliability::kBestEffort);
  EXPECT_EQ(found(sensor)->qos.durability, interfaces::Durability::kVolatile);
  EXPECT_EQ(found(latched)->qos.requested, interfaces::Reliability::kReliable);
  EXPECT_EQ(found(latched)->qos.durability, interfaces::Durability::kTransientLocal);
  std::map<std::string, int> times;
  for (const auto& topic : topics.items()) ++times[topic.name];
  EXPECT_EQ(times[latched], 1);
  EXPECT_EQ(times.count(unique_topic("own")), 0U);
}

TEST_F(DiscoveredTopics, IncludeThoseThatWereThereBefore) {
  const auto name = unique_topic("early");
  peer.ask("open_writer " + name + " " + kStringType + " reliable volatile 5");
  const auto reader = bridge->open_reader(topic(name, kStringType), inbox.callback());
  ASSERT_TRUE(eventually([&] { return reader->matched_writers() == 1; }));
  bridge->watch_topics(topics.callback());
  EXPECT_TRUE(found(name));
}

TEST_F(DiscoveredTopics, OfAnUnknownTypeHaveNone) {
  const auto name = unique_topic("unknown");
  bridge->watch_topics(topics.callback());
  peer.ask("open_writer " + name + " others_msgs/msg/Unknown reliable volatile 5");
  ASSERT_TRUE(found(name));
  EXPECT_EQ(found(name)->type_name, "others_msgs/msg/Unknown");
  EXPECT_EQ(found(name)->type, nullptr);
}

TEST_F(DiscoveredTopics, MayBeOpenedFromTheCallback) {
  const auto name = unique_topic("recorded");
  Inbox<SamplePtr> recorded;
  std::vector<std::unique_ptr<BridgeReader>> readers;
  bridge->watch_topics([&](const TopicDescription& topic) {
    if (topic.name == name) readers.push_back(bridge->open_reader(topic, recorded.callback()));
  });
  peer.ask("open_writer " + name + " " + kStringType + " reliable transient_local 5");
  ASSERT_EQ(peer.ask("write_text " + name + " kept"), "written");
  EXPECT_EQ(recorded.wait_for_count(1).size(), 1U);
  bridge.reset();  // no callback uses `readers` afterwards
}

TEST_F(BetweenProcesses, AKilledProcessIsLetGoWhenItsPortsAreTakenByAnother) {
  const auto before = unique_topic("before"), after = unique_topic("after");
  const auto reader_before = bridge->open_reader(topic(before, kStringType), inbox.callback());
  const auto reader_after = bridge->open_reader(topic(after, kStringType), inbox.callback());
  peer.ask("open_raw_writer " + before + " " + kStringType + " reliable volatile");
  ASSERT_TRUE(eventually([&] { return reader_before->matched_writers() == 1; }));
  peer.kill_and_wait();
  PeerProcess newcomer(domain);
  newcomer.ask("open_raw_writer " + after + " " + kStringType + " reliable volatile");
  EXPECT_TRUE(eventually([&] { return reader_after->matched_writers() == 1; }));
  EXPECT_TRUE(eventually([&] { return reader_before->matched_writers() == 0; }));
}

TEST_F(BetweenProcesses, AProcessBesideAnotherIsNotTakenForItsReplacement) {
  const auto name = unique_topic("both");
  const auto reader = bridge->open_reader(topic(name, kStringType), inbox.callback());
  PeerProcess second_peer(domain);
  for (auto* process : {&peer, &second_peer})
    process->ask("open_raw_writer " + name + " " + kStringType + " reliable volatile");
  EXPECT_TRUE(eventually([&] { return reader->matched_writers() == 2; }));
}

TEST_F(BetweenProcesses, AnotherTypeOnTheSameTopicIsWarnedOf) {
  const auto here_first = unique_topic("here_first"), there_first = unique_topic("there_first");
  const auto reader = bridge->open_reader(topic(here_first, kImageType), inbox.callback());
  peer.ask("open_writer " + here_first + " " + kStringType + " reliable volatile 5");
  EXPECT_TRUE(is_warned_of(here_first, kStringType));
  EXPECT_EQ(reader->matched_writers(), 0U);

  peer.ask("open_reader " + there_first + " " + kStringType + " reliable volatile 5");
  const auto writer = bridge->open_writer(topic(there_first, kImageType));
  EXPECT_TRUE(is_warned_of(there_first, "Remedy"));
}

TEST_F(BetweenProcesses, AReaderThatAsksForMoreThanAWriterOffersIsWarnedOf) {
  const auto reliability = unique_topic("reliability"), durability = unique_topic("durability");
  const auto reliable = bridge->open_reader(topic(reliability, kStringType), inbox.callback());
  peer.ask("open_raw_writer " + reliability + " " + kStringType + " best_effort volatile");
  EXPECT_TRUE(is_warned_of(reliability, "best effort"));

  const auto writer = bridge->open_writer(topic(durability, kStringType));
  peer.ask("open_reader " + durability + " " + kStringType + " reliable transient_local 5");
  EXPECT_TRUE(is_warned_of(durability, "transient local"));
}

TEST_F(BetweenProcesses, AWarningThatNobodyHeardIsToldToWhoeverAsksFirst) {
  const auto name = unique_topic("text");
  const auto silent = make_dds_bridge({.domain = domain, .profiles = "", .name = "silent"});
  peer.ask("open_writer " + name + " " + kStringType + " reliable volatile 5");
  const auto reader = silent->open_reader(topic(name, kImageType), inbox.callback());
  const auto own_reader = bridge->open_reader(topic(name, kImageType), inbox.callback());
  ASSERT_TRUE(is_warned_of(name, kStringType));
  Inbox<std::string> late;
  silent->on_warning(late.callback());
  EXPECT_TRUE(late.wait_for([&](const std::string& text) { return text.find(name) != std::string::npos; }));
}

}  // namespace
}  // namespace panvo::runtime::test
