// SPDX-License-Identifier: Apache-2.0
#include "stamp_guard.hpp"

#include <gtest/gtest.h>

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
    for (int i = 0; i < count; ++i) accepted += send(off) == Outcome::kSuspected ? 0 : 1;
    return accepted;
  }
};

TEST(StampGuard, RejectsOneStampThatJumpsAndNoneOfThoseAfterIt) {
  for (const std::int64_t jump : {10 * kSecond, 60 * kSecond, kYear2038 - kNow, -10 * kSecond}) {
    StampGuard guard;
    Camera camera{guard};
    EXPECT_EQ(camera.accepted_of(100), 100);
    EXPECT_EQ(camera.send(jump), Outcome::kSuspected) << jump;
    EXPECT_EQ(camera.accepted_of(100), 100) << jump;
  }
}

TEST(StampGuard, AcceptsAClockThatWasSetOnceAFewMessagesAgree) {
  for (const std::int64_t jump : {10 * kSecond, -3600 * kSecond}) {
    StampGuard guard;
    Camera camera{guard};
    camera.accepted_of(100);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(camera.send(jump), Outcome::kSuspected);
    EXPECT_EQ(camera.send(jump), Outcome::kClockStep);
    EXPECT_EQ(camera.accepted_of(100, jump), 100);
  }
}

TEST(StampGuard, AcceptsAClockThatWasSetAlsoOfRareMessagesThatWaitedTogether) {
  constexpr std::int64_t kRare = 4 * kSecond;
  StampGuard guard;
  const auto outcome = [&guard](std::int64_t stamp, std::int64_t arrival) {
    return guard.check("/rare", kNow + stamp, arrival, std::nullopt).outcome;
  };
  for (int i = 0; i < 10; ++i) EXPECT_EQ(outcome(i * kRare, i * kRare), Outcome::kAccepted);
  // A component before this one passed them on at once, when the fifth one came.
  for (int i = 10; i < 14; ++i) EXPECT_EQ(outcome(i * kRare - 500 * kSecond, 14 * kRare), Outcome::kSuspected);
  EXPECT_EQ(outcome(14 * kRare - 500 * kSecond, 14 * kRare), Outcome::kClockStep);
}

TEST(StampGuard, AllowsNoLessForAClockThatWasSetByDecades) {
  StampGuard guard;
  EXPECT_EQ(guard.check("/of_2038", kYear2038, 0, std::nullopt).outcome, Outcome::kAccepted);
  EXPECT_EQ(guard.check("/set", kSecond, 0, std::nullopt).outcome, Outcome::kAccepted);
  EXPECT_EQ(guard.check("/set", kYear2038 + kFrame, kFrame, std::nullopt).outcome, Outcome::kAccepted);
  const auto early = guard.check("/set", kYear2038 + 2 * kFrame + kSecond, 2 * kFrame, std::nullopt);
  EXPECT_EQ(early.outcome, Outcome::kAccepted) << "as of any topic with a long interval";
}

TEST(StampGuard, TakesNoJumpsThatDisagreeForAClock) {
  StampGuard guard;
  Camera camera{guard};
  camera.accepted_of(100);
  for (int i = 1; i < 20; ++i) EXPECT_EQ(camera.send(i * i * 10 * kSecond), Outcome::kSuspected);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(camera.send(), Outcome::kAccepted);
    EXPECT_EQ(camera.send(10 * kSecond), Outcome::kSuspected) << "the right time came in between";
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
  EXPECT_EQ(stereo.send(60 * kSecond), Outcome::kSuspected);
}

TEST(StampGuard, TakesNoFirstStampOfTheFuture) {
  StampGuard guard;
  EXPECT_EQ(guard.check("/a", kYear2038, 0, kNow).outcome, Outcome::kSuspected);
  EXPECT_EQ(guard.check("/a", kNow, kFrame, kNow + kFrame).outcome, Outcome::kAccepted);
  EXPECT_EQ(guard.check("/b", 1'300'000'000 * kSecond, 0, kNow).outcome, Outcome::kAccepted) << "a recording is played";
}

TEST(StampGuard, TellsWhichSuspectsAreOfTheTimeOfAMessage) {
  StampGuard guard;
  Camera camera{guard};
  camera.accepted_of(100);
  const auto agreeing = [&](std::int64_t off) {
    camera.time += kFrame;
    return guard.check("/camera", camera.time + kNow + off, camera.time + 10'000'000, std::nullopt).agreeing;
  };
  EXPECT_EQ(agreeing(60 * kSecond), 0);
  EXPECT_EQ(agreeing(0), 0) << "the one before was wrong";
  EXPECT_EQ(agreeing(60 * kSecond), 0);
  EXPECT_EQ(agreeing(-10 * kSecond), 0);
  for (int before = 1; before < 5; ++before) EXPECT_EQ(agreeing(-10 * kSecond), before);
  EXPECT_EQ(agreeing(-10 * kSecond), 0) << "accepted; none is suspected any more";
}

}  // namespace
}  // namespace panvo::runtime
