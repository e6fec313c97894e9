// SPDX-License-Identifier: Apache-2.0
#include "offer_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/runtime/bridge.hpp"

namespace panvo::web_view {
namespace {

using Table = OfferTable<runtime::TopicDescription>;

runtime::TopicDescription topic(const std::string& name, const std::string& type_name) {
  return {name, type_name, {}, nullptr};
}

TEST(OfferTable, FindsWhatItOffers) {
  Table table;
  const auto change = table.update({topic("/odometry", "nav_msgs/msg/Odometry")});
  EXPECT_THAT(change.removed, testing::IsEmpty());
  ASSERT_EQ(change.added.size(), 1u);
  EXPECT_EQ(change.added[0].what.name, "/odometry");
  ASSERT_NE(table.find(change.added[0].id), nullptr);
  EXPECT_EQ(table.find(change.added[0].id)->type_name, "nav_msgs/msg/Odometry");
  EXPECT_EQ(table.find(change.added[0].id + 1), nullptr);
}

TEST(OfferTable, GivesNoIdTwice) {
  Table table;
  const auto one = topic("/one", "std_msgs/msg/String"), two = topic("/two", "std_msgs/msg/String");
  const auto first = table.update({one, two}).added.at(0).id;
  EXPECT_THAT(table.update({one, two}).added, testing::IsEmpty());
  EXPECT_THAT(table.update({two}).removed, testing::ElementsAre(first));
  EXPECT_EQ(table.find(first), nullptr);
  const auto again = table.update({one, two});
  ASSERT_EQ(again.added.size(), 1u);
  EXPECT_GT(again.added[0].id, first + 1);
  EXPECT_EQ(table.all().size(), 2u);
}

TEST(OfferTable, TakesATopicOfAnotherTypeForAnother) {
  Table table;
  const auto first = table.update({topic("/one", "std_msgs/msg/String")}).added.at(0).id;
  const auto change = table.update({topic("/one", "nav_msgs/msg/Odometry")});
  EXPECT_THAT(change.removed, testing::ElementsAre(first));
  EXPECT_EQ(change.added.size(), 1u);
}

TEST(OfferTable, LeavesOutTopicsBeyondTheMost) {
  std::vector<runtime::TopicDescription> topics;
  for (std::size_t i = 0; i < Table::kMax + 3; ++i)
    topics.push_back({"/topic_" + std::to_string(i), "std_msgs/msg/String", {}, nullptr});
  Table table;
  EXPECT_EQ(table.update(topics).added.size(), Table::kMax);
  EXPECT_EQ(table.left_out(), 3u);
}

}  // namespace
}  // namespace panvo::web_view
