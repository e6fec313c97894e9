// SPDX-License-Identifier: Apache-2.0
#include "stamp_guard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::runtime {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kFrame = kSecond / 25;
constexpr std::int64_t kNow = 1'700'000'000 * kSecond;  // host time
constexpr std::int64_t kYear2038 = 2'147'483'647 * kSecond;

using Outcome = StampGuard::Outcome;

/// A camera with a delay of 10 to 14 ms; its clock is `ahead` of the arrival clock.
struct Camera {
  StampGuard& guard;
  std::string topic = "/camera";
  std::int64_t ahead = kNow;
  std::int64_t time = 0;

  Outcome send(std::int64_t off = 0) {
    time += kFrame;
    return guard.check(topic, time + ahead + off, time + (10 + time / kFrame % 5) * 1'000'000, std::nullopt).outcome;
  }
  int accepted_of(int count, std::int64_t off = 0) {
    int accepted = 0;
    for (int i = 0; i < count; ++i) accepted += send(off) == Outcome::kRejected ? 0 : 1;
    return accepted;
  }
};

TEST(StampGuard, RejectsOneStampThatJumpsAndNoneOfThoseAfterIt) {
  for (const std::int64_t jump : {10 * kSecond, 60 * kSecond, kYear2038 - kNow, -10 * kSecond}) {
    StampGuard guard;
    Camera camera{guard};
    EXPECT_EQ(camera.accepted_of(100), 100);
    EXPECT_EQ(camera.send(jump), Outcome::kRejected) << jump;
    EXPECT_EQ(camera.accepted_of(100), 100) << jump;
  }
}

TEST(StampGuard, AcceptsAClockThatWasSetOnceAFewMessagesAgree) {
  for (const std::int64_t jump : {10 * kSecond, -3600 * kSecond}) {
    StampGuard guard;
    Camera camera{guard};
    camera.accepted_of(100);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(camera.send(jump), Outcome::kRejected);
    EXPECT_EQ(camera.send(jump), Outcome::kClockStep);
    EXPECT_EQ(camera.accepted_of(100, jump), 100);
  }
}

TEST(StampGuard, TakesNoJumpsThatDisagreeForAClock) {
  StampGuard guard;
  Camera camera{guard};
  camera.accepted_of(100);
  for (int i = 1; i < 20; ++i) EXPECT_EQ(camera.send(i * i * 10 * kSecond), Outcome::kRejected);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(camera.send(), Outcome::kAccepted);
    EXPECT_EQ(camera.send(10 * kSecond), Outcome::kRejected) << "the right time came in between";
  }
}

TEST(StampGuard, AcceptsAStreamThatPausesOrIsLate) {
  StampGuard guard;
  Camera camera{guard};
  camera.accepted_of(100);
  camera.time += 60 * kSecond;  // the camera was unplugged
  EXPECT_EQ(camera.accepted_of(100), 100);
  // The process was stopped for 3 s; the last five messages from that time are left.
  const std::int64_t arrival = camera.time + 3 * kSecond;
  for (int i = 5; i > 0; --i) {
    const auto verdict = guard.check("/camera", arrival - i * kFrame + kNow, arrival, std::nullopt);
    EXPECT_EQ(verdict.outcome, Outcome::kAccepted);
  }
  camera.time = arrival;
  EXPECT_EQ(camera.accepted_of(100), 100);
}

TEST(StampGuard, AcceptsWhatIsPlayedAtAnotherRate) {
  for (const double rate : {0.2, 5.0, 20.0}) {
    StampGuard guard;
    int rejected = 0;
    for (int i = 0; i < 3000; ++i) {
      const auto arrival = static_cast<std::int64_t>(i * kFrame / rate);
      const auto check = [&](const std::string& topic) {
        rejected += guard.check(topic, kNow + i * kFrame, arrival, std::nullopt).outcome == Outcome::kAccepted ? 0 : 1;
      };
      check("/image");
      if (i % 5 == 0) check("/panorama");
      if (i % 700 == 699) check("/correction");  // too rare to determine the sender's time itself
    }
    EXPECT_EQ(rejected, 0) << rate;
  }
}

TEST(StampGuard, LetsTopicsHaveClocksOfTheirOwn) {
  StampGuard guard;
  Camera stereo{guard, "/stereo"}, panorama{guard, "/panorama", kNow + 3600 * kSecond};
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(stereo.send(), Outcome::kAccepted);
    EXPECT_EQ(panorama.send(), Outcome::kAccepted);
  }
  EXPECT_EQ(stereo.send(60 * kSecond), Outcome::kRejected);
}

TEST(StampGuard, TakesNoFirstStampOfTheFuture) {
  StampGuard guard;
  EXPECT_EQ(guard.check("/a", kYear2038, 0, kNow).outcome, Outcome::kRejected);
  EXPECT_EQ(guard.check("/a", kNow, kFrame, kNow + kFrame).outcome, Outcome::kAccepted);
  EXPECT_EQ(guard.check("/b", 1'300'000'000 * kSecond, 0, kNow).outcome, Outcome::kAccepted) << "a recording is played";
}

TEST(StampGuard, ReportsAReasonOnceInTenSeconds) {
  StampGuard guard;
  Camera camera{guard};
  int reports = 0;
  std::uint64_t rejected = 0;
  for (int i = 0; i < 25 * 25; ++i) {  // for 25 s, every second image is wrong
    camera.send();
    camera.time += kFrame;
    const auto verdict = guard.check("/camera", camera.time + kNow + 60 * kSecond, camera.time, std::nullopt);
    reports += verdict.is_to_report ? 1 : 0;
    rejected = verdict.rejected;
  }
  EXPECT_EQ(reports, 5);  // in 50 s
  EXPECT_EQ(rejected, 625U);
}

/// Records the stamps of received pairs.
struct PairSink : Component {
  explicit PairSink(Context& context) {
    context.input_pair(topics::kStereoLeftImageRect, topics::kStereoRightImageRect,
                       [](const auto& left, const auto&) { seen.push_back(left->header().stamp().sec()); });
  }
  static inline std::vector<std::int32_t> seen;
};

TEST(StampGuard, KeepsAPairOfAnotherTimeFromAComponentAndCountsIt) {
  std::int64_t arrival = 0;
  ComponentHarness harness({.replay = true, .clock = [&] { return arrival; }});
  PairSink::seen.clear();
  harness.add<PairSink>("pair_sink");
  const auto send = [&](std::int32_t second) {
    sensor_msgs::msg::Image image;
    image.header().stamp().sec(second);
    image.width(1);
    image.height(1);
    image.step(1);
    image.encoding("mono8");
    image.data({0});
    harness.publish(topics::kStereoLeftImageRect, image);
    harness.publish(topics::kStereoRightImageRect, image);
    arrival += kSecond;
  };
  for (const std::int32_t second : {1'000, 1'001, 1'002, 1'063, 1'004}) send(second);
  EXPECT_THAT(PairSink::seen, testing::ElementsAre(1'000, 1'001, 1'002, 1'004));
  EXPECT_TRUE(harness.log_contains("/stereo/left/image_rect: dropped a message with a stamp ahead"));
}

}  // namespace
}  // namespace panvo::runtime
