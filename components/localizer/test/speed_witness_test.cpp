// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/speed_witness.hpp"

#include <gtest/gtest.h>

#include <optional>

namespace panvo::localizer {
namespace {

/// After ten stretches of 1 m, each with this parallax.
SpeedWitness after(double rad) {
  SpeedWitness witness;
  for (int i = 1; i <= 10; ++i) witness.add(i, 1.0, rad);
  return witness;
}

TEST(SpeedWitness, TellsWhichOfTwoSpeedsParallaxFits) {
  const auto witness = after(0.08);
  EXPECT_EQ(witness.judge(0.16, 2.0, 1.0), SpeedVerdict::kAgrees);
  EXPECT_EQ(witness.judge(0.08, 2.0, 1.0), SpeedVerdict::kContradicts);
  EXPECT_EQ(witness.judge(0.04, 0.5, 1.0), SpeedVerdict::kAgrees);
  EXPECT_EQ(witness.judge(0.08, 0.5, 1.0), SpeedVerdict::kContradicts);
  EXPECT_EQ(witness.judge(-0.08, 0.5, 1.0), SpeedVerdict::kContradicts) << "backwards";
}

TEST(SpeedWitness, KnowsThatSceneryChanges) {
  const auto witness = after(0.08);
  for (const double scenery : {0.8, 1.25}) {
    EXPECT_EQ(witness.judge(scenery * 0.16, 2.0, 1.0), SpeedVerdict::kAgrees) << scenery;
    EXPECT_EQ(witness.judge(scenery * 0.08, 2.0, 1.0), SpeedVerdict::kContradicts) << scenery;
  }
  EXPECT_EQ(witness.judge(0.08, 1.0, 1.2), SpeedVerdict::kUnclear) << "two speeds that are too alike";
  EXPECT_EQ(witness.judge(0.40, 2.0, 1.0), SpeedVerdict::kUnclear) << "neither";
}

TEST(SpeedWitness, SeesAVehicleThatStands) {
  const auto witness = after(0.08);
  EXPECT_EQ(witness.judge(0.0, 0.0, 1.0), SpeedVerdict::kAgrees);
  EXPECT_EQ(witness.judge(0.0, 1.0, 0.0), SpeedVerdict::kContradicts);
  EXPECT_EQ(witness.judge(0.08, 0.0, 1.0), SpeedVerdict::kContradicts);
}

TEST(SpeedWitness, IsUnsureWhereLittleMoves) {
  EXPECT_EQ(after(0.0005).judge(0.0005, 2.0, 1.0), SpeedVerdict::kUnclear) << "far away";
  EXPECT_EQ(after(0.08).judge(0.001, 0.02, 0.01), SpeedVerdict::kUnclear) << "a short way";
  EXPECT_EQ(SpeedWitness().judge(0.08, 2.0, 1.0), SpeedVerdict::kUnclear) << "at the start";
}

TEST(SpeedWitness, WithoutAnotherSpeedSeesOnlyWhetherParallaxIsAsUsual) {
  const auto witness = after(0.08);
  EXPECT_EQ(witness.judge(0.10, 1.0, std::nullopt), SpeedVerdict::kAgrees);
  EXPECT_EQ(witness.judge(0.20, 1.0, std::nullopt), SpeedVerdict::kUnclear);
}

TEST(SpeedWitness, MeasuresALengthByParallaxAlone) {
  const auto length = after(0.08).length(-0.16);
  ASSERT_TRUE(length);
  EXPECT_NEAR(length->m, 2.0, 1e-9);
  EXPECT_NEAR(length->error_m, 0.005 / 0.08, 1e-9) << "a pixel";
  EXPECT_FALSE(SpeedWitness().length(0.16)) << "at the start";
  EXPECT_FALSE(after(0.0).length(0.16)) << "nothing near";
}

TEST(SpeedWitness, ComparesWithTheLastMetresOnly) {
  auto witness = after(0.20);
  for (int i = 11; i <= 17; ++i) witness.add(i, 1.0, 0.05);
  EXPECT_EQ(witness.judge(0.10, 2.0, 1.0), SpeedVerdict::kAgrees);
  witness.add(18.0, 1.0, 0.9);  // one that is wrong
  EXPECT_EQ(witness.judge(0.10, 2.0, 1.0), SpeedVerdict::kAgrees);
  witness.add(18.1, 0.1, 0.5);  // too short
  EXPECT_EQ(witness.judge(0.10, 2.0, 1.0), SpeedVerdict::kAgrees);
  witness.forget();
  EXPECT_EQ(witness.judge(0.10, 2.0, 1.0), SpeedVerdict::kUnclear);
}

}  // namespace
}  // namespace panvo::localizer
