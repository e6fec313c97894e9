// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "made_up_maps.hpp"

namespace panvo::fleet {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Optional;

/// Members as robot "me" knows them, and the map of another robot, "two".
class FleetMembers : public testing::Test {
 protected:
  Announcement announcement() const {
    return {"two",
            owner_.id(),
            owner_.session(),
            owner_.version(),
            owner_.digest(),
            static_cast<std::uint32_t>(owner_.places().size()),
            landmarks::to_text(settings_),
            0};
  }
  std::optional<std::string> announce() { return members_.hear(announcement(), now_); }
  std::optional<std::string> send(std::uint64_t from) {
    return members_.take("two", *owner_.since(from, 99, 99), now_);
  }
  const SharedMap& replica() const { return members_.find(7)->map; }

  const landmarks::DescriptionSettings settings_{{"patches", "400"}, {"seed", "1"}};
  MemberParameters parameters_;
  Members members_{parameters_, "me", settings_, {10, 2}};
  SharedMap owner_{7, 1, 100};
  std::int64_t now_ = 100 * kSecond;
};

TEST_F(FleetMembers, FollowTheMapOfAnother) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  EXPECT_EQ(announce(), std::nullopt);
  EXPECT_EQ(send(0), std::nullopt);
  EXPECT_EQ(replica().digest(), owner_.digest());
  now_ += kSecond;
  EXPECT_TRUE(members_.gaps(now_, 9).empty());
  EXPECT_THAT(members_.take_news(), Contains(HasSubstr("two joined the fleet")));
}

TEST_F(FleetMembers, AskForWhatTheyMissUntilTheyHaveIt) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  announce();
  EXPECT_TRUE(members_.gaps(now_, 9).empty()) << "it may be on its way";
  now_ += kSecond;
  announce();
  const auto gaps = members_.gaps(now_, 9);
  ASSERT_EQ(gaps.size(), 1U);
  EXPECT_EQ(gaps[0].map, 7U);
  EXPECT_EQ(gaps[0].from_version, 0U);
  EXPECT_TRUE(members_.gaps(now_ + kSecond, 9).empty()) << "asked a second ago";
  EXPECT_EQ(members_.gaps(now_ + 3 * kSecond, 9).size(), 1U) << "the answer was lost";
  now_ += 4 * kSecond;
  send(0);
  EXPECT_TRUE(members_.gaps(now_ + 9 * kSecond, 9).empty());
  EXPECT_THAT(members_.take_news(), Contains(HasSubstr("complete again after 2 requests")));
}

TEST_F(FleetMembers, ReceiveAMapAgainWhoseContentsDiffer) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  announce();
  send(0);
  auto said = announcement();
  said.digest ^= 1;
  for (int i = 0; i < 20; ++i) {
    now_ += 3 * kSecond;
    members_.hear(said, now_);
    if (!members_.gaps(now_ + kSecond, 9).empty()) send(0);
  }
  EXPECT_EQ(replica().places().size(), 1U) << "kept at last";
  EXPECT_THAT(members_.take_news(), Contains(HasSubstr("contradicts its digest again and again")));
}

TEST_F(FleetMembers, RefuseAnotherRobotOfTheOwnName) {
  auto said = announcement();
  said.robot = "me";
  EXPECT_THAT(members_.hear(said, now_), Optional(HasSubstr("another robot is also named me")));
  EXPECT_TRUE(members_.all().empty());
}

TEST_F(FleetMembers, RefuseTheSecondOfTwoRobotsOfOneName) {
  announce();
  auto twin = announcement();
  twin.map = 8;
  twin.session = 2;
  for (int i = 0; i < 5; ++i) {
    now_ += kSecond;
    announce();
    EXPECT_THAT(members_.hear(twin, now_), Optional(HasSubstr("two robots are named two")));
  }
  EXPECT_EQ(members_.all().size(), 1U);
}

TEST_F(FleetMembers, TakeARestartedRobotForANewMapAndKeepTheOldOne) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  announce();
  send(0);
  now_ += 4 * kSecond;
  auto restarted = announcement();
  restarted.map = 8;
  restarted.session = 2;
  EXPECT_EQ(members_.hear(restarted, now_), std::nullopt);
  EXPECT_EQ(members_.all().size(), 2U);
  EXPECT_FALSE(members_.find(7)->is_present);
  EXPECT_EQ(replica().places().size(), 1U);
  EXPECT_EQ(members_.present(), std::set<MapId>{8});
  EXPECT_THAT(members_.take_news(), Contains(HasSubstr("two was restarted with the new map 0000000000000008")));
}

TEST_F(FleetMembers, ReceiveAStoredMapAgainFromARestartedRobot) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  owner_.add(place_at(2, flat(9, 0, 0)));
  announce();
  send(0);
  now_ += 4 * kSecond;
  SharedMap after(7, 2, 100);
  after.add(place_at(1, flat(0.1, 0, 0)));
  members_.hear({"two", 7, 2, after.version(), after.digest(), 1, landmarks::to_text(settings_), 0}, now_);
  EXPECT_EQ(replica().places().size(), 0U);
  EXPECT_EQ(members_.take_restarted(), std::vector<MapId>{7});
  EXPECT_EQ(members_.take("two", *owner_.since(0, 9, 9), now_), std::nullopt) << "of the earlier session: dropped";
  EXPECT_EQ(replica().version(), 0U);
  members_.take("two", *after.since(0, 9, 9), now_);
  EXPECT_EQ(replica().digest(), after.digest());
}

TEST_F(FleetMembers, KeepAMapWhoseChangesOvertookItsAnnouncement) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  announce();
  send(0);
  now_ += kSecond;
  const auto repeated = announcement();
  owner_.add(place_at(2, flat(9, 0, 0)));
  const auto newer = announcement();
  owner_.add(place_at(3, flat(18, 0, 0)));
  send(1);
  for (const auto& delayed : {repeated, newer}) {
    EXPECT_EQ(members_.hear(delayed, now_), std::nullopt);
    EXPECT_EQ(replica().digest(), owner_.digest());
    EXPECT_EQ(members_.find(7)->last.version, delayed.version);
  }
  EXPECT_TRUE(members_.take_restarted().empty());
  now_ += kSecond;
  announce();
  EXPECT_TRUE(members_.gaps(now_ + kSecond, 9).empty());
}

TEST_F(FleetMembers, ReceiveAMapAgainThatIsAnnouncedInAnEarlierVersionThreeTimes) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  const auto earlier = announcement();
  owner_.add(place_at(2, flat(9, 0, 0)));
  announce();
  send(0);
  const auto say_earlier = [&] {
    now_ += kSecond;
    members_.hear(earlier, now_);
    return members_.take_restarted();
  };
  EXPECT_TRUE(say_earlier().empty());
  EXPECT_TRUE(say_earlier().empty());
  announce();
  EXPECT_TRUE(say_earlier().empty()) << "in a row";
  EXPECT_TRUE(say_earlier().empty());
  EXPECT_EQ(members_.find(7)->last.version, 2U) << "not the last one";
  EXPECT_EQ(say_earlier(), std::vector<MapId>{7});
  EXPECT_EQ(replica().version(), 0U);
  EXPECT_EQ(members_.gaps(now_ + kSecond, 9).size(), 1U);
  EXPECT_THAT(members_.take_news(), Contains(HasSubstr("went back to an earlier version")));
}

TEST_F(FleetMembers, SayWhoLeftAndWhoIsBack) {
  announce();
  members_.advance(now_ + 6 * kSecond);
  EXPECT_TRUE(members_.present().empty());
  now_ += 60 * kSecond;
  announce();
  EXPECT_EQ(members_.present().size(), 1U);
  const auto news = members_.take_news();
  EXPECT_THAT(news, Contains(HasSubstr("two has gone silent")));
  EXPECT_THAT(news, Contains("two is back"));
}

TEST_F(FleetMembers, NameOtherSettings) {
  auto said = announcement();
  said.settings = "patches=300\nseed=1\n";
  EXPECT_THAT(members_.hear(said, now_), Optional(HasSubstr("patches is 300 there, 400 here")));
}

TEST_F(FleetMembers, RefuseADescriptionThatDoesNotFit) {
  announce();
  auto place = place_at(1, flat(0, 0, 0));
  place.description.large[0].row = 10;  // of 10 rows
  owner_.add(place);
  EXPECT_THAT(send(0), Optional(HasSubstr("place 1 does not fit")));
  EXPECT_TRUE(replica().places().empty());
}

TEST_F(FleetMembers, ReportAPlaceThatItsOwnerMovedFar) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  announce();
  send(0);
  owner_.move({{1, flat(20, 0, 0), covariance_of(0.1, 0.01)}}, 0.05, 0.01);
  send(1);
  EXPECT_THAT(members_.take_news(), Contains("two moved its place 1 by 20.0 m"));
}

TEST_F(FleetMembers, StayBoundedAgainstTenThousandRobots) {
  int refused = 0;
  for (std::uint64_t i = 1; i <= 10'000; ++i) {
    auto said = announcement();
    said.robot = "robot" + std::to_string(i);
    said.map = 1000 + i;
    if (members_.hear(said, now_)) ++refused;
  }
  EXPECT_EQ(members_.all().size(), 64U);
  EXPECT_EQ(refused, 10'000 - 64);
  EXPECT_LE(members_.take_news().size(), 100U);
  members_.advance(now_ + 60 * kSecond);
  now_ += 60 * kSecond;
  EXPECT_EQ(announce(), std::nullopt) << "the absent ones make room";
  EXPECT_EQ(members_.all().size(), 64U);
}

TEST_F(FleetMembers, StayBoundedAgainstTooManyPlaces) {
  parameters_.max_places = 5;
  Members few(parameters_, "me", settings_, {10, 2});
  few.hear(announcement(), now_);
  for (std::uint32_t id = 1; id <= 6; ++id) owner_.add(place_at(id, flat(id, 0, 0)));
  EXPECT_THAT(few.take("two", *owner_.since(0, 99, 99), now_), Optional(HasSubstr("more than 5 places")));
  EXPECT_EQ(few.places(), 0U);
}

TEST_F(FleetMembers, StayBoundedAgainstTooManySightings) {
  announce();
  owner_.add(Sighting{kMaxSlots, 1, {9, 1}, flat(0, 0, 0), covariance_of(0.1, 0.1), 20, 0.0});
  EXPECT_THAT(send(0), Optional(HasSubstr("more than 2048 sightings")));
  EXPECT_TRUE(replica().sightings().empty());
}

TEST_F(FleetMembers, IgnoreChangesOfARobotThatHasNotAnnouncedItself) {
  owner_.add(place_at(1, flat(0, 0, 0)));
  EXPECT_EQ(send(0), std::nullopt);
  EXPECT_TRUE(members_.all().empty());
}

TEST_F(FleetMembers, RefuseTheMapOfAnother) {
  announce();
  auto thief = announcement();
  thief.robot = "three";
  EXPECT_THAT(members_.hear(thief, now_), Optional(HasSubstr("three announces the map of two")));
}

}  // namespace
}  // namespace panvo::fleet
