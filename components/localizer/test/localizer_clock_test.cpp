// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clock_jump.hpp"
#include "localizer_on_topics.hpp"
#include "odometry_clock.hpp"
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

/// Messages every 40 ms, of a clock that is set after 100 of them.
struct SetSender {
  explicit SetSender(double back_s, int lost = 0) {
    for (int i = 0; i < 100; ++i) send();
    count += lost;
    ahead_ns = -static_cast<std::int64_t>(std::llround(back_s * 1e9));
    for (int i = 0; i < 10 && clock.set_back_ns() == 0; ++i) send();
  }
  void send(int waited = 0) {
    const std::int64_t sent_ns = ++count * kPeriod_ns, stamp_ns = kBegin_ns + sent_ns + ahead_ns;
    const std::int64_t arrival_ns = sent_ns + waited * kPeriod_ns;
    if (clock.add(stamp_ns, arrival_ns, latest_ns)) latest_ns = stamp_ns;
  }
  double set_back_s() const { return 1e-9 * static_cast<double>(clock.set_back_ns()); }

  OdometryClock clock;
  std::optional<std::int64_t> latest_ns;
  std::int64_t count = 0, ahead_ns = 0;
};

TEST(OdometryClock, TellsByHowMuchItWasSetHoweverManyMessagesAreLost) {
  for (const int lost : {0, 20}) {
    EXPECT_NEAR(SetSender(2.3, lost).set_back_s(), 2.3, 1e-6) << lost;
    EXPECT_NEAR(SetSender(-7.0, lost).set_back_s(), -7.0, 1e-6) << lost;
  }
  SetSender sender(2.3);
  sender.send();
  EXPECT_EQ(sender.set_back_s(), 0.0) << "once";
}

TEST(OdometryClock, TellsByItsSecondMessageThatItWasSetBack) {
  SetSender sender(0.0);
  sender.ahead_ns = -3 * kSecond_ns;
  const auto before_ns = sender.latest_ns;
  sender.send();
  EXPECT_EQ(sender.latest_ns, before_ns) << "one may be late";
  sender.send();
  EXPECT_NEAR(sender.set_back_s(), 3.0, 1e-6);
}

TEST(OdometryClock, TellsByHowMuchItWasSetThoughTheFirstMessagesWaited) {
  for (const double back_s : {2.3, -7.0}) {
    SetSender sender(0.0);
    sender.ahead_ns = -static_cast<std::int64_t>(std::llround(back_s * 1e9));
    std::int64_t back_ns = 0;
    for (int waited = 4; waited >= 0; --waited) {
      sender.send(waited);
      back_ns += sender.clock.set_back_ns() - sender.clock.less_back_ns();
    }
    EXPECT_NEAR(1e-9 * static_cast<double>(back_ns), back_s, 1e-6);
    for (int late = 0; late < 20; ++late) {
      sender.send(20 - late);
      EXPECT_EQ(sender.clock.less_back_ns(), 0) << "these are only late";
    }
  }
}

TEST(OdometryClock, PanoramasOfAClockThatWasNotSetAreOfAnotherTime) {
  using Of = OdometryClock::PanoramasClock;
  SetSender near(2.3), far(3600.0);
  EXPECT_EQ(near.clock.panoramas_clock(*near.latest_ns + 2 * kSecond_ns, *near.latest_ns), Of::kAny);
  EXPECT_EQ(far.clock.panoramas_clock(*far.latest_ns + 3600 * kSecond_ns, *far.latest_ns), Of::kAnother);
  EXPECT_EQ(far.clock.panoramas_clock(*far.latest_ns + kPeriod_ns, *far.latest_ns), Of::kAlike);
  EXPECT_EQ(far.clock.panoramas_clock(*far.latest_ns + 3600 * kSecond_ns, *far.latest_ns), Of::kAny) << "no longer";
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

TEST_F(LocalizerOnTopics, DoesNotBlameAClockForPanoramasFromBeforeTheOdometry) {
  load();
  drive(0, 80);
  for (int i = 1; i <= 15; ++i) publish_azimuth(stamp(0) - 1, stamp(5 * i), 0.0);
  EXPECT_FALSE(harness_.log_contains("camera clocks are not synchronised"));
}

/// Of the road that a vehicle winds along.
class LocalizerOnAWindingRoad : public LocalizerOnTopics {
 protected:
  static double yaw(int frame) { return 0.3 * std::sin(0.05 * frame); }

  /// Drives; panoramas, ahead by so much, arrive 0.8 s late. All clocks are `back_frames` behind.
  void wind(int from, int to, std::int64_t ahead_ns, int back_frames = 0) {
    const vision::Matrix6d gained = 1e-7 * vision::Matrix6d::Identity();
    for (int i = from; i < to; ++i) {
      const auto pose = at(0.2 * i, 0.0, yaw(i));
      covariance_ = vision::compose_covariance(before_, covariance_, before_.inverse() * pose, gained);
      publish_odometry(i - back_frames, pose, covariance_);
      before_ = pose;
      if (i - from < 25 || i % 5 != 0) continue;
      publish_azimuth(stamp(i - back_frames - 25) + ahead_ns, stamp(i - back_frames - 20) + ahead_ns,
                      yaw(i - 20) - yaw(i - 25));
      is_told_early_ |= references_.empty() && harness_.log_contains("of the stereo camera's");
    }
  }

  const std::vector<std::shared_ptr<const sensor_msgs::msg::TimeReference>>& references_ =
      harness_.collect(topics::kPanoramaTimeReference);
  bool is_told_early_ = false;  // an offset that is not known yet

 private:
  Eigen::Isometry3d before_ = at(0.0, 0.0, 0.0);
  vision::Matrix6d covariance_ = vision::Matrix6d::Zero();
};

TEST_F(LocalizerOnAWindingRoad, TellsTheTimeOfThePanoramicCameraOnceItIsKnown) {
  constexpr std::int64_t kAhead_ns = 200'000'000;
  load();
  wind(0, 51, kAhead_ns);
  EXPECT_THAT(references_, SizeIs(0));
  publish_landmark(1, stamp(25) + kAhead_ns, at(5.0, 0.0, yaw(25)));
  wind(51, 400, kAhead_ns);
  EXPECT_FALSE(is_told_early_);
  EXPECT_TRUE(harness_.log_contains("ms ahead of the stereo camera's"));
  ASSERT_THAT(references_, SizeIs(1));
  const std::int64_t ahead_ns = conversions::to_ns(references_[0]->time_ref()) - conversions::stamp_ns(*references_[0]);
  EXPECT_NEAR(static_cast<double>(ahead_ns), static_cast<double>(kAhead_ns), 1e7);
  ASSERT_THAT(poses_.back()->poses(), SizeIs(1));
  EXPECT_NEAR(poses_.back()->poses()[0].pose().position().x(), 5.0, 0.05) << "a landmark built before";
}

TEST_F(LocalizerOnAWindingRoad, TellsTheTimeOfThePanoramicCameraOnceItIsKnownToBeTheSame) {
  load();
  wind(0, 30, 0);
  EXPECT_THAT(references_, SizeIs(0));
  wind(30, 400, 0);
  ASSERT_THAT(references_, SizeIs(1));
  const std::int64_t ahead_ns = conversions::to_ns(references_[0]->time_ref()) - conversions::stamp_ns(*references_[0]);
  EXPECT_NEAR(static_cast<double>(ahead_ns), 0.0, 1e7);
  EXPECT_FALSE(harness_.log_contains("of the stereo camera's"));
}

TEST_F(LocalizerOnAWindingRoad, TellsTheTimeOfThePanoramicCameraAgainAfterAllClocksWereSetBack) {
  load();
  wind(0, 400, 200'000'000);
  ASSERT_THAT(references_, SizeIs(1));
  wind(400, 450, 200'000'000, 200);
  EXPECT_THAT(references_, SizeIs(1)) << "before it is known to be the same";
  wind(450, 800, 200'000'000, 200);
  ASSERT_THAT(references_, SizeIs(2));
  const std::int64_t ahead_ns = conversions::to_ns(references_[1]->time_ref()) - conversions::stamp_ns(*references_[1]);
  EXPECT_NEAR(static_cast<double>(ahead_ns), 2e8, 1e7);
}

TEST_F(LocalizerOnAWindingRoad, SaysThatThePanoramasTurnAtNoOffsetOfTheirClock) {
  load();
  wind(0, 1000, 2'500'000'000);
  EXPECT_TRUE(harness_.log_contains("no offset of the panoramic camera's clock up to 2.0 s"));
}

}  // namespace
}  // namespace panvo::localizer
