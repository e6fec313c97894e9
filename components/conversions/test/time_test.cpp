// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/time.hpp"

#include <gtest/gtest.h>

namespace panvo::conversions {
namespace {

TEST(Stamp, KeepsEveryNanosecond) {
  for (const std::int64_t ns :
       {0L, 1L, 999'999'999L, 1'000'000'000L, 1'700'021'000'040'000'001L, -1L, -1'500'000'000L}) {
    EXPECT_EQ(to_ns(to_stamp(ns)), ns);
    EXPECT_LT(to_stamp(ns).nanosec(), 1'000'000'000u);
  }
}

}  // namespace
}  // namespace panvo::conversions
