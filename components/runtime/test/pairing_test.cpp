// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <utility>
#include <vector>

#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::runtime {
namespace {

using sensor_msgs::msg::Image;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using namespace std::chrono_literals;

constexpr auto kTolerance = 10ms;

std::int64_t milliseconds_of(const Image& image) { return image.header().stamp().nanosec() / 1'000'000; }

Image image_at(std::int64_t milliseconds) {
  Image image;
  image.width(1);
  image.height(1);
  image.step(1);
  image.encoding("mono8");
  image.data({0});
  image.header().stamp().nanosec(static_cast<std::uint32_t>(1'000'000 * milliseconds));
  return image;
}

/// A component that pairs left and right images whose stamps differ by at most 10 ms.
class ApproximatePairs : public testing::Test {
 protected:
  ApproximatePairs() {
    ComponentDescription description;
    description.name = "pairs";
    harness_.container().add(description, [this](Context& context) {
      context.input_pair(
          topics::kStereoLeftImageRaw, topics::kStereoRightImageRaw,
          [this](const auto& left, const auto& right) {
            pairs_.emplace_back(milliseconds_of(*left), milliseconds_of(*right));
          },
          kTolerance);
      return std::make_unique<Component>();
    });
  }

  void left(std::int64_t milliseconds) { harness_.publish(topics::kStereoLeftImageRaw, image_at(milliseconds)); }
  void right(std::int64_t milliseconds) { harness_.publish(topics::kStereoRightImageRaw, image_at(milliseconds)); }

  std::uint64_t dropped() const {
    std::uint64_t sum = 0;
    for (const auto& queue : const_cast<ComponentHarness&>(harness_).container().queue_counters()) sum += queue.dropped;
    return sum;
  }

  ComponentHarness harness_;
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs_;
};

TEST_F(ApproximatePairs, LieWithinTheTolerance) {
  left(100);
  right(110);
  right(161);
  left(150);
  EXPECT_THAT(pairs_, ElementsAre(Pair(100, 110))) << "11 ms are too much";
}

TEST_F(ApproximatePairs, TakeTheNearestOfThoseThatWait) {
  left(100);
  left(106);
  left(112);
  right(108);
  EXPECT_THAT(pairs_, ElementsAre(Pair(106, 108)));
  EXPECT_EQ(dropped(), 1U) << "100 is older than the paired 106";
  right(113);
  EXPECT_THAT(pairs_, ElementsAre(Pair(106, 108), Pair(112, 113)));
}

TEST_F(ApproximatePairs, KeepFirstAndSecondApartWhicheverComesLast) {
  right(100);
  left(103);
  EXPECT_THAT(pairs_, ElementsAre(Pair(103, 100)));
}

TEST_F(ApproximatePairs, AreMadeAgainWhenTheClockIsSetBackWhileOneSideIsSilent) {
  for (int i = 0; i < 25; ++i) left(500 + 20 * i);  // more than may wait
  EXPECT_GT(dropped(), 0U);
  for (const std::int64_t milliseconds : {100, 120, 140}) {
    left(milliseconds);
    right(milliseconds);
  }
  EXPECT_THAT(pairs_, ElementsAre(Pair(100, 100), Pair(120, 120), Pair(140, 140)));
}

TEST(PairTolerance, IsNotNegative) {
  ComponentHarness harness;
  ComponentDescription description;
  description.name = "pairs";
  const auto make = [](Context& context) {
    context.input_pair(
        topics::kStereoLeftImageRaw, topics::kStereoRightImageRaw, [](const auto&, const auto&) {}, -1ns);
    return std::make_unique<Component>();
  };
  try {
    harness.container().add(description, make);
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("pairs: the tolerance of a pair of inputs is negative"));
  }
}

}  // namespace
}  // namespace panvo::runtime
