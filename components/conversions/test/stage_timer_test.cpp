// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/stage_timer.hpp"

#include <gtest/gtest.h>

namespace panvo::conversions {
namespace {

TEST(StageTimer, CountsNestedStagesOfSeveralThreads) {
  runtime::StageTimes times;
  StageTimer timer(times);
  const auto work = [&] {
    for (int i = 0; i < 100; ++i) {
      const vision::Stage match(&timer, "match");
      const vision::Stage refine(&timer, "refine");
    }
  };
  std::thread other(work);
  work();
  other.join();
  const auto snapshot = times.snapshot();
  EXPECT_EQ(snapshot.at("match").wall.count(), 200u);
  EXPECT_EQ(snapshot.at("refine").cpu.count(), 200u);
}

TEST(StageTimer, BearsALeaveTooMany) {
  runtime::StageTimes times;
  StageTimer timer(times);
  timer.leave();
  EXPECT_TRUE(times.snapshot().empty());
}

}  // namespace
}  // namespace panvo::conversions
