// SPDX-License-Identifier: Apache-2.0
// A channel and the endpoints of its bridge: when they are opened and closed, and what happens meanwhile.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "channel.hpp"
#include "idle_bridge.hpp"
#include "panvo/runtime/errors.hpp"
#include "std_msgs/msg/String.h"

namespace panvo::runtime {
namespace {

using interfaces::Durability;
using interfaces::Qos;
using interfaces::Reliability;
using std_msgs::msg::String;
using testing::ElementsAre;

TopicDescription text_topic(const Qos& qos = {}) {
  const auto& type = interfaces::message_type<String>();
  return {"/text", std::string(type.name), qos, &type};
}

/// A message of another process.
SamplePtr received() { return Sample::from_bytes(text_topic().type, text_topic().type_name, to_bytes(String()), 1); }

/// A bridge whose endpoints do what a test says, and which counts those that are open.
class ScriptedBridge : public IdleBridge {
 public:
  std::function<void()> while_writer_opens = [] {}, while_writer_closes = [] {}, while_reader_is_asked = [] {};
  std::function<void()> while_writer_writes = [] {};
  std::vector<Qos> opened_readers;
  std::atomic<int> writers = 0, readers = 0;
  bool has_latched = false;  // a message of another process, for each new reader
  std::function<void(SamplePtr)> receive;

  std::unique_ptr<BridgeWriter> open_writer(const TopicDescription&) override {
    while_writer_opens();
    return std::make_unique<Writer>(*this);
  }
  std::unique_ptr<BridgeReader> open_reader(const TopicDescription& topic,
                                            std::function<void(SamplePtr)> on_sample) override {
    receive = std::move(on_sample);
    opened_readers.push_back(topic.qos);
    auto reader = std::make_unique<Reader>(*this);
    if (has_latched) receive(received());
    return reader;
  }

 private:
  struct Writer final : BridgeWriter {
    explicit Writer(ScriptedBridge& a_bridge) : bridge(a_bridge) { ++bridge.writers; }
    ~Writer() override {
      bridge.while_writer_closes();
      --bridge.writers;
    }
    bool write(const SamplePtr&) override {
      bridge.while_writer_writes();
      return true;
    }
    std::size_t matched_readers() const override { return 0; }
    bool wait_for_acknowledgments(std::chrono::milliseconds) override { return true; }
    ScriptedBridge& bridge;
  };
  struct Reader final : BridgeReader {
    explicit Reader(ScriptedBridge& a_bridge) : bridge(a_bridge) { ++bridge.readers; }
    ~Reader() override { --bridge.readers; }
    std::size_t matched_writers() const override {
      bridge.while_reader_is_asked();
      return 0;
    }
    BridgeReaderCounters counters() const override { return {}; }
    ScriptedBridge& bridge;
  };
};

struct BridgedChannel : testing::Test {
  ScriptedBridge bridge;
  Channel channel{text_topic(), &bridge, [](const std::string&) {}, [] { return std::int64_t{0}; }};
  int first = 0, second = 0, recorder = 0;  // owners
  static void ignore(const TopicDescription&, const SamplePtr&) {}
};

/// Fast DDS opens and closes a writer once its receiving thread has delivered.
TEST_F(BridgedChannel, ReceivesWhileItsWriterIsOpenedAndClosed) {
  std::atomic<int> seen = 0;
  channel.add_reader(&first, [&](const TopicDescription&, const SamplePtr&) { ++seen; });
  std::vector<std::future<void>> deliveries;
  std::vector<bool> are_delivered;
  bridge.while_writer_opens = bridge.while_writer_closes = [&] {
    deliveries.push_back(std::async(std::launch::async, [&] { bridge.receive(received()); }));
    are_delivered.push_back(deliveries.back().wait_for(std::chrono::seconds(10)) == std::future_status::ready);
  };
  channel.add_publisher(&second, "writer");
  channel.remove_publisher(&second);
  EXPECT_THAT(are_delivered, ElementsAre(true, true));
  deliveries.clear();  // joins
  EXPECT_EQ(seen, 2);
}

/// To write, Fast DDS may wait for its receiving thread, which delivers, and that for one who changes the readers.
TEST_F(BridgedChannel, LetsReadersComeAndGoWhileItWrites) {
  channel.add_publisher(&first, "writer");
  std::future<void> change;
  bool is_changed = false;
  bridge.while_writer_writes = [&] {
    change = std::async(std::launch::async, [&] {
      channel.add_reader(&second, ignore);
      channel.remove_reader(&second);
    });
    is_changed = change.wait_for(std::chrono::seconds(10)) == std::future_status::ready;
  };
  channel.publish(received());
  EXPECT_TRUE(is_changed);
}

TEST_F(BridgedChannel, HasNoPublisherWhoseWriterCannotBeOpened) {
  bridge.while_writer_opens = [] { throw ConfigError("no writer"); };
  EXPECT_THROW(channel.add_publisher(&first, "first"), ConfigError);
  EXPECT_FALSE(channel.is_published_by("first"));
  bridge.while_writer_opens = [] {};
  channel.add_publisher(&second, "second", Qos{.depth = 3});
  EXPECT_EQ(bridge.writers, 1);
}

TEST_F(BridgedChannel, HasOneWriterForPublishersThatComeAndGoAtOnce) {
  std::atomic<int> most = 0;
  bridge.while_writer_opens = [&] { most = std::max<int>(most, bridge.writers + 1); };
  const auto come_and_go = [&](const int* owner) {
    for (int i = 0; i < 1000; ++i) {
      channel.add_publisher(owner, "publisher");
      if (bridge.writers != 1) most = -1;
      channel.remove_publisher(owner);
    }
  };
  std::thread other(come_and_go, &second);
  come_and_go(&first);
  other.join();
  EXPECT_EQ(most, 1);
  EXPECT_EQ(bridge.writers, 0);
}

/// The last reader leaves while the bridge's reader is in use, so that another can come before it is closed.
TEST_F(BridgedChannel, ReceivesForAReaderThatComesWhileTheLastLeaves) {
  for (int round = 0; round < 50; ++round) {
    channel.add_reader(&first, ignore);
    std::thread leaving;
    std::atomic<bool> leaves = false;
    bridge.while_reader_is_asked = [&] {
      leaving = std::thread([&] {
        leaves = true;
        leaves.notify_one();
        channel.remove_reader(&first);
      });
      leaves.wait(false);
      for (int i = 0; i < 1000 && channel.has_readers(); ++i) std::this_thread::yield();
    };
    channel.counters();
    channel.add_reader(&second, ignore);
    leaving.join();
    ASSERT_EQ(bridge.readers, 1);
    channel.remove_reader(&second);
    ASSERT_EQ(bridge.readers, 0);
  }
}

constexpr Qos kBestEffort{.requested = Reliability::kBestEffort};

TEST_F(BridgedChannel, RequestsWhatAReaderOverridesThoughARecorderCameFirst) {
  int recorded = 0;
  channel.add_reader(
      &recorder, [&](const TopicDescription&, const SamplePtr&) { ++recorded; }, Channel::Wants::kAll);
  channel.add_reader(&first, ignore, Channel::Wants::kValid, kBestEffort);
  EXPECT_THAT(bridge.opened_readers, ElementsAre(Qos{}, kBestEffort));
  EXPECT_EQ(bridge.readers, 1);
  bridge.receive(received());
  EXPECT_EQ(recorded, 1);
}

TEST_F(BridgedChannel, RequestsWhatAReaderOverridesThoughARecorderFollows) {
  channel.add_reader(&first, ignore, Channel::Wants::kValid, kBestEffort);
  channel.add_reader(&recorder, ignore, Channel::Wants::kAll);
  EXPECT_THAT(bridge.opened_readers, ElementsAre(kBestEffort));
}

TEST_F(BridgedChannel, StaysOpenForAReaderWhoseRequestTheRecorderAlreadyMade) {
  channel.add_reader(&recorder, ignore, Channel::Wants::kAll);
  channel.add_reader(&first, ignore);
  EXPECT_EQ(bridge.opened_readers.size(), 1U);
}

TEST_F(BridgedChannel, RefusesReadersThatDisagreeWhateverARecorderTakes) {
  channel.add_reader(&recorder, ignore, Channel::Wants::kAll);
  channel.add_reader(&first, ignore, Channel::Wants::kValid, kBestEffort);
  EXPECT_THROW(channel.add_reader(&second, ignore), ConfigError);
  channel.remove_reader(&first);
  channel.add_reader(&second, ignore);
  EXPECT_THAT(bridge.opened_readers, ElementsAre(Qos{}, kBestEffort, Qos{}));
}

/// The latched message of another process.
struct LatchedElsewhere : testing::TestWithParam<bool> {
  ScriptedBridge bridge;
  Channel channel{text_topic({.durability = Durability::kTransientLocal, .keep_all = GetParam()}), &bridge,
                  [](const std::string&) {}, [] { return std::int64_t{0}; }};
  int reader = 0, recorder = 0;

  int seen_late(const std::optional<Qos>& qos = std::nullopt) {
    int seen = 0;
    channel.add_reader(
        &reader, [&](const TopicDescription&, const SamplePtr&) { ++seen; }, Channel::Wants::kValid, qos);
    channel.remove_reader(&reader);
    return seen;
  }
};

TEST_P(LatchedElsewhere, ReachesEachReaderOnceAndDoesNotOutliveItsWriter) {
  bridge.has_latched = true;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(seen_late(), 1) << i;
  bridge.has_latched = false;
  EXPECT_EQ(seen_late(), 0);
}

TEST_P(LatchedElsewhere, ReachesAReaderOnceWhoseOverrideOpensItAgain) {
  bridge.has_latched = true;
  channel.add_reader(&recorder, BridgedChannel::ignore, Channel::Wants::kAll);
  EXPECT_EQ(seen_late(Qos{.requested = Reliability::kBestEffort, .durability = Durability::kTransientLocal}), 1);
}

TEST_P(LatchedElsewhere, LeavesWhatWasPublishedHere) {
  channel.add_publisher(&recorder, "publisher");
  channel.publish(Sample::of(*text_topic().type, std::make_shared<const String>(), 7));
  for (int i = 0; i < 2; ++i) EXPECT_EQ(seen_late(), 1) << i;
}

INSTANTIATE_TEST_SUITE_P(TopicsThatKeepTheLastOrAll, LatchedElsewhere, testing::Bool());

}  // namespace
}  // namespace panvo::runtime
