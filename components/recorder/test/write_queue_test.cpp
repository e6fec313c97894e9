// SPDX-License-Identifier: Apache-2.0
#include "write_queue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace panvo::recorder {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

runtime::TopicDescription topic(const std::string& name) { return {name, "test_msgs/msg/Bytes", {}}; }

runtime::SamplePtr sample(std::size_t bytes) {
  return runtime::Sample::from_bytes(nullptr, "test_msgs/msg/Bytes", interfaces::Bytes(bytes, 7), 0);
}

TEST(WriteQueue, HasNoRoomUntilWhatItGaveIsReleased) {
  const auto images = topic("/images"), poses = topic("/poses");
  WriteQueue queue(100, 10);
  EXPECT_TRUE(queue.push(images, sample(60)));
  EXPECT_TRUE(queue.push(images, sample(60)));
  EXPECT_FALSE(queue.push(images, sample(60)));
  const auto first = queue.pop();
  ASSERT_TRUE(first);
  EXPECT_FALSE(queue.push(poses, sample(1)));
  queue.release(*first);
  EXPECT_TRUE(queue.push(poses, sample(1)));
  EXPECT_THAT(queue.take_dropped(), ElementsAre(Pair("/images", 1u), Pair("/poses", 1u)));
  EXPECT_THAT(queue.take_dropped(), IsEmpty());
}

TEST(WriteQueue, HoldsNoMoreThanItsNumberOfSmallMessages) {
  const auto poses = topic("/poses");
  WriteQueue queue(100, 3);
  queue.push_split();
  EXPECT_TRUE(queue.push(poses, sample(1)));
  EXPECT_FALSE(queue.push(poses, sample(1)));
  queue.release(*queue.pop());
  EXPECT_TRUE(queue.push(poses, sample(1)));
}

TEST(WriteQueue, CountsAsDroppedWhatWaitsWhenItIsClosedAndWhatComesLater) {
  const auto images = topic("/images"), poses = topic("/poses");
  WriteQueue queue(100, 10);
  queue.push(images, sample(1));
  queue.push_split();
  queue.push(poses, sample(1));
  queue.close();
  EXPECT_FALSE(queue.push(poses, sample(1)));
  EXPECT_FALSE(queue.pop());
  EXPECT_TRUE(queue.is_closed());
  EXPECT_THAT(queue.take_dropped(), ElementsAre(Pair("/images", 1u), Pair("/poses", 2u)));
}

}  // namespace
}  // namespace panvo::recorder
