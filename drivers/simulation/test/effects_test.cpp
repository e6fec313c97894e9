// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/effects.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace panvo::simulation {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Effects, AreSwitchedOnByName) {
  const auto effects = effects_of({"rain", "movers"});
  EXPECT_TRUE(effects.rain);
  EXPECT_TRUE(effects.movers);
  EXPECT_FALSE(effects.smear);
  EXPECT_THAT(names_of(effects), ElementsAre("movers", "rain"));
}

TEST(Effects, SeveralMayStandInOneName) {
  EXPECT_THAT(names_of(effects_of({"rain, smear", "movers"})), ElementsAre("movers", "rain", "smear"));
}

TEST(Effects, AllMeansEveryOneAndNoneMeansNoOne) {
  EXPECT_EQ(names_of(effects_of({"all"})).size(), kEffectNames.size());
  EXPECT_TRUE(names_of(effects_of({"none"})).empty());
  EXPECT_TRUE(names_of(effects_of({})).empty());
}

TEST(Effects, AnUnknownOneIsNamedWithThoseThereAre) {
  try {
    effects_of({"rain", "snow"});
    FAIL() << "snow was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("'snow'"), HasSubstr("sudden_light"), HasSubstr("time_offset")));
  }
}

}  // namespace
}  // namespace panvo::simulation
