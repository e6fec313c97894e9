// SPDX-License-Identifier: Apache-2.0
#include "panvo/runner/queue_watch.hpp"

#include <gtest/gtest.h>

namespace panvo::runner {
namespace {

runtime::QueueCounters queue(const char* input, std::uint64_t handled, std::size_t waiting) {
  return {.component = "odometry", .input = input, .received = 100, .handled = handled, .waiting = waiting};
}

TEST(QueueWatch, NoticesAQueueOfWhichNoneIsHandled) {
  QueueWatch watch;
  EXPECT_TRUE(watch.moves({queue("left", 5, 2)}));
  EXPECT_FALSE(watch.moves({queue("left", 5, 3)}));
  EXPECT_FALSE(watch.moves({queue("left", 5, 3)}));
  EXPECT_TRUE(watch.moves({queue("left", 6, 3)}));
}

TEST(QueueWatch, AcceptsQueuesThatAreEmptyOrHaveJustBeenFilled) {
  QueueWatch watch;
  EXPECT_TRUE(watch.moves({queue("left", 5, 0)}));
  EXPECT_TRUE(watch.moves({queue("left", 5, 0)}));
  EXPECT_TRUE(watch.moves({queue("left", 5, 1)}));
}

TEST(QueueWatch, NoticesOneStuckQueueAmongMovingOnes) {
  QueueWatch watch;
  EXPECT_TRUE(watch.moves({queue("left", 5, 2), queue("right", 7, 2)}));
  EXPECT_FALSE(watch.moves({queue("left", 6, 2), queue("right", 7, 2)}));
}

}  // namespace
}  // namespace panvo::runner
