// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/fleet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <random>

#include "painted_road.hpp"

namespace panvo::fleet {
namespace {

using testing::HasSubstr;
using testing::Optional;

constexpr int kPlaces = 6;

class Keypoints final : public landmarks::LandmarkSource {
 public:
  std::vector<landmarks::Keypoint> keypoints(std::uint32_t id) const override { return by_id.at(id); }
  landmarks::PanoramaDescription description(std::uint32_t) const override { return {}; }
  std::map<std::uint32_t, std::vector<landmarks::Keypoint>> by_id;
};

const landmarks::PanoramaDescriber& describer() {
  static const landmarks::PanoramaDescriber one({}, 1);
  return one;
}
const PaintedRoad& road() {
  static const PaintedRoad one(kPlaces);
  return one;
}

/// A robot that drives along the road; its clock is `clock_ns` ahead.
struct Robot {
  Robot(const std::string& name, const Eigen::Isometry3d& its_map_from_world, std::int64_t its_clock_ns = 0,
        const FleetParameters& parameters = {})
      : map_from_world(its_map_from_world),
        clock_ns(its_clock_ns),
        fleet(parameters, name, {}, describer(), {{"patches", "400"}}, keypoints) {}

  /// Drives to a place; `builds`: a landmark there.
  void drive_to(int place, bool builds) {
    clock_ns += kSecond;
    const Eigen::Isometry3d pose = map_from_world * PaintedRoad::world_from_base(place);
    fleet.add_pose(clock_ns, pose, covariance_of(0.02, 0.001), 10.0);
    if (builds) {
      auto landmark = road().landmark(place, next_id, map_from_world, describer());
      landmark.stamp_ns = clock_ns;
      keypoints->by_id[next_id++] = landmark.keypoints;
      fleet.add_place(std::move(landmark));
    }
    fleet.add_panorama(clock_ns, road().panorama(place), PaintedRoad::base_from_panorama());
  }

  Eigen::Isometry3d map_from_world;
  std::int64_t clock_ns;
  std::uint32_t next_id = 1;
  std::shared_ptr<Keypoints> keypoints = std::make_shared<Keypoints>();
  Fleet fleet;
};

/// Carries the messages of robots to all others.
class Network {
 public:
  /// `arrives`: whether a message from one robot arrives at another.
  explicit Network(std::vector<Robot*> robots, std::function<bool(const std::string&, const std::string&)> arrives = {})
      : robots_(std::move(robots)), arrives_(std::move(arrives)) {}

  void run(int seconds) {
    for (int tick = 0; tick < 5 * seconds; ++tick) {
      now_ns_ += kSecond / 5;
      for (auto* robot : robots_) robot->fleet.advance(now_ns_);
      for (auto* robot : robots_) {
        while (const auto message = robot->fleet.next(now_ns_)) carry(*robot, *message);
      }
    }
  }
  std::int64_t now_ns() const { return now_ns_; }
  std::map<std::string, int> messages;

 private:
  void carry(Robot& sender, const FleetMessage& message) {
    const auto& name = sender.fleet.robot();
    ++messages[name];
    sender.fleet.sent(1000);
    for (auto* robot : robots_) {
      if (arrives_ && robot != &sender && !arrives_(name, robot->fleet.robot())) continue;
      std::visit([&](const auto& content) { deliver(robot->fleet, name, content); }, message);
    }
  }
  void deliver(Fleet& fleet, const std::string& from, const Announcement& said) {
    note(fleet.hear(said, now_ns_), from);
  }
  void deliver(Fleet& fleet, const std::string& from, const MapChanges& changes) {
    note(fleet.take(from, changes, now_ns_), from);
  }
  void deliver(Fleet& fleet, const std::string& from, const Request& request) {
    note(fleet.answer(from, request, now_ns_), from);
  }
  void deliver(Fleet& fleet, const std::string& from, const KeypointAnswer& answer) {
    note(fleet.take(from, answer), from);
  }
  static void note(const std::optional<std::string>& refused, const std::string& from) {
    EXPECT_EQ(refused, std::nullopt) << from;
  }

  std::vector<Robot*> robots_;
  std::function<bool(const std::string&, const std::string&)> arrives_;
  std::int64_t now_ns_ = 50 * kSecond;
};

double frame_error(const Robot& robot, const Robot& owner) {
  return vision::pose_error(robot.fleet.common_from_own(), owner.map_from_world * robot.map_from_world.inverse())
      .norm();
}

TEST(Fleet, RecognisesThePlacesOfAnotherAndSharesAFrame) {
  // their clocks differ by an hour
  Robot one("one", flat(3, 2, 0.5)), two("two", flat(-20, 9, -1.0), 3600 * kSecond);
  Network network({&one, &two});
  for (int place = 0; place < kPlaces; ++place) one.drive_to(place, true);
  network.run(3);
  for (int place = 0; place < kPlaces; ++place) {
    two.drive_to(place, true);
    network.run(1);
  }
  network.run(2);
  ASSERT_NE(one.fleet.own(), nullptr);
  const auto root = std::min(one.fleet.own()->id(), two.fleet.own()->id());
  EXPECT_EQ(one.fleet.frame().map, root);
  EXPECT_EQ(two.fleet.frame().map, root);
  const auto& owner = root == one.fleet.own()->id() ? one : two;
  EXPECT_LT(frame_error(one, owner), 0.05);
  EXPECT_LT(frame_error(two, owner), 0.05);
  EXPECT_EQ(one.fleet.evidence().made(), 1);
  EXPECT_GE(two.fleet.counts().recognised, 3U);
  EXPECT_EQ(two.fleet.counts().verified, two.fleet.counts().recognised) << "other places do not pass the levels";
}

TEST(Fleet, JoinsThirdMapsThroughOthers) {
  Robot one("one", flat(0, 0, 0)), two("two", flat(5, 5, 1)), three("three", flat(-5, 3, 2));
  Network network({&one, &two, &three});
  for (int place = 0; place < 3; ++place) one.drive_to(place, true);
  network.run(2);
  for (int place = 0; place < kPlaces; ++place) {
    two.drive_to(place, true);
    network.run(1);
  }
  for (int place = 3; place < kPlaces; ++place) {  // places of two, which one never saw
    three.drive_to(place, true);
    network.run(1);
  }
  network.run(2);
  const auto root = std::min({one.fleet.own()->id(), two.fleet.own()->id(), three.fleet.own()->id()});
  for (const auto* robot : {&one, &two, &three}) {
    EXPECT_EQ(robot->fleet.frame().map, root) << robot->fleet.robot();
    EXPECT_EQ(robot->fleet.frame().own_from.size(), 2U) << robot->fleet.robot();
    for (const auto* owner : {&one, &two, &three}) {
      if (owner->fleet.own()->id() != root) continue;
      EXPECT_LT(frame_error(*robot, *owner), 0.1) << robot->fleet.robot();
    }
  }
}

TEST(Fleet, CatchesUpAfterAPartition) {
  Robot one("one", flat(0, 0, 0)), two("two", flat(5, 5, 1));
  bool is_parted = true;
  Network network({&one, &two}, [&](const auto&, const auto&) { return !is_parted; });
  for (int place = 0; place < kPlaces; ++place) one.drive_to(place, true);
  two.drive_to(0, true);
  network.run(5);
  EXPECT_TRUE(two.fleet.members().all().empty());
  is_parted = false;
  network.run(6);
  const auto* member = two.fleet.members().find(one.fleet.own()->id());
  ASSERT_NE(member, nullptr);
  EXPECT_EQ(member->map.digest(), one.fleet.own()->digest());
  is_parted = true;
  one.drive_to(2, false);
  one.fleet.move_places({{1, flat(0.5, 0, 0), covariance_of(0.02, 0.001)}});
  network.run(10);
  EXPECT_FALSE(member->is_present);
  is_parted = false;
  network.run(6);
  EXPECT_TRUE(member->is_present);
  EXPECT_EQ(member->map.digest(), one.fleet.own()->digest());
}

TEST(Fleet, SurvivesALossOfHalfOfAllMessages) {
  Robot one("one", flat(0, 0, 0)), two("two", flat(5, 5, 1));
  std::mt19937 random(8);
  Network network({&one, &two}, [&](const auto&, const auto&) { return random() % 2 == 0; });
  for (int place = 0; place < kPlaces; ++place) one.drive_to(place, true);
  network.run(20);
  for (int place = 0; place < kPlaces; ++place) {
    two.drive_to(place, true);
    network.run(2);
  }
  network.run(40);
  EXPECT_EQ(two.fleet.members().find(one.fleet.own()->id())->map.digest(), one.fleet.own()->digest());
  EXPECT_EQ(one.fleet.members().find(two.fleet.own()->id())->map.digest(), two.fleet.own()->digest());
  EXPECT_EQ(one.fleet.frame().map, two.fleet.frame().map);
  EXPECT_EQ(one.fleet.frame().own_from.size(), 1U);
}

TEST(Fleet, SendsNoMoreThanItsRate) {
  FleetParameters slow;
  slow.sharing.max_kb_per_s = 1.0;
  slow.sharing.burst_s = 1.0;
  Robot one("one", flat(0, 0, 0), 0, slow);
  for (int place = 0; place < kPlaces; ++place) one.drive_to(place, true);
  std::int64_t now_ns = kSecond;
  std::size_t bytes = 0;
  for (int tick = 0; tick < 500; ++tick, now_ns += kSecond / 10) {
    one.fleet.advance(now_ns);
    one.fleet.answer("two", {one.fleet.own()->id(), std::nullopt, {1, 2, 3, 4, 5, 6}}, now_ns);
    while (const auto message = one.fleet.next(now_ns)) {
      const std::size_t size = std::holds_alternative<Announcement>(*message) ? 100 : 30'000;
      bytes += size;
      one.fleet.sent(size);
    }
  }
  // what was begun before the rate was used up, 50 s at the rate, and the announcements
  EXPECT_LE(bytes, 1000U + 30'000U + 50'000U + 51U * 100U);
  EXPECT_GE(bytes, 50'000U) << "there was always something to send";
}

TEST(Fleet, AnswersOneRepetitionASecondToARobot) {
  Robot one("one", flat(0, 0, 0));
  one.drive_to(0, true);
  one.drive_to(1, true);
  std::int64_t now_ns = kSecond;
  while (one.fleet.next(now_ns)) {
  }
  const Request again{one.fleet.own()->id(), 0, {}};
  EXPECT_EQ(one.fleet.answer("two", again, now_ns), std::nullopt);
  EXPECT_TRUE(one.fleet.next(now_ns));
  EXPECT_THAT(one.fleet.answer("two", again, now_ns), Optional(HasSubstr("two asks for repetitions more than once")));
  EXPECT_EQ(one.fleet.answer("two", again, now_ns + 2 * kSecond), std::nullopt);
}

TEST(Fleet, RefusesKeypointsOfPlacesThatDoNotExistOrAreOfOthers) {
  Robot one("one", flat(0, 0, 0)), two("two", flat(0, 0, 0));
  one.drive_to(0, true);
  two.drive_to(0, true);
  Network({&one, &two}).run(3);
  EXPECT_THAT(one.fleet.answer("two", {one.fleet.own()->id(), std::nullopt, {77}}, kSecond),
              Optional(HasSubstr("place 77, which does not exist")));
  EXPECT_THAT(one.fleet.take("three", KeypointAnswer{two.fleet.own()->id(), 1, {}}),
              Optional(HasSubstr("three sends keypoints of a map of two")));
}

TEST(Fleet, IsSilentWithoutAMap) {
  Robot one("one", flat(0, 0, 0));
  one.fleet.advance(kSecond);
  EXPECT_FALSE(one.fleet.next(kSecond));
  EXPECT_EQ(one.fleet.frame().map, 0U);
}

TEST(Fleet, DoesNotTakeItselfForAnother) {
  Robot one("one", flat(0, 0, 0));
  one.drive_to(0, true);
  Network({&one}).run(3);
  EXPECT_TRUE(one.fleet.members().all().empty());
}

}  // namespace
}  // namespace panvo::fleet
