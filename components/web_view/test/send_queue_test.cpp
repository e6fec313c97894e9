// SPDX-License-Identifier: Apache-2.0
#include "send_queue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace panvo::web_view {
namespace {

using testing::ElementsAre;

/// A message of `bytes`, recognised by its time.
SendQueue::Item message(std::uint32_t subscription, std::int64_t time_ns, std::size_t bytes, Keeping keeping) {
  return {SendQueue::Message{subscription, time_ns, runtime::Sample::from_bytes(nullptr, "", {0}, time_ns)}, bytes,
          keeping};
}

std::vector<std::int64_t> times_of_all(SendQueue& queue) {
  std::vector<std::int64_t> times;
  while (const auto item = queue.pop()) {
    const auto* message = std::get_if<SendQueue::Message>(&item->content);
    times.push_back(message ? message->sample->time_ns() : -1);
  }
  return times;
}

TEST(SendQueue, KeepsSmallMessagesInOrder) {
  SendQueue queue(100, 10);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(queue.push(message(1, i, 10, Keeping::kAll)));
  EXPECT_TRUE(queue.push({SendQueue::Text{"{}"}, 2}));
  EXPECT_EQ(queue.bytes(), 32u);
  EXPECT_THAT(times_of_all(queue), ElementsAre(0, 1, 2, -1));
  EXPECT_EQ(queue.bytes(), 0u);
  EXPECT_EQ(queue.dropped(), 0u);
}

TEST(SendQueue, KeepsTheNewestImageOfEachSubscription) {
  SendQueue queue(100, 10);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(queue.push(message(1, i, 30, Keeping::kNewest)));
    EXPECT_TRUE(queue.push(message(2, 10 + i, 30, Keeping::kNewest)));
  }
  EXPECT_EQ(queue.dropped(), 4u);
  EXPECT_THAT(times_of_all(queue), ElementsAre(2, 12));
}

TEST(SendQueue, SendsPosesBeforeWaitingImages) {
  SendQueue queue(100, 10);
  EXPECT_TRUE(queue.push(message(1, 1, 50, Keeping::kNewest)));
  EXPECT_TRUE(queue.push(message(2, 2, 10, Keeping::kAll)));
  EXPECT_THAT(times_of_all(queue), ElementsAre(2, 1));
}

TEST(SendQueue, DropsLargeMessagesForPosesButNoPoses) {
  SendQueue queue(100, 10);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(queue.push(message(1, i, 40, Keeping::kWhileRoom)));
  EXPECT_EQ(queue.dropped(), 2u);
  for (int i = 10; i < 19; ++i) EXPECT_TRUE(queue.push(message(2, i, 10, Keeping::kAll)));
  EXPECT_EQ(queue.dropped(), 4u);
  EXPECT_TRUE(queue.push(message(1, 5, 40, Keeping::kWhileRoom)));
  EXPECT_EQ(queue.dropped(), 5u);
  EXPECT_TRUE(queue.push(message(2, 19, 10, Keeping::kAll)));
  EXPECT_FALSE(queue.push(message(2, 20, 10, Keeping::kAll)));
  EXPECT_EQ(times_of_all(queue).size(), 10u);
}

TEST(SendQueue, IsFullAtTheMostItems) {
  SendQueue queue(100, 2);
  EXPECT_TRUE(queue.push(message(1, 1, 0, Keeping::kAll)));
  EXPECT_TRUE(queue.push(message(1, 2, 0, Keeping::kAll)));
  EXPECT_FALSE(queue.push(message(1, 3, 0, Keeping::kAll)));
}

TEST(SendQueue, KeepsTheOrderOfASubscriptionWhoseMessagesGrow) {
  SendQueue queue(100, 10);
  EXPECT_TRUE(queue.push(message(1, 1, 10, Keeping::kAll)));
  EXPECT_TRUE(queue.push(message(1, 2, 50, Keeping::kWhileRoom)));
  EXPECT_TRUE(queue.push(message(1, 3, 10, Keeping::kAll)));
  EXPECT_THAT(times_of_all(queue), ElementsAre(1, 2, 3));
}

TEST(SendQueue, ForgetsASubscription) {
  SendQueue queue(100, 10);
  EXPECT_TRUE(queue.push(message(1, 1, 10, Keeping::kAll)));
  EXPECT_TRUE(queue.push(message(1, 2, 50, Keeping::kNewest)));
  EXPECT_TRUE(queue.push(message(2, 3, 10, Keeping::kAll)));
  queue.forget(1);
  EXPECT_EQ(queue.bytes(), 10u);
  EXPECT_THAT(times_of_all(queue), ElementsAre(3));
}

TEST(SendQueue, TakesImagesAndLargeMessagesForDroppable) {
  EXPECT_EQ(keeping_of("sensor_msgs/msg/CompressedImage", 100), Keeping::kNewest);
  EXPECT_EQ(keeping_of("nav_msgs/msg/Odometry", 700), Keeping::kAll);
  EXPECT_EQ(keeping_of("nav_msgs/msg/Path", 700'000), Keeping::kWhileRoom);
}

}  // namespace
}  // namespace panvo::web_view
