// SPDX-License-Identifier: Apache-2.0
// Settings from ROS 2's environment variables.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {
namespace {

DdsSettings settings_with(const std::map<std::string, std::string>& variables) {
  for (const char* name : {"ROS_DOMAIN_ID", "ROS_DISTRO", "ROS_LOCALHOST_ONLY", "ROS_AUTOMATIC_DISCOVERY_RANGE"}) {
    unsetenv(name);
  }
  for (const auto& [name, value] : variables) setenv(name.c_str(), value.c_str(), 1);
  return dds_settings_from_environment();
}

TEST(Environment, WithoutVariablesGivesTheDefaults) {
  const auto settings = settings_with({});
  EXPECT_EQ(settings.domain, 0);
  EXPECT_EQ(settings.ros_distro, "jazzy");
  EXPECT_FALSE(settings.localhost_only);
}

TEST(Environment, IsRead) {
  const auto settings =
      settings_with({{"ROS_DOMAIN_ID", "232"}, {"ROS_DISTRO", "humble"}, {"ROS_LOCALHOST_ONLY", "1"}});
  EXPECT_EQ(settings.domain, 232);
  EXPECT_EQ(settings.ros_distro, "humble");
  EXPECT_TRUE(settings.localhost_only);
  EXPECT_FALSE(settings_with({{"ROS_LOCALHOST_ONLY", "0"}}).localhost_only);
  EXPECT_TRUE(settings_with({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST"}}).localhost_only);
}

TEST(Environment, OfADomainThatIsNoneIsRefusedWithTheRange) {
  for (const char* domain : {"233", "-1", "one", "1.5", "99999999999"}) {
    try {
      settings_with({{"ROS_DOMAIN_ID", domain}});
      ADD_FAILURE() << domain;
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr(domain), testing::HasSubstr("0 to 232")));
    }
  }
  EXPECT_THROW(settings_with({{"ROS_LOCALHOST_ONLY", "yes"}}), ConfigError);
  settings_with({});
}

}  // namespace
}  // namespace panvo::runtime
