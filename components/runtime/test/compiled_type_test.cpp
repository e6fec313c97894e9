// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/compiled_type.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nav_msgs/msg/Odometry.h"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {
namespace {

TEST(CompiledType, IsThatOfTheLibrary) {
  EXPECT_EQ(&compiled_type<nav_msgs::msg::Odometry>(), &interfaces::message_type<nav_msgs::msg::Odometry>());
}

TEST(CompiledType, OfAnotherDefinitionIsRefusedByName) {
  const auto& type = interfaces::message_type<nav_msgs::msg::Odometry>();
  try {
    require_definition(type, "RIHS01_of_earlier_days");
    FAIL() << "was accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("another definition of nav_msgs/msg/Odometry (RIHS01_of_earlier_days)"));
    EXPECT_THAT(error.what(), testing::HasSubstr("build the plugin again"));
  }
}

}  // namespace
}  // namespace panvo::runtime
