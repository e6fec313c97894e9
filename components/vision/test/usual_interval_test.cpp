// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/usual_interval.hpp"

#include <gtest/gtest.h>

namespace panvo::vision {
namespace {

TEST(UsualInterval, IsUnknownAtFirst) { EXPECT_EQ(UsualInterval().median_s(), 0.0); }

TEST(UsualInterval, FollowsNoGap) {
  UsualInterval usual;
  usual.add(0.04);
  for (const double interval_s : {3600.0, 0.04, 7.0, 0.05, -10.0, 0.0, 0.04}) usual.add(interval_s);
  EXPECT_EQ(usual.median_s(), 0.04);
}

TEST(UsualInterval, FollowsAnotherRate) {
  UsualInterval usual;
  for (int i = 0; i < 1000; ++i) usual.add(0.04);
  for (int i = 0; i < 11; ++i) usual.add(0.2);
  EXPECT_EQ(usual.median_s(), 0.2);
}

}  // namespace
}  // namespace panvo::vision
