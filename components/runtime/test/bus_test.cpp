// SPDX-License-Identifier: Apache-2.0
#include "bus.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "std_msgs/msg/String.h"

namespace panvo::runtime {
namespace {

using std_msgs::msg::String;
using testing::ElementsAre;

SamplePtr typed_text(const std::string& text) {
  auto message = std::make_shared<String>();
  message->data(text);
  return Sample::of(interfaces::message_type<String>(), message, 1);
}

/// As a player or the bridge has it of a type that is unknown here.
SamplePtr bytes_of_text(const std::string& text) {
  return Sample::from_bytes(nullptr, "std_msgs/msg/String", typed_text(text)->bytes(), 1);
}

TEST(Bus, GivesComponentsTheirTypeOfATopicThatARecorderOpenedWithout) {
  Bus bus(
      nullptr, [](const std::string&) {}, [] { return std::int64_t{0}; });
  int recorder = 0, component = 0;
  std::size_t recorded = 0;
  bus.tap(
      &recorder, [](const TopicDescription&) { return true; },
      [&](const TopicDescription&, const SamplePtr&) { ++recorded; });
  TopicDescription topic{"/text", "std_msgs/msg/String", {.durability = interfaces::Durability::kTransientLocal}};
  Channel& opened = bus.channel(topic);
  opened.publish(bytes_of_text("before"));

  topic.type = &interfaces::message_type<String>();
  Channel& channel = bus.channel(topic);
  ASSERT_EQ(&channel, &opened);
  ASSERT_EQ(channel.topic().type, topic.type);
  std::vector<std::string> read;
  channel.add_reader(&component, [&](const TopicDescription&, const SamplePtr& sample) {
    const auto text = Sample::as<String>(sample);
    read.push_back(text ? text->data() : "nothing");
  });
  channel.publish(bytes_of_text("as bytes"));
  channel.publish(typed_text("typed"));
  EXPECT_THAT(read, ElementsAre("before", "as bytes", "typed"));
  EXPECT_EQ(recorded, 3U);
}

}  // namespace
}  // namespace panvo::runtime
