// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clock_jump.hpp"
#include "localizer_on_topics.hpp"
#include "panvo/interfaces/time_topics.hpp"

namespace panvo::localizer {
namespace {

using ::testing::SizeIs;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Messages whose clock is slow by 100 us/s, with delays that vary by 20 ms.
struct Sender {
  ClockJump jump;
  std::int64_t time_ns = 0, clock_ns = kBegin_ns;

  std::int64_t send(std::int64_t late_ns = 0) {
    time_ns += kPeriod_ns;
    const std::int64_t stamp_ns = clock_ns + time_ns - time_ns / 10'000;
    return jump.add(stamp_ns, time_ns + late_ns + time_ns / kPeriod_ns % 5 * 4'000'000);
  }
  std::int64_t most_of(int count) {
    std::int64_t most_ns = 0;
    for (int i = 0; i < count; ++i) most_ns = std::max(most_ns, send());
    return most_ns;
  }
};

TEST(ClockJump, IsToldWithItsHeightAndOnce) {
  Sender sender;
  EXPECT_EQ(sender.most_of(25 * 3600), 0) << "with the slow clock";
  sender.clock_ns += 3600 * kSecond_ns;
  EXPECT_NEAR(1e-9 * static_cast<double>(sender.send()), 3600.0, 0.05);
  EXPECT_EQ(sender.most_of(100), 0);
}

TEST(ClockJump, IsNoSilence) {
  Sender sender;
  sender.most_of(100);
  sender.time_ns += 3600 * kSecond_ns;
  EXPECT_EQ(sender.most_of(100), 0);
}

TEST(ClockJump, IsNoTimeThatAProcessWasStopped) {
  Sender sender;
  sender.most_of(100);
  for (int i = 0; i < 250; ++i) EXPECT_EQ(sender.send(3 * kSecond_ns), 0) << "the messages wait";
  EXPECT_EQ(sender.most_of(100), 0) << "and no longer";
  sender.clock_ns -= 3600 * kSecond_ns;
  EXPECT_EQ(sender.most_of(100), 0) << "set back";
}

TEST_F(LocalizerOnTopics, SaysThatTheCamerasClocksDisagree) {
  load();
  drive(0, 10);
  for (int i = 0; i < 150; ++i) {
    publish_azimuth(stamp(5 * i) + 3'600'000'000'000, stamp(5 * i + 5) + 3'600'000'000'000, 0.0);
  }
  EXPECT_TRUE(harness_.log_contains("camera clocks are not synchronised"));
}

TEST_F(LocalizerOnTopics, SaysThatAClockBehindByAnHourDisagrees) {
  load();
  drive(0, 10);
  for (int i = 0; i < 20; ++i) {
    publish_azimuth(stamp(5 * i) - 3'600'000'000'000, stamp(5 * i + 5) - 3'600'000'000'000, 0.0);
  }
  EXPECT_TRUE(harness_.log_contains("camera clocks are not synchronised"));
}

TEST_F(LocalizerOnTopics, TellsTheTimeOfThePanoramicCameraOnceItIsKnown) {
  constexpr std::int64_t kAhead_ns = 200'000'000;
  const auto& references = harness_.collect(topics::kPanoramaTimeReference);
  load();
  const auto yaw = [](int frame) { return 0.3 * std::sin(0.05 * frame); };
  Eigen::Isometry3d before = at(0.0, 0.0, 0.0);
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  const vision::Matrix6d gained = 1e-7 * vision::Matrix6d::Identity();
  for (int i = 0; i < 400; ++i) {
    const auto pose = at(0.2 * i, 0.0, yaw(i));
    covariance = vision::compose_covariance(before, covariance, before.inverse() * pose, gained);
    publish_odometry(i, pose, covariance);
    before = pose;
    if (i < 25 || i % 5 != 0) continue;
    publish_azimuth(stamp(i - 25) + kAhead_ns, stamp(i - 20) + kAhead_ns, yaw(i - 20) - yaw(i - 25));
    if (i == 50) {
      EXPECT_THAT(references, SizeIs(0));
      publish_landmark(1, stamp(25) + kAhead_ns, at(5.0, 0.0, yaw(25)));
    }
  }
  ASSERT_THAT(references, SizeIs(1));
  const std::int64_t ahead_ns = conversions::to_ns(references[0]->time_ref()) - conversions::stamp_ns(*references[0]);
  EXPECT_NEAR(static_cast<double>(ahead_ns), static_cast<double>(kAhead_ns), 1e7);
  ASSERT_THAT(poses_.back()->poses(), SizeIs(1));
  EXPECT_NEAR(poses_.back()->poses()[0].pose().position().x(), 5.0, 0.05) << "a landmark built before";
}

}  // namespace
}  // namespace panvo::localizer
