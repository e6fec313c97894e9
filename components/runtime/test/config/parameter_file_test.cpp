// SPDX-License-Identifier: Apache-2.0
#include "config/parameter_file.hpp"

#include <gtest/gtest.h>

namespace panvo::runtime {
namespace {

TEST(SectionIsFor, NamesAndWildcardsOfRos) {
  EXPECT_TRUE(section_is_for("/**", "/odometry"));
  EXPECT_TRUE(section_is_for("/**", "/fleet/robot/odometry"));
  EXPECT_TRUE(section_is_for("odometry", "/odometry"));
  EXPECT_TRUE(section_is_for("odometry", "/robot/odometry"));
  EXPECT_TRUE(section_is_for("/robot/odometry", "/robot/odometry"));
  EXPECT_TRUE(section_is_for("robot/odometry", "/robot/odometry"));
  EXPECT_TRUE(section_is_for("/*/odometry", "/robot/odometry"));
  EXPECT_TRUE(section_is_for("/**/odometry", "/odometry"));
  EXPECT_TRUE(section_is_for("/**/odometry", "/fleet/robot/odometry"));
}

TEST(SectionIsFor, NoOtherNode) {
  EXPECT_FALSE(section_is_for("/odometry", "/robot/odometry"));
  EXPECT_FALSE(section_is_for("odometry", "/odometry2"));
  EXPECT_FALSE(section_is_for("/*", "/robot/odometry"));
  EXPECT_FALSE(section_is_for("/*/odometry", "/odometry"));
  EXPECT_FALSE(section_is_for("/robot/**", "/other/odometry"));
  EXPECT_FALSE(section_is_for("/robot/odometry", "/robot"));
}

}  // namespace
}  // namespace panvo::runtime
