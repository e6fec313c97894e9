// SPDX-License-Identifier: Apache-2.0
// Peers that send malformed data, stall or die.
#include <csignal>

#include "bridge_fixture.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "panvo/runtime/graph.hpp"

namespace panvo::runtime::test {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

TEST_F(BetweenProcesses, AMalformedPayloadIsCountedAndSurvived) {
  const auto name = unique_topic("text");
  const auto reader = bridge->open_reader(topic(name, kStringType), inbox.callback());
  peer.ask("open_raw_writer " + name + " " + kStringType + " reliable volatile");
  ASSERT_TRUE(peer.matches(name, 1));
  peer.ask("write_bytes " + name + " 0 3 0 0 1 2 3 4");          // a parameter list
  peer.ask("write_bytes " + name + " 0 7 0 0 1 2 3 4");          // XCDR2
  peer.ask("write_bytes " + name + " 255 255 255 255 1 2 3 4");  // unknown
  peer.ask("write_bytes " + name + " 0 1 0 0 4 0 0 0 121 101 115 0");
  ASSERT_EQ(inbox.wait_for_count(1).size(), 1U);
  EXPECT_EQ(inbox.items().front()->bytes(), text_sample("yes")->bytes());
  EXPECT_EQ(reader->counters().undecodable, 3U);
  EXPECT_EQ(reader->counters().received, 1U);
}

TEST_F(BetweenProcesses, AMessageThatIsTooLargeOrOneTooManyIsLeftOutAndCounted) {
  const auto name = unique_topic("text");
  const auto careful = make_dds_bridge({.domain = domain,
                                        .profiles = "",
                                        .name = "careful",
                                        .limits = {.max_message_bytes = 100, .max_topic_rate_hz = 1e-3}});
  careful->on_warning(warnings.callback());
  const auto reader = careful->open_reader(topic(name, kStringType, {.depth = 3}), inbox.callback());
  peer.ask("open_writer " + name + " " + kStringType + " reliable volatile 50");
  ASSERT_TRUE(peer.matches(name, 1));
  peer.ask("write_text " + name + " " + std::string(200, 'x'));
  for (int i = 0; i < 5; ++i) peer.ask("write_text " + name + " short");
  EXPECT_TRUE(eventually([&] { return reader->counters().too_fast == 2; }));
  EXPECT_EQ(reader->counters().too_large, 1U);
  EXPECT_EQ(inbox.items().size(), 3U);
  EXPECT_TRUE(is_warned_of(name, "larger than 0.0001 MB"));
  EXPECT_TRUE(is_warned_of(name, "more than 0.001 messages per second"));
}

TEST_F(BetweenProcesses, AMessageBearsTheGidOfItsWriter) {
  const auto name = unique_topic("text");
  const auto reader = bridge->open_reader(topic(name, kStringType), inbox.callback());
  peer.ask("open_writer " + name + " " + kStringType + " reliable volatile 5");
  ASSERT_TRUE(peer.matches(name, 1));
  peer.ask("write_text " + name + " one");
  ASSERT_EQ(inbox.wait_for_count(1).size(), 1U);
  std::vector<std::string> gids;
  for (const auto& endpoint : bridge->graph().endpoints) {
    if (endpoint.is_writer && endpoint.name == name) gids.push_back(endpoint.gid);
  }
  ASSERT_EQ(gids.size(), 1U);
  EXPECT_EQ(inbox.items().front()->sender(), gids.front());
}

TEST_F(BetweenProcesses, AMessageCutOffIsAnErrorToWhoeverDecodesIt) {
  const auto name = unique_topic("text");
  const auto reader = bridge->open_reader(topic(name, kStringType), inbox.callback());
  peer.ask("open_raw_writer " + name + " " + kStringType + " reliable volatile");
  ASSERT_TRUE(peer.matches(name, 1));
  peer.ask("write_bytes " + name + " 0 1 0 0 200 0 0 0 97 98");
  ASSERT_EQ(inbox.wait_for_count(1).size(), 1U);
  EXPECT_THROW(inbox.items().front()->message(), interfaces::DecodeError);
}

TEST_F(BetweenProcesses, ACallbackThatThrowsIsReportedAndCalledAgain) {
  const auto name = unique_topic("text");
  const auto reader =
      bridge->open_reader(topic(name, kStringType), [](const SamplePtr&) { throw std::runtime_error("out of luck"); });
  peer.ask("open_writer " + name + " " + kStringType + " reliable volatile 5");
  ASSERT_TRUE(peer.matches(name, 1));
  peer.ask("write_text " + name + " one");
  peer.ask("write_text " + name + " two");
  EXPECT_TRUE(eventually([&] { return reader->counters().received == 2; }));
  EXPECT_TRUE(is_warned_of(name, "out of luck"));
}

TEST_F(BetweenProcesses, WaitingForAPeerThatIsStoppedEndsAtItsLimit) {
  const auto name = unique_topic("text");
  const auto writer = bridge->open_writer(topic(name, kStringType, {.depth = 2, .keep_all = true}));
  peer.ask("open_reader " + name + " " + kStringType + " reliable volatile 2 keep_all");
  ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 1; }) && peer.matches(name, 1));
  peer.signal(SIGSTOP);
  peer.wait_until_stopped();

  EXPECT_TRUE(writer->write(text_sample("1")));
  EXPECT_TRUE(writer->write(text_sample("2")));
  auto start = Clock::now();
  EXPECT_FALSE(writer->write(text_sample("3"))) << "the history of two is full";
  EXPECT_FALSE(writer->wait_for_acknowledgments(milliseconds(200)));
  EXPECT_LT(Clock::now() - start, kLimit);

  peer.signal(SIGCONT);
  EXPECT_TRUE(writer->wait_for_acknowledgments(kLimit));
  EXPECT_TRUE(writer->write(text_sample("4")));
  EXPECT_TRUE(writer->wait_for_acknowledgments(kLimit));
}

TEST_F(BetweenProcesses, WhatAStoppedPeerMissesOfABestEffortTopicIsCounted) {
  const auto name = unique_topic("image");
  const auto writer = bridge->open_writer(topic(name, kImageType, interfaces::qos::kSensorData));
  peer.ask("open_reader " + name + " " + kImageType + " best_effort volatile 5");
  ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 1; }) && peer.matches(name, 1));
  ASSERT_TRUE(writer->write(image_sample(1000000, 0)));
  peer.next_received(name);
  peer.signal(SIGSTOP);
  peer.wait_until_stopped();
  for (std::uint32_t i = 1; i <= 60; ++i)
    ASSERT_TRUE(writer->write(image_sample(1000000, i)));  // larger than the segment
  peer.signal(SIGCONT);

  std::uint32_t written = 61;
  ASSERT_TRUE(eventually([&] {  // the next received message reveals the gap
    writer->write(image_sample(1000, ++written));
    std::istringstream counters(peer.ask("counters " + name));
    std::uint64_t received = 0, lost = 0;
    counters >> received >> lost;
    return lost > 0;
  }));
}

TEST_F(BetweenProcesses, APeerThatIsKilledHoldsNobody) {
  const auto name = unique_topic("text"), back = unique_topic("back");
  auto writer = bridge->open_writer(topic(name, kStringType, {.depth = 2, .keep_all = true}));
  auto reader = bridge->open_reader(topic(back, kStringType), inbox.callback());
  peer.ask("open_reader " + name + " " + kStringType + " reliable volatile 2 keep_all");
  peer.ask("open_writer " + back + " " + kStringType + " reliable volatile 2");
  ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 1 && reader->matched_writers() == 1; }));
  peer.signal(SIGKILL);

  const auto start = Clock::now();
  for (int i = 0; i < 5; ++i) writer->write(text_sample("to nobody"));
  EXPECT_FALSE(writer->wait_for_acknowledgments(milliseconds(100)));
  writer.reset();
  reader.reset();
  bridge.reset();
  EXPECT_LT(Clock::now() - start, kLimit);
}

}  // namespace
}  // namespace panvo::runtime::test
