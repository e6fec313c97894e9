// SPDX-License-Identifier: Apache-2.0
// Synthetic poses at 10 Hz with known scores.
#include "panvo/evaluation/trust.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace panvo::evaluation {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

std::int64_t at(double t_s) { return static_cast<std::int64_t>(t_s * 1e9 + 0.5); }

/// Poses from 0 to 10 s with an error of 0.5 sigma, tracking, usable; `change` modifies each pose.
std::vector<TrustSample> timeline(const std::function<void(double t_s, TrustSample&)>& change) {
  std::vector<TrustSample> samples;
  for (int i = 0; i <= 100; ++i) {
    TrustSample sample{i * kSecond / 10, 0.05, 0.5, true, true, std::nullopt};
    change(i / 10.0, sample);
    samples.push_back(sample);
  }
  return samples;
}

bool is_within(double t_s, double from_s, double to_s) { return t_s > from_s - 1e-6 && t_s < to_s - 1e-6; }

const Disturbance kFourToSix{at(4.0), at(6.0)};

TEST(TrustScore, OfPosesThatKeepWhatTheyPromiseHasNothingToSay) {
  const auto score = score_trust(timeline([](double, TrustSample&) {}), kFourToSix);
  EXPECT_EQ(score.poses, 101U);
  EXPECT_DOUBLE_EQ(score.max_error_over_sigma, 0.5);
  EXPECT_EQ(score.outside_95, 0U);
  EXPECT_EQ(score.max_misleading_s, 0.0);
  EXPECT_FALSE(score.time_to_alarm_s);
  EXPECT_TRUE(score.is_never_noticed);
  EXPECT_EQ(score.time_to_recover_s, 0.0);
  EXPECT_FALSE(score.worst_over_level) << "no protection level";
}

TEST(TrustScore, CountsErrorsOutsideTheBoundsOfTwoDimensions) {
  // The bounds are 2.448 and 3.717 sigma.
  const auto score = score_trust(timeline([](double t_s, TrustSample& sample) {
                                   if (is_within(t_s, 1.0, 2.0)) sample.error_over_sigma = 2.44;
                                   if (is_within(t_s, 2.0, 3.0)) sample.error_over_sigma = 2.46;
                                   if (is_within(t_s, 3.0, 3.5)) sample.error_over_sigma = 3.73;
                                 }),
                                 std::nullopt);
  EXPECT_EQ(score.outside_95, 15U);
  EXPECT_EQ(score.outside_999, 5U);
}

TEST(TrustScore, OfAnAlarmThatComesLateTellsHowLateAndForHowLongItMisled) {
  const auto score = score_trust(timeline([](double t_s, TrustSample& sample) {
                                   if (is_within(t_s, 5.0, 8.0)) sample.error_over_sigma = 10.0;
                                   if (is_within(t_s, 6.2, 9.0)) sample.is_tracking = false;
                                 }),
                                 kFourToSix);
  EXPECT_NEAR(*score.time_to_alarm_s, 1.2, 1e-9);
  EXPECT_NEAR(score.max_misleading_s, 1.2, 1e-9);
  EXPECT_NEAR(*score.noticed_s, 2.2, 1e-9) << "from the start of the disturbance";
  EXPECT_NEAR(*score.time_to_recover_s, 3.0, 1e-9) << "from its end";
}

TEST(TrustScore, TakesWhatTheIntegritySaysForAnAlarmButNotForAState) {
  const auto score = score_trust(timeline([](double t_s, TrustSample& sample) {
                                   if (!is_within(t_s, 5.0, 7.0)) return;
                                   sample.error_over_sigma = 10.0;
                                   sample.is_usable = false;
                                 }),
                                 kFourToSix);
  EXPECT_EQ(*score.time_to_alarm_s, 0.0);
  EXPECT_NEAR(score.max_misleading_s, 2.0, 1e-9);
}

TEST(TrustScore, HasNoAlarmDueForAMomentaryExcursion) {
  const auto score = score_trust(timeline([](double t_s, TrustSample& sample) {
                                   if (is_within(t_s, 5.0, 5.5)) sample.error_over_sigma = 4.0;
                                 }),
                                 std::nullopt);
  EXPECT_FALSE(score.time_to_alarm_s);
  EXPECT_NEAR(score.max_misleading_s, 0.5, 1e-9);
}

TEST(TrustScore, TakesTheWholeStretchWhereNoAlarmComes) {
  const auto score = score_trust(timeline([](double t_s, TrustSample& sample) {
                                   if (t_s > 6.95) sample.error_over_sigma = 4.0;
                                 }),
                                 kFourToSix);
  EXPECT_NEAR(*score.time_to_alarm_s, 3.0, 1e-9);
  EXPECT_TRUE(score.is_never_recovered);
  EXPECT_FALSE(score.time_to_recover_s);
}

TEST(TrustScore, TakesSilenceForAnAlarmAndDoesNotBlameThePoseBeforeItForLonger) {
  auto samples = timeline([](double t_s, TrustSample& sample) {
    if (is_within(t_s, 3.9, 4.0)) sample.error_over_sigma = 10.0;
  });
  std::erase_if(samples, [](const TrustSample& sample) { return is_within(sample.stamp_ns * 1e-9, 4.0, 7.0); });
  const auto score = score_trust(samples, kFourToSix);
  EXPECT_NEAR(*score.time_to_alarm_s, kAlarmTime_s, 1e-9);
  EXPECT_NEAR(score.max_misleading_s, kAlarmTime_s, 1e-9);
  EXPECT_NEAR(*score.noticed_s, 0.4, 1e-9);
  EXPECT_NEAR(*score.time_to_recover_s, 1.0, 1e-9) << "poses resume one second after the end";
}

TEST(TrustScore, HoldsErrorsAgainstTheProtectionLevel) {
  const auto score = score_trust(timeline([](double t_s, TrustSample& sample) {
                                   sample.protection_level_m = t_s < 4.95 ? 0.2 : 1.0;
                                   if (is_within(t_s, 1.0, 3.0)) sample.error_m = 0.3;
                                   if (is_within(t_s, 6.0, 10.1)) sample.is_tracking = false;
                                 }),
                                 std::nullopt);
  EXPECT_EQ(score.with_level, 101U);
  EXPECT_EQ(score.beyond_level, 20U);
  EXPECT_NEAR(*score.worst_over_level, 1.5, 1e-12);
  EXPECT_NEAR(*score.time_to_alarm_s, 2.0, 1e-9) << "an error beyond the level also needs an alarm";
  EXPECT_EQ(score.levels_while_tracking_m.size(), 60U);
}

TEST(TrustScore, OfADisturbanceWithoutEndHasNoRecovery) {
  const auto score = score_trust(timeline([](double, TrustSample&) {}), Disturbance{at(4.0), std::nullopt});
  EXPECT_FALSE(score.time_to_recover_s);
  EXPECT_FALSE(score.is_never_recovered);
}

TEST(TrustScore, OfARunThatEndsInTheDisturbanceIsNeverRecovered) {
  auto samples = timeline([](double, TrustSample&) {});
  samples.resize(50);
  EXPECT_TRUE(score_trust(samples, kFourToSix).is_never_recovered);
}

}  // namespace
}  // namespace panvo::evaluation
