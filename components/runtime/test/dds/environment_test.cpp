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
  for (const char* name :
       {"ROS_DOMAIN_ID", "ROS_DISTRO", "ROS_LOCALHOST_ONLY", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_STATIC_PEERS"}) {
    unsetenv(name);
  }
  for (const auto& [name, value] : variables) setenv(name.c_str(), value.c_str(), 1);
  return dds_settings_from_environment();
}

TEST(Environment, WithoutVariablesGivesTheDefaults) {
  const auto settings = settings_with({});
  EXPECT_EQ(settings.domain, 0);
  EXPECT_EQ(settings.ros_distro, "jazzy");
  EXPECT_EQ(settings.range, DiscoveryRange::kSubnet);
  EXPECT_THAT(settings.peers, testing::IsEmpty());
}

TEST(Environment, IsRead) {
  const auto settings =
      settings_with({{"ROS_DOMAIN_ID", "232"}, {"ROS_DISTRO", "humble"}, {"ROS_LOCALHOST_ONLY", "1"}});
  EXPECT_EQ(settings.domain, 232);
  EXPECT_EQ(settings.ros_distro, "humble");
  EXPECT_EQ(settings.range, DiscoveryRange::kLoopback);  // as Humble does
}

TEST(Environment, GivesTheRangeOfDiscoveryAsInRos2) {
  using enum DiscoveryRange;
  const auto range = [](const std::string& name) {
    return settings_with({{"ROS_AUTOMATIC_DISCOVERY_RANGE", name}}).range;
  };
  EXPECT_EQ(range("SUBNET"), kSubnet);
  EXPECT_EQ(range("LOCALHOST"), kLocalhost);
  EXPECT_EQ(range("OFF"), kOff);
  EXPECT_EQ(range("SYSTEM_DEFAULT"), kSystemDefault);
  EXPECT_THROW(range("HOUSE"), ConfigError);
  EXPECT_EQ(settings_with({{"ROS_LOCALHOST_ONLY", "1"}}).range, kLocalhost);
  EXPECT_EQ(settings_with({{"ROS_LOCALHOST_ONLY", "0"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"}}).range, kOff);
}

TEST(Environment, GivesThePeersUnlessLocalhostOnly) {
  EXPECT_THAT(settings_with({{"ROS_STATIC_PEERS", "robot.local;10.0.0.2;"}}).peers,
              testing::ElementsAre("robot.local", "10.0.0.2"));
  const auto local = settings_with(
      {{"ROS_STATIC_PEERS", "10.0.0.2"}, {"ROS_LOCALHOST_ONLY", "1"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"}});
  EXPECT_THAT(local.peers, testing::IsEmpty());
  EXPECT_EQ(local.range, DiscoveryRange::kLocalhost);
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
