// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/qos_profile.hpp"

#include <gtest/gtest.h>

namespace panvo::recorder {
namespace {

using Qos = interfaces::Qos;

constexpr const char* kHumble =
    "- history: 3\n  depth: 0\n  reliability: 1\n  durability: 1\n  deadline:\n    sec: 9223372036\n    nsec: "
    "854775807\n"
    "  lifespan:\n    sec: 10\n    nsec: 0\n  liveliness: 1\n  liveliness_lease_duration:\n    sec: 9223372036\n"
    "    nsec: 854775807\n  avoid_ros_namespace_conventions: false";

TEST(QosProfile, ReadsTheNumbersOfHumble) {
  const auto profiles = parse_qos_profiles(kHumble);
  ASSERT_TRUE(profiles);
  ASSERT_EQ(profiles->size(), 1u);
  EXPECT_EQ((*profiles)[0].history, QosProfile::History::kUnknown);
  EXPECT_EQ((*profiles)[0].durability, QosProfile::Durability::kTransientLocal);
  EXPECT_EQ((*profiles)[0].deadline, QosProfile::Duration{});
  EXPECT_EQ((*profiles)[0].lifespan, (QosProfile::Duration{10, 0}));
}

TEST(QosProfile, IsTheSameAfterWritingInEitherNotation) {
  QosProfile odd;
  odd.history = QosProfile::History::kKeepAll;
  odd.depth = 7;
  odd.reliability = QosProfile::Reliability::kBestEffort;
  odd.durability = QosProfile::Durability::kTransientLocal;
  odd.lifespan = {10, 5};
  odd.liveliness = QosProfile::Liveliness::kManualByTopic;
  odd.avoid_ros_namespace_conventions = true;
  const std::vector<QosProfile> profiles{QosProfile{}, odd};
  for (const auto notation : {QosNotation::kNames, QosNotation::kNumbers}) {
    EXPECT_EQ(parse_qos_profiles(to_text(profiles, notation)), profiles);
  }
  EXPECT_NE(to_text(profiles, QosNotation::kNames).find("durability: transient_local"), std::string::npos);
  EXPECT_NE(to_text(profiles, QosNotation::kNumbers).find("durability: 1"), std::string::npos);
}

TEST(QosProfile, TakesFoxysInfinitiesForInfinite) {
  std::string foxy = kHumble;
  foxy.replace(foxy.find("sec: 9223372036\n    nsec: 854775807"), 35, "sec: 2147483647\n    nsec: 4294967295");
  foxy.replace(foxy.find("sec: 10\n    nsec: 0"), 19, "sec: 0\n    nsec: 0");
  const auto profiles = parse_qos_profiles(foxy);
  ASSERT_TRUE(profiles);
  EXPECT_EQ((*profiles)[0].deadline, QosProfile::Duration{});
  EXPECT_EQ((*profiles)[0].lifespan, QosProfile::Duration{});
}

TEST(QosProfile, IsNoneForEmptyText) { EXPECT_EQ(parse_qos_profiles(""), std::vector<QosProfile>{}); }

TEST(QosProfile, IsRefusedWhenItMakesNoSense) {
  std::string wrong = kHumble;
  wrong.replace(wrong.find("durability: 1"), 13, "durability: 9");
  EXPECT_FALSE(parse_qos_profiles(wrong));
  wrong.replace(wrong.find("durability: 9"), 13, "durability: x");
  EXPECT_FALSE(parse_qos_profiles(wrong));
  EXPECT_FALSE(parse_qos_profiles("history: 1"));
  EXPECT_FALSE(parse_qos_profiles("- [unfinished"));
  EXPECT_FALSE(parse_qos_profiles("- depth: 1"));
}

TEST(ReplayQos, OffersWhatWasOffered) {
  EXPECT_EQ(replay_qos({}, 5).durability, interfaces::Durability::kVolatile);
  const auto latched = replay_qos({offered_profile(interfaces::qos::kLatched)}, 3);
  EXPECT_EQ(latched.durability, interfaces::Durability::kTransientLocal);
  EXPECT_EQ(latched.depth, interfaces::qos::kLatched.depth);
  EXPECT_TRUE(replay_qos({offered_profile(interfaces::qos::kHistory)}, 3).keep_all);
}

TEST(ReplayQos, KeepsAllLatchedMessagesOfManyPublishers) {
  QosProfile one_deep = offered_profile({.durability = interfaces::Durability::kTransientLocal, .depth = 1});
  EXPECT_EQ(replay_qos({one_deep, one_deep}, 42).depth, 42u);
}

TEST(ReplayQos, IsVolatileWhenOnePublisherWas) {
  EXPECT_EQ(replay_qos({offered_profile(interfaces::qos::kLatched), offered_profile(Qos{})}, 3).durability,
            interfaces::Durability::kVolatile);
}

}  // namespace
}  // namespace panvo::recorder
