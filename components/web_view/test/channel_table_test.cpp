// SPDX-License-Identifier: Apache-2.0
#include "channel_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nav_msgs/msg/Odometry.h"

namespace panvo::web_view {
namespace {

runtime::TopicDescription topic(const std::string& name, const std::string& type_name) {
  return {name, type_name, {}, interfaces::find_message_type(type_name)};
}

TEST(ChannelTable, OffersTopicsWithTheDefinitionsOfTheirTypes) {
  ChannelTable table;
  const auto change = table.update({topic("/odometry", "nav_msgs/msg/Odometry")});
  EXPECT_THAT(change.removed, testing::IsEmpty());
  ASSERT_EQ(change.added.size(), 1u);
  EXPECT_EQ(change.added[0].topic, "/odometry");
  EXPECT_EQ(change.added[0].schema_name, "nav_msgs/msg/Odometry");
  EXPECT_EQ(change.added[0].schema, interfaces::message_type<nav_msgs::msg::Odometry>().definition);
  ASSERT_NE(table.find(change.added[0].id), nullptr);
  EXPECT_EQ(table.find(change.added[0].id)->name, "/odometry");
}

TEST(ChannelTable, OffersTopicsOfUnknownTypeWithoutADefinition) {
  ChannelTable table;
  const auto change = table.update({topic("/other", "nobody_msgs/msg/Nothing")});
  ASSERT_EQ(change.added.size(), 1u);
  EXPECT_EQ(change.added[0].schema, "");
}

TEST(ChannelTable, GivesNoIdTwice) {
  ChannelTable table;
  const auto one = topic("/one", "std_msgs/msg/String"), two = topic("/two", "std_msgs/msg/String");
  const auto first = table.update({one, two}).added.at(0).id;
  EXPECT_THAT(table.update({one, two}).added, testing::IsEmpty());
  EXPECT_THAT(table.update({two}).removed, testing::ElementsAre(first));
  EXPECT_EQ(table.find(first), nullptr);
  const auto again = table.update({one, two});
  ASSERT_EQ(again.added.size(), 1u);
  EXPECT_GT(again.added[0].id, first + 1);
  EXPECT_EQ(table.channels().size(), 2u);
}

TEST(ChannelTable, TakesATopicOfAnotherTypeForAnotherChannel) {
  ChannelTable table;
  const auto first = table.update({topic("/one", "std_msgs/msg/String")}).added.at(0).id;
  const auto change = table.update({topic("/one", "nav_msgs/msg/Odometry")});
  EXPECT_THAT(change.removed, testing::ElementsAre(first));
  EXPECT_EQ(change.added.size(), 1u);
}

TEST(ChannelTable, LeavesOutTopicsBeyondTheMost) {
  std::vector<runtime::TopicDescription> topics;
  for (std::size_t i = 0; i < ChannelTable::kMaxChannels + 3; ++i)
    topics.push_back({"/topic_" + std::to_string(i), "std_msgs/msg/String", {}, nullptr});
  ChannelTable table;
  EXPECT_EQ(table.update(topics).added.size(), ChannelTable::kMaxChannels);
  EXPECT_EQ(table.left_out(), 3u);
}

}  // namespace
}  // namespace panvo::web_view
