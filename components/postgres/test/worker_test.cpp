// SPDX-License-Identifier: Apache-2.0
#include "panvo/postgres/worker.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>

namespace panvo::postgres {
namespace {

TEST(Backoff, DoublesUpToALimit) {
  EXPECT_EQ(backoff_ms(0), 250);
  EXPECT_EQ(backoff_ms(3), 2000);
  EXPECT_EQ(backoff_ms(7), 30'000);
  EXPECT_EQ(backoff_ms(1'000'000), 30'000);
  EXPECT_FALSE(sleep_before_attempt(3, 3));
}

TEST(Worker, WorksUntilNothingIsLeftBeforeItEnds) {
  std::atomic<int> left = 1000;
  Worker worker([&] { return --left > 0; });
  worker.wake();
  EXPECT_TRUE(worker.finish(60'000));
  EXPECT_EQ(left, 0);
}

TEST(Worker, DoesNothingBeforeItIsWoken) {
  std::atomic<int> steps = 0;
  {
    Worker worker([&] { return ++steps < 0; });
    EXPECT_TRUE(worker.finish(0));
  }
  EXPECT_EQ(steps, 0);
}

TEST(Worker, EndsAPauseWhenItsTimeIsOver) {
  std::atomic<bool> may_go_on = true;
  std::latch begun(1);
  Worker* self = nullptr;
  Worker worker([&] {
    begun.count_down();
    may_go_on = self->pause(3'600'000);
    return false;
  });
  self = &worker;
  worker.wake();
  begun.wait();
  EXPECT_FALSE(worker.finish(10)) << "something was left";
  EXPECT_FALSE(may_go_on);
}

TEST(Worker, GuardsWhatBothThreadsUse) {
  int sum = 0;
  std::atomic<int> left = 10'000;
  Worker* self = nullptr;
  Worker worker([&] {
    self->locked([&] { ++sum; });
    return --left > 0;
  });
  self = &worker;
  worker.wake();
  for (int i = 0; i < 10'000; ++i) worker.locked([&] { ++sum; });
  EXPECT_TRUE(worker.finish(60'000));
  EXPECT_EQ(sum, 20'000);
}

}  // namespace
}  // namespace panvo::postgres
