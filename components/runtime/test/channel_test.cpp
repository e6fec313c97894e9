// SPDX-License-Identifier: Apache-2.0
#include "channel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "idle_bridge.hpp"
#include "panvo/interfaces/topics.hpp"
#include "std_msgs/msg/String.h"

namespace panvo::runtime {
namespace {

using panvo_msgs::msg::LocalizationState;

TopicDescription state_topic() {
  const auto& type = interfaces::message_type<LocalizationState>();
  return {"/localization/state", std::string(type.name), topics::kLocalizationState.qos, &type};
}

struct LatchedState : testing::Test {
  std::int64_t now_ns = 0;
  Channel channel{state_topic(), nullptr, [](const std::string&) {}, [this] { return now_ns; }};
  int publisher = 0;
  int late = 0;

  LatchedState() {
    channel.add_publisher(&publisher, "localizer");
    LocalizationState state;
    state.state(panvo_msgs::msg::LocalizationState_Constants::TRACKING);
    channel.publish(Sample::of(interfaces::message_type<LocalizationState>(),
                               std::make_shared<const LocalizationState>(state), 0, nullptr));
  }
  /// Number of messages that a late joiner gets.
  int seen_late() {
    int seen = 0;
    channel.add_reader(&late, [&](const TopicDescription&, const SamplePtr&) { ++seen; });
    channel.remove_reader(&late);
    return seen;
  }
};

TEST_F(LatchedState, ReachesWhoComesLate) {
  now_ns = 2'900'000'000;
  EXPECT_EQ(seen_late(), 1);
}

TEST_F(LatchedState, DoesNotOutliveItsNode) {
  channel.remove_publisher(&publisher);
  EXPECT_EQ(seen_late(), 0);
}

TEST_F(LatchedState, GrowsTooOldWhenNobodyConfirmsIt) {
  now_ns = 3'100'000'000;
  EXPECT_EQ(seen_late(), 0);
}

using std_msgs::msg::String;
using testing::ElementsAre;

const interfaces::MessageType& text_type() { return interfaces::message_type<String>(); }

/// A topic whose late readers get all messages.
TopicDescription kept_topic(std::size_t depth = 1'000'000) {
  return {"/kept",
          std::string(text_type().name),
          {.durability = interfaces::Durability::kTransientLocal, .depth = depth, .keep_all = true},
          &text_type()};
}

std::shared_ptr<const String> message(const std::string& text) {
  String message;
  message.data(text);
  return std::make_shared<const String>(message);
}

std::string text_of(const SamplePtr& sample) { return Sample::as<String>(sample)->data(); }

/// A bridge whose only writer has as many readers as a test says.
class FakeBridge final : public IdleBridge {
 public:
  std::atomic<std::size_t> readers = 0;
  std::vector<std::string> sent;

  std::unique_ptr<BridgeWriter> open_writer(const TopicDescription&) override {
    class Writer final : public BridgeWriter {
     public:
      explicit Writer(FakeBridge& bridge) : bridge_(bridge) {}
      bool write(const SamplePtr& sample) override {
        bridge_.sent.push_back(text_of(sample));
        return true;
      }
      std::size_t matched_readers() const override { return bridge_.readers; }
      bool wait_for_acknowledgments(std::chrono::milliseconds) override { return true; }

     private:
      FakeBridge& bridge_;
    };
    return std::make_unique<Writer>(*this);
  }
};

struct KeptTopic : testing::Test {
  FakeBridge bridge;
  std::vector<std::string> warnings;
  Channel channel{kept_topic(), &bridge, [this](const std::string& text) { warnings.push_back(text); },
                  [] { return std::int64_t{0}; }};
  int publisher = 0;
  int reader = 0;

  KeptTopic() { channel.add_publisher(&publisher, "builder"); }

  void publish(const std::shared_ptr<const String>& text) { channel.publish(Sample::of(text_type(), text, 7)); }

  std::vector<std::string> seen_late() {
    std::vector<std::string> seen;
    channel.add_reader(&reader, [&](const TopicDescription&, const SamplePtr& sample) {
      EXPECT_EQ(sample->time_ns(), 7);
      seen.push_back(text_of(sample));
    });
    channel.remove_reader(&reader);
    return seen;
  }
};

TEST_F(KeptTopic, GivesALateReaderAllMessagesInOrder) {
  for (const char* text : {"a", "b", "c"}) publish(message(text));
  EXPECT_THAT(seen_late(), ElementsAre("a", "b", "c"));
  EXPECT_THAT(seen_late(), ElementsAre("a", "b", "c"));
}

TEST_F(KeptTopic, KeepsNoMessageInMemory) {
  auto large = message(std::string(10'000, 'x'));
  const std::weak_ptr<const String> published = large;
  std::vector<SamplePtr> waiting;  // of a slow reader
  channel.add_reader(&reader, [&](const TopicDescription&, const SamplePtr& sample) { waiting.push_back(sample); });
  publish(large);
  large.reset();
  EXPECT_TRUE(published.expired());
  ASSERT_EQ(waiting.size(), 1U);
  EXPECT_EQ(text_of(waiting.front()), std::string(10'000, 'x'));
}

TEST_F(KeptTopic, LeavesEachReaderItsOwnMessage) {
  std::vector<SamplePtr> first, second;
  channel.add_reader(&publisher, [&](const TopicDescription&, const SamplePtr& sample) { first.push_back(sample); });
  channel.add_reader(&reader, [&](const TopicDescription&, const SamplePtr& sample) { second.push_back(sample); });
  publish(message("a"));
  EXPECT_NE(first.at(0), second.at(0)) << "one that is read stays in memory until the slowest reader has handled it";
}

TEST_F(KeptTopic, SendsNothingBeforeAnotherProcessReadsIt) {
  publish(message("a"));
  channel.send_history();
  EXPECT_THAT(bridge.sent, ElementsAre());
}

TEST_F(KeptTopic, SendsItsHistoryOnceWhenAnotherProcessReadsIt) {
  std::vector<std::string> all;
  for (int i = 0; i < 50; ++i) publish(message(all.emplace_back(std::to_string(i))));
  bridge.readers = 1;
  channel.send_history();
  channel.send_history();
  EXPECT_EQ(bridge.sent, all);
  publish(message(all.emplace_back("new")));
  EXPECT_EQ(bridge.sent, all) << "from now on, without delay";
  bridge.readers = 2;
  channel.send_history();
  EXPECT_EQ(bridge.sent, all) << "the writer itself serves later readers";
}

TEST_F(KeptTopic, SendsEachMessageOnceThoughAReaderComesWhileTheyArePublished) {
  std::vector<std::string> all;
  for (int i = 0; i < 2000; ++i) all.push_back(std::to_string(i));
  std::thread publishing([&] {
    for (const auto& text : all) {
      publish(message(text));
      if (text == "500") bridge.readers = 1;
    }
  });
  while (bridge.readers == 0) std::this_thread::yield();
  channel.send_history();
  publishing.join();
  EXPECT_EQ(bridge.sent, all);
}

TEST_F(KeptTopic, SendsWhatIsLeftBeforeItEnds) {
  publish(message("a"));
  bridge.readers = 1;
  EXPECT_TRUE(channel.wait_for_acknowledgments(std::chrono::milliseconds(0)));
  EXPECT_THAT(bridge.sent, ElementsAre("a"));
}

TEST_F(KeptTopic, SendsAllAgainToTheReadersOfANewWriter) {
  bridge.readers = 1;
  publish(message("a"));
  channel.remove_publisher(&publisher);
  EXPECT_THAT(bridge.sent, ElementsAre("a"));
  channel.add_publisher(&publisher, "builder");
  channel.send_history();
  EXPECT_THAT(bridge.sent, ElementsAre("a", "a"));
}

TEST(LatchedHistory, KeepsMessagesInMemoryIfTheFileCannotBeMade) {
  std::vector<std::string> warnings;
  LatchedHistory history(
      kept_topic(), [] { return std::int64_t{0}; }, "/no/such/folder",
      [&](const std::string& text) { warnings.push_back(text); });
  for (const char* text : {"a", "b"}) history.add(Sample::of(text_type(), message(text), 0), true, true);
  const auto current = history.current();
  ASSERT_EQ(current.size(), 2U);
  EXPECT_EQ(text_of(current[0].sample) + text_of(current[1].sample), "ab");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], testing::HasSubstr("/kept: cannot create a file in /no/such/folder"));
}

TEST(LatchedHistory, IsBounded) {
  LatchedHistory history(
      kept_topic(2), [] { return std::int64_t{0}; }, history_folder(), [](const std::string&) {});
  for (const char* text : {"a", "b", "c"}) history.add(Sample::of(text_type(), message(text), 0), true, true);
  const auto current = history.current();
  ASSERT_EQ(current.size(), 2U);
  EXPECT_EQ(text_of(Sample::unread(current[0].sample)), "b");
  EXPECT_TRUE(history.after(3, 10).empty());
  EXPECT_EQ(history.after(2, 10).size(), 1U);
  EXPECT_EQ(history.after(0, 1).front().number, 2U);
}

TEST(HistoryFile, RefusesToReadBeyondItsEnd) {
  HistoryFile file(history_folder());
  const std::vector<std::uint8_t> bytes{1, 2, 3};
  const auto place = file.append(bytes);
  EXPECT_EQ(file.read(place), bytes);
  EXPECT_THROW(file.read({place.offset, 4}), interfaces::DecodeError);
}

}  // namespace
}  // namespace panvo::runtime
