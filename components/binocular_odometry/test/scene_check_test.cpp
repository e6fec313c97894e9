// SPDX-License-Identifier: Apache-2.0
#include "scene_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace panvo::binocular_odometry {
namespace {

using ::testing::HasSubstr;

/// Frames at 25 Hz, of which both cameras see 80 % of the features.
class Scene : public ::testing::Test {
 protected:
  void see_well(int frames) {
    for (int i = 0; i < frames; ++i) ASSERT_EQ(add({280, 270, 350, 280}), std::nullopt) << i;
  }

  std::optional<std::string> add(const FeatureCounts& counts) {
    stamp_ns_ += 40'000'000;
    return check_.find_fault(counts, stamp_ns_);
  }

  std::int64_t stamp_ns_ = 0;
  SceneCheck check_;
};

TEST_F(Scene, IsNotThatOfBothCamerasIfMostFeaturesAreMissingInOne) {
  see_well(1);
  const auto fault = add({280, 139, 350, 150});
  ASSERT_TRUE(fault);
  EXPECT_THAT(*fault, HasSubstr("of 280 features tracked in the left image, 139 were found in the right image, 140"));
}

TEST_F(Scene, IsThatOfBothCamerasAgainWhenAboutAsManyMatchAsBefore) {
  see_well(50);
  ASSERT_TRUE(add({280, 100, 350, 110}));
  for (int i = 0; i < 100; ++i) {
    const auto fault = add({0, 0, 300, 130});  // new features, of which some fit by chance
    ASSERT_TRUE(fault) << i;
    EXPECT_THAT(*fault, HasSubstr("of 300 features in the left image, 130 were found in the right image, 240 as a"));
  }
  EXPECT_EQ(add({0, 0, 300, 200}), std::nullopt);
  EXPECT_EQ(add({200, 180, 300, 130}), std::nullopt) << "a low share of matches alone is not a fault";
}

TEST_F(Scene, IsTakenAsItIsAfterTenSeconds) {
  see_well(50);
  ASSERT_TRUE(add({280, 100, 350, 110}));
  int faults = 1;
  while (add({0, 0, 300, 130})) ++faults;
  EXPECT_EQ(faults, 250);
  ASSERT_TRUE(add({100, 30, 300, 40}));
  EXPECT_EQ(add({0, 0, 300, 130}), std::nullopt) << "the share that is usual now";
}

TEST_F(Scene, IsNotComparedBeforeItIsKnown) {
  see_well(5);
  ASSERT_TRUE(add({280, 100, 350, 110}));
  EXPECT_EQ(add({0, 0, 300, 130}), std::nullopt);
}

}  // namespace
}  // namespace panvo::binocular_odometry
