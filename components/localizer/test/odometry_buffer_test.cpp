// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/odometry_buffer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace panvo::localizer {
namespace {

constexpr std::int64_t kEach_ns = 40'000'000;

/// Straight, 0.2 m per step; each step has its own yaw variance.
OdometryBuffer straight(const std::vector<double>& yaw_variances) {
  OdometryBuffer chain(60.0);
  OdometryPose pose;
  chain.add(pose);
  for (const double variance : yaw_variances) {
    vision::Matrix6d gained = 1e-8 * vision::Matrix6d::Identity();
    gained(5, 5) = variance;
    Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
    step.translation().x() = 0.2;
    pose.covariance = vision::compose_covariance(pose.odom_from_base, pose.covariance, step, gained);
    pose.odom_from_base = pose.odom_from_base * step;
    pose.stamp_ns += kEach_ns;
    chain.add(pose);
  }
  return chain;
}

TEST(OdometryBuffer, RemembersWhatItWasGivenAndWhatLiesBetween) {
  const auto chain = straight({1e-4, 1e-4, 1e-4});
  ASSERT_TRUE(chain.at(kEach_ns + kEach_ns / 2));
  EXPECT_NEAR(chain.at(kEach_ns + kEach_ns / 2)->pose.odom_from_base.translation().x(), 0.3, 1e-12);
  EXPECT_NEAR(chain.at(kEach_ns + kEach_ns / 2)->way_m, 0.3, 1e-12);
  EXPECT_NEAR(chain.latest().pose.covariance(5, 5), 3e-4, 1e-9);
  EXPECT_FALSE(chain.at(4 * kEach_ns));
  EXPECT_FALSE(chain.at(-1));
}

TEST(OdometryBuffer, GoesOnForAMomentAsItWent) {
  OdometryBuffer chain(60.0);
  OdometryPose pose;
  chain.add(pose);
  EXPECT_FALSE(chain.at(1'000'000)) << "motion unknown";
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  step.translation().x() = 0.4;
  step.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 0.08));
  pose.odom_from_base = step;
  pose.stamp_ns = kEach_ns;
  pose.covariance = 8e-4 * vision::Matrix6d::Identity();
  chain.add(pose);
  const auto ahead = chain.at(kEach_ns + kEach_ns / 8);
  ASSERT_TRUE(ahead);
  EXPECT_EQ(ahead->pose.stamp_ns, kEach_ns + kEach_ns / 8);
  EXPECT_NEAR(ahead->way_m, 0.45, 1e-9);
  // On its circle, along which the first 0.4 m turned from -0.04 to 0.04 rad relative to the chord.
  EXPECT_NEAR(ahead->pose.odom_from_base.translation().x(), 0.4 + 0.05 * std::cos(0.045), 1e-4);
  EXPECT_NEAR(ahead->pose.odom_from_base.translation().y(), 0.05 * std::sin(0.045), 1e-4);
  EXPECT_NEAR(ahead->pose.covariance(5, 5), 9e-4, 1e-12);
  EXPECT_NEAR(chain.turn(0, kEach_ns + kEach_ns / 8)->change_rad, 0.09, 1e-9);
  EXPECT_NEAR(*chain.raw_turn(0, kEach_ns + kEach_ns / 8), 0.09, 1e-9);
  EXPECT_NEAR((*chain.twist(kEach_ns + kEach_ns / 8))[5], 2.0, 1e-9);
  EXPECT_FALSE(chain.at(kEach_ns + kEach_ns / 8 + 1)) << "at most 5 ms";
}

TEST(OdometryBuffer, ForgetsWhatIsTooLongAgo) {
  OdometryBuffer chain(1.0);
  OdometryPose pose;
  for (int i = 0; i < 100; ++i) {
    pose.stamp_ns = i * kEach_ns;
    ASSERT_TRUE(chain.add(pose));
  }
  EXPECT_FALSE(chain.at(70 * kEach_ns));
  EXPECT_TRUE(chain.at(75 * kEach_ns));
}

TEST(OdometryBuffer, RefusesWhatIsLateOrNoNumber) {
  auto chain = straight({1e-4});
  OdometryPose pose;
  pose.stamp_ns = kEach_ns;
  EXPECT_FALSE(chain.add(pose));
  pose.stamp_ns = 2 * kEach_ns;
  pose.covariance(3, 3) = std::nan("");
  EXPECT_FALSE(chain.add(pose));
}

TEST(OdometryBuffer, PutsATurnIntoTheStepThatWasLeastSure) {
  auto chain = straight({1e-6, 1e-6, 1e-2, 1e-6, 1e-6});
  const auto before = chain.turn(0, 5 * kEach_ns);
  ASSERT_TRUE(before);
  EXPECT_NEAR(before->change_rad, 0.0, 1e-12);
  EXPECT_NEAR(before->variance_rad2, 1e-2 + 4e-6, 1e-8);
  chain.apply_yaw_correction(0, 5 * kEach_ns, 0.1, 0.01);
  EXPECT_NEAR(chain.turn(0, 5 * kEach_ns)->change_rad, 0.1, 1e-9);
  EXPECT_NEAR(chain.turn(0, 2 * kEach_ns)->change_rad, 0.0, 1e-4);
  EXPECT_NEAR(chain.turn(2 * kEach_ns, 3 * kEach_ns)->change_rad, 0.1, 1e-4);
  EXPECT_NEAR(chain.turn(0, 5 * kEach_ns)->variance_rad2, 0.01 * before->variance_rad2, 1e-8);
  // straight, a turn of 0.1 rad in the middle of the third step, straight
  EXPECT_NEAR(chain.latest().pose.odom_from_base.translation().y(), 0.2 * std::sin(0.05) + 0.4 * std::sin(0.1), 1e-4);
  EXPECT_NEAR(chain.latest().pose.covariance(5, 5), 0.01 * before->variance_rad2, 1e-6);
}

TEST(OdometryBuffer, TakesOnlyThePartOfAStepThatLiesInTheStretch) {
  auto chain = straight({1e-4, 1e-4});
  EXPECT_NEAR(chain.turn(kEach_ns / 2, kEach_ns)->variance_rad2, 0.5e-4, 1e-10);
  chain.apply_yaw_correction(kEach_ns / 2, kEach_ns + kEach_ns / 2, 0.02, 1.0);
  EXPECT_NEAR(chain.turn(0, 2 * kEach_ns)->change_rad, 0.02, 1e-9);
  EXPECT_NEAR(chain.turn(0, kEach_ns)->change_rad, 0.01, 1e-9);
}

TEST(OdometryBuffer, DistrustsAStretch) {
  auto chain = straight({1e-4, 1e-4, 1e-4});
  const double before = chain.latest().pose.covariance(2, 2);
  chain.inflate_covariance(kEach_ns, 2 * kEach_ns, 25.0, 4.0);
  EXPECT_NEAR(chain.turn(kEach_ns, 2 * kEach_ns)->variance_rad2, 25e-4, 1e-8);
  EXPECT_NEAR(chain.turn(0, kEach_ns)->variance_rad2, 1e-4, 1e-8);
  EXPECT_NEAR(chain.latest().pose.covariance(5, 5), 27e-4, 1e-8);
  EXPECT_NEAR(chain.latest().pose.covariance(2, 2), before + 3.0 * 1e-8 * (1.0 + 0.2 * 0.2),
              1e-10);  // height, and pitch over the following 0.2 m
  chain.inflate_covariance(kEach_ns, 2 * kEach_ns, 25.0, 4.0);
  EXPECT_NEAR(chain.turn(kEach_ns, 2 * kEach_ns)->variance_rad2, 625e-4, 1e-8);
  EXPECT_NEAR(chain.latest().pose.covariance(2, 2), before + 3.0 * 1e-8 * (1.0 + 0.2 * 0.2), 1e-10) << "only once";
}

TEST(OdometryBuffer, AllowsForSoMuchInAllOverAStretch) {
  auto chain = straight({1e-4, 1e-4, 1e-4});
  const auto before = chain.latest().pose.covariance;
  chain.allow(kEach_ns / 2, 2 * kEach_ns + kEach_ns / 2, 0.04, 0.02);
  EXPECT_NEAR(chain.turn(0, 3 * kEach_ns)->variance_rad2, 3e-4 + 0.02, 1e-9);
  EXPECT_NEAR(chain.turn(0, kEach_ns)->variance_rad2, 1e-4 + 0.005, 1e-9) << "first step: a quarter of it";
  const auto after = chain.latest().pose.covariance;
  EXPECT_NEAR(after(0, 0) - before(0, 0), 0.04, 1e-9);
  EXPECT_GT(after(1, 1) - before(1, 1), 0.04) << "plus the effect of the yaw";
  EXPECT_NEAR(after(2, 2), before(2, 2), 1e-12);
}

TEST(OdometryBuffer, TakesBackWhatWasPutRightSinceTheMark) {
  auto chain = straight({1e-4, 1e-4, 1e-4, 1e-4});
  chain.apply_yaw_correction(0, 2 * kEach_ns, 0.02, 0.5);
  chain.mark(kEach_ns);
  const OdometrySample before = chain.latest();
  chain.inflate_covariance(kEach_ns, 4 * kEach_ns, 9.0, 2.0);
  chain.apply_yaw_correction(kEach_ns, 4 * kEach_ns, 0.1, 0.1);
  EXPECT_NEAR(chain.turn(0, 4 * kEach_ns)->change_rad, 0.12, 1e-9);
  chain.revert();
  EXPECT_NEAR(chain.turn(0, 4 * kEach_ns)->change_rad, 0.02, 1e-9) << "changes before the mark remain";
  EXPECT_TRUE(chain.latest().pose.odom_from_base.isApprox(before.pose.odom_from_base, 1e-12));
  EXPECT_TRUE(chain.latest().pose.covariance.isApprox(before.pose.covariance, 1e-12));
}

/// Winding, with errors of the turns: a share of each turn, and a lean per metre.
OdometryBuffer winding(double scale, double lean_rad_m) {
  OdometryBuffer chain(600.0);
  OdometryPose pose;
  pose.odom_from_base.linear() = vision::so3_exp({0.0, 0.0, 0.7});
  chain.add(pose);
  for (int i = 0; i < 500; ++i) {
    const double turn_rad = 0.01 * std::sin(0.02 * i) + 0.003;
    Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
    step.translation().x() = 0.2;
    step.linear() = vision::so3_exp({0.0, 0.0, turn_rad});
    pose.odom_from_base = pose.odom_from_base * turned_more(step, scale * turn_rad + lean_rad_m * 0.2);
    pose.stamp_ns += kEach_ns;
    chain.add(pose);
  }
  return chain;
}

TEST(OdometryBuffer, UndoesTheTurnsOfACompassButNotWhatElseIsKnownOfAStretch) {
  auto chain = straight({1e-4, 1e-4, 1e-4, 1e-4});
  chain.apply_yaw_correction(0, kEach_ns, 0.1, 0.5);
  auto expected = chain;
  chain.apply_yaw_correction(kEach_ns, 4 * kEach_ns, 0.2, 0.25);
  chain.correct_turns({.scale = 0.0, .lean_rad_m = 0.1});
  for (auto* each : {&chain, &expected}) each->allow(2 * kEach_ns, 3 * kEach_ns, 0.04, 0.0);
  chain.undo_turns(kEach_ns, TurnErrorFilter(0.01, 0.01));
  expected.correct_turns({.scale = 0.0, .lean_rad_m = 0.1});
  EXPECT_NEAR(chain.turn(0, kEach_ns)->change_rad, expected.turn(0, kEach_ns)->change_rad, 1e-12) << "before";
  EXPECT_NEAR(chain.turn(kEach_ns, 4 * kEach_ns)->change_rad, 0.0, 1e-12);
  EXPECT_NEAR(chain.turn(0, 4 * kEach_ns)->variance_rad2, expected.turn(0, 4 * kEach_ns)->variance_rad2, 1e-12);
  EXPECT_NEAR(chain.latest().pose.covariance(1, 1), expected.latest().pose.covariance(1, 1), 1e-3);
  EXPECT_GT(chain.latest().pose.covariance(1, 1), 0.04) << "what a stretch was doubted for stays";
  chain.revert();
  EXPECT_NEAR(chain.turn(kEach_ns, 4 * kEach_ns)->change_rad, 0.0, 1e-12) << "the undone turns are not restored";
}

TEST(OdometryBuffer, TellsWhatSystematicErrorsOfTheTurnsDoToPositionAndHeading) {
  const std::int64_t from_ns = 100 * kEach_ns, to_ns = 470 * kEach_ns + kEach_ns / 3;
  const auto exact = winding(0.0, 0.0);
  const auto a = *exact.at(from_ns), b = *exact.at(to_ns);
  const auto moved = [&](const OdometryBuffer& chain) {
    return Eigen::Isometry3d(chain.at(from_ns)->pose.odom_from_base.inverse() * chain.at(to_ns)->pose.odom_from_base);
  };
  for (const auto& [scale, lean_rad_m] : {std::pair(1e-4, 0.0), std::pair(0.0, 1e-5), std::pair(1e-4, -1e-5)}) {
    const Eigen::Vector2d errors(scale, lean_rad_m);
    const auto off = vision::pose_error(moved(winding(scale, lean_rad_m)), moved(exact));
    const vision::Matrix6d covariance = covariance_of_turns(a, b, {errors * errors.transpose(), 0.0});
    const vision::Matrix6d expected = off * off.transpose();
    EXPECT_LT((covariance - expected).norm(), 0.02 * expected.norm()) << scale << " " << lean_rad_m;
  }
  EXPECT_EQ(covariance_of_turns(a, a, {Eigen::Matrix2d::Identity(), 10.0}).norm(), 0.0);
}

TEST(OdometryBuffer, CorrectsThePathByWhatIsLearnedOfItsTurns) {
  constexpr double kScale = 1e-3, kLeanPerMetre_rad = 1e-4;
  const auto latest = [](const OdometryBuffer& chain) { return chain.latest().pose.odom_from_base; };
  const auto exact = winding(0.0, 0.0);
  auto chain = winding(kScale, kLeanPerMetre_rad);
  const double off = vision::pose_error(latest(chain), latest(exact)).norm();
  chain.correct_turns({kScale, kLeanPerMetre_rad, 0.0});
  EXPECT_GT(off, 0.1);
  EXPECT_LT(vision::pose_error(latest(chain), latest(exact)).norm(), 0.01 * off);
}

TEST(OdometryBuffer, CorrectsALeanThatChangesWhereItWasLearnedAndNoCompassMeasured) {
  constexpr double kLeanPerMetre_rad = 1e-4;
  auto chain = winding(0.0, 0.0);  // 100 m
  const auto yaw_rad = [&] { return yaw_of(chain.latest().pose.odom_from_base.linear()); };
  chain.apply_yaw_correction(0, 250 * kEach_ns, 0.0, 0.25);
  const double before_rad = yaw_rad();
  chain.correct_turns({0.0, kLeanPerMetre_rad, 20.0});
  const double expected_m = 20.0 * (1.0 - std::exp(-50.0 / 20.0)) + 0.25 * 20.0 * (std::exp(-2.5) - std::exp(-5.0));
  EXPECT_NEAR(before_rad - yaw_rad(), kLeanPerMetre_rad * expected_m, 0.01 * kLeanPerMetre_rad * expected_m);
}

TEST(OdometryBuffer, SystematicErrorsOfTheTurnsActOnWhatNoCompassMeasured) {
  auto chain = winding(0.0, 0.0);  // 100 m
  const auto variance = [&](const Eigen::Vector2d& errors) {
    const Eigen::Matrix2d covariance = errors.cwiseAbs2().asDiagonal();
    return covariance_of_turns(*chain.at(0), chain.latest(), {covariance, 0.0})(vision::kYaw, vision::kYaw);
  };
  const double turned_rad = chain.latest().unmeasured_turn_rad;
  EXPECT_NEAR(turned_rad, 2.42, 0.05);
  EXPECT_NEAR(variance({0.0, 1e-4}), 1e-4, 1e-8);
  const auto measure = [&](double odometry_weight) {
    chain.apply_yaw_correction(50 * kEach_ns, 300 * kEach_ns, 0.0, odometry_weight);
  };
  measure(0.5);
  EXPECT_NEAR(variance({0.0, 1e-4}), std::pow(75.0 * 1e-4, 2), 1e-8) << "half of 50 m, and 50 m";
  measure(0.5);
  EXPECT_NEAR(variance({0.0, 1e-4}), std::pow(62.5 * 1e-4, 2), 1e-8);
  measure(0.0);
  EXPECT_NEAR(variance({0.0, 1e-4}), std::pow(50.0 * 1e-4, 2), 1e-8);
  chain.apply_yaw_correction(0, 500 * kEach_ns, 0.0, 0.1);
  EXPECT_NEAR(variance({0.0, 1e-4}), std::pow(5.0 * 1e-4, 2), 1e-8);
  EXPECT_LT(std::abs(chain.latest().unmeasured_turn_rad), 0.1 * turned_rad);
}

TEST(OdometryBuffer, ALeanThatChangesTurnsLessThanOneThatLasts) {
  const auto chain = winding(0.0, 0.0);  // 100 m
  const auto variance = [&](double memory_m) {
    const Eigen::Matrix2d lean = Eigen::Vector2d(0.0, 1e-8).asDiagonal();
    return covariance_of_turns(*chain.at(0), chain.latest(), {lean, memory_m})(vision::kYaw, vision::kYaw);
  };
  EXPECT_NEAR(variance(0.0), 1e-4, 1e-8) << "for ever";
  EXPECT_NEAR(variance(1e7), 1e-4, 1e-8);
  EXPECT_NEAR(variance(100.0), 2.0 * std::exp(-1.0) * 1e-4, 1e-8);
  EXPECT_NEAR(variance(1.0), 0.02 * 0.99 * 1e-4, 1e-8) << "a hundred independent ones";
}

TEST(OdometryBuffer, TellsTurnsOfMoreThanHalfATurnWhole) {
  for (const double step_rad : {0.05, -0.05}) {
    OdometryBuffer chain(60.0);
    OdometryPose pose;
    chain.add(pose);
    const vision::Matrix6d gained = 1e-8 * vision::Matrix6d::Identity();
    for (int i = 0; i < 300; ++i) {
      Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
      step.linear() = vision::so3_exp({0.0, 0.0, step_rad});
      pose.covariance = vision::compose_covariance(pose.odom_from_base, pose.covariance, step, gained);
      pose.odom_from_base = pose.odom_from_base * step;
      pose.stamp_ns += kEach_ns;
      chain.add(pose);
    }
    for (const double steps : {0.3, 62.0, 63.5, 120.0, 125.9, 290.0, 298.1}) {
      const std::int64_t from_ns = 2 * kEach_ns, to_ns = from_ns + static_cast<std::int64_t>(steps * kEach_ns);
      EXPECT_NEAR(chain.turn(from_ns, to_ns)->change_rad, steps * step_rad, 1e-6) << steps;
      EXPECT_NEAR(*chain.raw_turn(from_ns, to_ns), steps * step_rad, 1e-6) << steps;
    }
    chain.apply_yaw_correction(0, 300 * kEach_ns, 1.0, 1.0);
    EXPECT_NEAR(chain.turn(0, 300 * kEach_ns)->change_rad, 300 * step_rad + 1.0, 1e-6);
    EXPECT_NEAR(*chain.raw_turn(0, 300 * kEach_ns), 300 * step_rad, 1e-6);
    chain.set_clock_back(kEach_ns);
    EXPECT_NEAR(chain.turn(0, 299 * kEach_ns)->change_rad, 299 * (step_rad + 1.0 / 300), 1e-6);
  }
}

/// Odometry that saw nothing of it, as of a blind camera.
TEST(OdometryBuffer, TellsTurnsWholeThatOnlyACompassMeasured) {
  auto chain = straight(std::vector<double>(10, 1e-4));
  for (int i = 0; i < 10; ++i) chain.apply_yaw_correction(i * kEach_ns, (i + 1) * kEach_ns, 1.0, 1.0);
  EXPECT_NEAR(chain.turn(0, 10 * kEach_ns)->change_rad, 10.0, 1e-6);
  EXPECT_NEAR(*chain.raw_turn(0, 10 * kEach_ns), 0.0, 1e-9);
}

TEST(OdometryBuffer, KnowsTheTwist) {
  OdometryBuffer chain(60.0);
  OdometryPose pose;
  chain.add(pose);
  pose.stamp_ns = kEach_ns;
  pose.odom_from_base.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 0.02));
  pose.odom_from_base.translation().x() = 0.2;
  chain.add(pose);
  vision::Vector6d expected;
  expected << 5.0, 0.0, 0.0, 0.0, 0.0, 0.5;
  ASSERT_TRUE(chain.twist(kEach_ns));
  EXPECT_TRUE(chain.twist(kEach_ns)->isApprox(expected, 1e-9));
  EXPECT_TRUE(chain.twist(kEach_ns / 3)->isApprox(expected, 1e-9));
  EXPECT_FALSE(chain.twist(0));
  EXPECT_FALSE(chain.twist(2 * kEach_ns));
}

}  // namespace
}  // namespace panvo::localizer
