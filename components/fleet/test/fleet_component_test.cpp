// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "painted_road.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/fleet_topics.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::fleet {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kPlaces = 5;
constexpr double kBegin_s = 1'700'000'000.0;

std::int64_t stamp_ns(double t_s) { return std::llround(1e9 * (kBegin_s + t_s)); }

struct Names {
  explicit Names(const std::string& robot)
      : landmarks("/" + robot + "/landmarks"),
        odometry("/" + robot + "/odometry/enhanced"),
        panorama("/" + robot + "/panorama/image"),
        fleet("/" + robot + "/odometry/fleet"),
        state("/" + robot + "/fleet/state") {}
  std::string landmarks, odometry, panorama, fleet, state;
};

/// Plays what the other components of several robots publish.
class Drives final : public runtime::Component, public runtime::Source {
 public:
  explicit Drives(runtime::Context& context) : context_(context), tf_(context.output(topics::kTfStatic)) {
    context.source(*this);
    at(0.0, [this] {
      tf2_msgs::msg::TFMessage message;
      auto& transform = message.transforms().emplace_back();
      transform.header().frame_id("base_link");
      transform.child_frame_id("panorama");
      transform.transform(conversions::to_transform(PaintedRoad::base_from_panorama()));
      tf_.publish(message);
    });
  }

  /// One place a second, from `begin_s` on; `clock_s`: offset of the robot's clock; backwards: from the last place on.
  void drive(const std::string& robot, const Eigen::Isometry3d& map_from_world, double begin_s, double clock_s = 0.0,
             bool is_backwards = false) {
    static const PaintedRoad road(kPlaces);
    static const landmarks::PanoramaDescriber describer({}, 1);
    auto& names = names_.try_emplace(robot, robot).first->second;
    auto landmarks = context_.output(interfaces::Topic<panvo_msgs::msg::PanoramicLandmark>{names.landmarks});
    auto odometry = context_.output(interfaces::Topic<nav_msgs::msg::Odometry>{names.odometry});
    auto panoramas = context_.output(interfaces::Topic<sensor_msgs::msg::Image>{names.panorama});
    for (int i = 0; i < kPlaces; ++i) {
      const double t_s = begin_s + i;
      const int place = is_backwards ? kPlaces - 1 - i : i;
      auto landmark = road.landmark(place, static_cast<std::uint32_t>(i) + 1, map_from_world, describer);
      landmark.stamp_ns = stamp_ns(t_s + clock_s);
      const auto landmark_message = landmarks::to_message(landmark, landmarks::landmark_settings({}, {}, 1), "map");
      auto image = conversions::make_image(landmark.stamp_ns, "panorama", "mono8", 1080, 540);
      road.panorama(place).copyTo(conversions::pixels(*image));
      nav_msgs::msg::Odometry pose;
      pose.header().stamp(conversions::to_stamp(landmark.stamp_ns));
      pose.header().frame_id("map");
      pose.child_frame_id("base_link");
      pose.pose().pose(conversions::to_pose(landmark.map_from_base));
      pose.pose().covariance(conversions::to_array(landmark.covariance));
      pose.twist().twist().linear().x(10.0);
      at(t_s, [=]() mutable {
        landmarks.publish(landmark_message);
        panoramas.publish(*image);  // before its pose
        odometry.publish(pose);
      });
    }
  }
  /// Landmarks that look like the first place, with ids from `first_id` on.
  void repeat_landmark(const std::string& robot, std::uint32_t first_id, int count, double t_s) {
    static const PaintedRoad road(kPlaces);
    static const landmarks::PanoramaDescriber describer({}, 1);
    auto output = context_.output(interfaces::Topic<panvo_msgs::msg::PanoramicLandmark>{"/" + robot + "/landmarks"});
    auto landmark = road.landmark(0, first_id, flat(500, 0, 0), describer);
    landmark.stamp_ns = stamp_ns(t_s);
    auto message = landmarks::to_message(landmark, landmarks::landmark_settings({}, {}, 1), "map");
    at(t_s, [=]() mutable {
      for (int i = 0; i < count; ++i, message.id(message.id() + 1)) output.publish(message);
    });
  }
  /// The localizer of a robot has the first places there.
  void say_poses(const std::string& robot, const Eigen::Isometry3d& map_from_world, double t_s, int places = 1) {
    auto output = context_.output(interfaces::Topic<panvo_msgs::msg::LandmarkPoses>{"/" + robot + "/landmarks/poses"});
    panvo_msgs::msg::LandmarkPoses message;
    for (int place = 0; place < places; ++place) {
      message.ids().push_back(static_cast<std::uint32_t>(place) + 1);
      auto& pose = message.poses().emplace_back();
      pose.pose(conversions::to_pose(map_from_world * PaintedRoad::world_from_base(place)));
      pose.covariance(conversions::to_array(covariance_of(0.02, 0.001)));
    }
    at(t_s, [=]() mutable { output.publish(message); });
  }
  void at(double t_s, std::function<void()> event) { events_.emplace(stamp_ns(t_s), std::move(event)); }
  /// Time passes; timers run.
  void pause(double from_s, double until_s) {
    for (double t_s = from_s; t_s < until_s; t_s += 0.2) at(t_s, [] {});
  }

  std::optional<std::int64_t> next_stamp_ns() override {
    return events_.empty() ? std::nullopt : std::optional(events_.begin()->first);
  }
  void emit() override {
    const auto event = events_.extract(events_.begin());
    event.mapped()();
  }
  Progress progress() const override { return {}; }

 private:
  runtime::Context& context_;
  runtime::Output<tf2_msgs::msg::TFMessage> tf_;
  std::map<std::string, Names> names_;
  std::multimap<std::int64_t, std::function<void()>> events_;
};

class FleetOfComponents : public testing::Test {
 protected:
  void SetUp() override {
    runtime::ComponentDescription description;
    description.name = "drives";
    description.name_space = "/";
    harness_.container().add(description, [this](runtime::Context& context) {
      auto made = std::make_unique<Drives>(context);
      drives_ = made.get();
      return made;
    });
  }

  void load(const std::string& name_space, const std::string& robot) {
    runtime::ComponentDescription description;
    description.package = "panvo_fleet";
    description.plugin = "FleetComponent";
    description.name = "fleet_" + name_space;
    description.name_space = "/" + name_space;
    description.parameters["robot"] = {.items = {robot}, .is_list = false, .where = {"test", 0}};
    harness_.container().load(description);
  }

  runtime::ComponentHarness harness_;
  Drives* drives_ = nullptr;
};

TEST_F(FleetOfComponents, SharesOneFrameAmongThreeRobots) {
  const std::map<std::string, Eigen::Isometry3d> maps{
      {"one", flat(0, 0, 0)}, {"two", flat(9, 4, 1)}, {"three", flat(-7, 1, -2)}};
  for (const auto& [robot, map_from_world] : maps) load(robot, robot);
  drives_->pause(0.0, 20.0);
  drives_->drive("one", maps.at("one"), 1.0);
  drives_->drive("two", maps.at("two"), 7.0, 3600.0);  // its clock is an hour ahead
  drives_->drive("three", maps.at("three"), 13.0);
  std::map<std::string, const std::vector<std::shared_ptr<const nav_msgs::msg::Odometry>>*> poses;
  std::map<std::string, const std::vector<std::shared_ptr<const panvo_msgs::msg::FleetState>>*> states;
  for (const auto& [robot, map_from_world] : maps) {
    static std::map<std::string, Names> names;
    const auto& own = names.try_emplace(robot, robot).first->second;
    poses[robot] = &harness_.collect(interfaces::Topic<nav_msgs::msg::Odometry>{own.fleet});
    states[robot] = &harness_.collect(interfaces::Topic<panvo_msgs::msg::FleetState>{own.state});
  }
  ASSERT_THAT(harness_.container().run(), IsEmpty());

  const auto& last = *states["three"]->back();
  ASSERT_EQ(last.peers().size(), 2U);
  for (const auto& [robot, map_from_world] : maps) {
    const auto& state = *states[robot]->back();
    EXPECT_EQ(state.common_map(), last.common_map()) << robot;
    for (const auto& peer : state.peers()) {
      EXPECT_TRUE(peer.joined()) << robot << " with " << peer.robot() << ": " << peer.reason();
      EXPECT_EQ(peer.places(), static_cast<std::uint32_t>(kPlaces)) << robot;
    }
    EXPECT_EQ(state.refused(), 0U) << state.last_refusal();
    EXPECT_GT(state.bytes_sent(), 30'000U);
  }
  // all three end at the same place: their last poses in the frame of all are equal once all are joined
  const auto final_of = [&](const std::string& robot) {
    const auto common = conversions::to_isometry(states[robot]->back()->common_from_map().pose());
    return *common * maps.at(robot) * PaintedRoad::world_from_base(kPlaces - 1);
  };
  EXPECT_LT(vision::pose_error(final_of("one"), final_of("two")).norm(), 0.1);
  EXPECT_LT(vision::pose_error(final_of("one"), final_of("three")).norm(), 0.1);
  const auto published = conversions::to_isometry(poses["three"]->back()->pose().pose());
  ASSERT_TRUE(published);
  EXPECT_LT(vision::pose_error(*published, final_of("three")).norm(), 0.3) << "joined while it drove";
  EXPECT_EQ(poses["three"]->back()->header().frame_id(), "fleet");
}

TEST(FleetComponent, NeedsANameOfTheRobot) {
  runtime::ComponentHarness harness;
  try {
    harness.load("panvo_fleet", "FleetComponent", {});
    ADD_FAILURE() << "a robot without a name";
  } catch (const runtime::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("robot is empty: give each robot a name of its own, robot:=NAME"));
  }
}

TEST_F(FleetOfComponents, NamesTwoRobotsOfOneName) {
  load("a", "same");
  load("b", "same");
  drives_->pause(0.0, 12.0);
  drives_->drive("a", flat(0, 0, 0), 1.0);
  drives_->drive("b", flat(0, 0, 0), 6.5);
  ASSERT_THAT(harness_.container().run(), IsEmpty());
  EXPECT_TRUE(harness_.log_contains("another robot is also named same: give each a name of its own"));
}

TEST_F(FleetOfComponents, KeepsQuietAboutAPoseThatIsNotKnownInItsMap) {
  load("one", "one");
  drives_->pause(0.0, 8.0);
  drives_->drive("one", flat(0, 0, 0), 1.0);
  panvo_msgs::msg::LocalizationState state;
  state.state(panvo_msgs::msg::LocalizationState_Constants::UNLOCATED);
  harness_.publish(interfaces::Topic<panvo_msgs::msg::LocalizationState>{"/one/localization/state"}, state);
  const auto& poses = harness_.collect(interfaces::Topic<nav_msgs::msg::Odometry>{"/one/odometry/fleet"});
  ASSERT_THAT(harness_.container().run(), IsEmpty());
  EXPECT_TRUE(poses.empty());
}

TEST_F(FleetOfComponents, SharesNoLandmarkOfWhichAnotherHasTheId) {
  load("one", "one");
  drives_->pause(0.0, 20.0);
  drives_->drive("one", flat(0, 0, 0), 1.0);
  drives_->drive("one", flat(500, 0, 0), 10.0);               // of a builder that was restarted and counts from 1 again
  drives_->say_poses("one", flat(0.1, 0, 0), 10.5, kPlaces);  // the localizer was not
  ASSERT_THAT(harness_.container().run(), IsEmpty());
  EXPECT_TRUE(harness_.log_contains("landmark 1: its id is that of another one; not shared"));
  EXPECT_FALSE(harness_.log_contains("has started a new map"));
}

/// All components of a robot but this one are restarted and count places from 1 again, in another map.
TEST_F(FleetOfComponents, SharesTheMapThatItsRobotHasBegunAnew) {
  load("one", "one");
  load("two", "two");
  const auto first = flat(0, 0, 0), second = flat(500, 0, 0), map_of_two = flat(9, 4, 1);
  drives_->pause(0.0, 30.0);
  drives_->drive("one", first, 1.0, 0.0, true);
  drives_->drive("one", second, 10.0);
  for (int place = 0; place < kPlaces; ++place) drives_->say_poses("one", second, 10.1 + place, place + 1);
  drives_->drive("two", map_of_two, 18.0);
  const auto& of_one = harness_.collect(interfaces::Topic<panvo_msgs::msg::FleetState>{"/one/fleet/state"});
  const auto& of_two = harness_.collect(interfaces::Topic<panvo_msgs::msg::FleetState>{"/two/fleet/state"});
  ASSERT_THAT(harness_.container().run(), IsEmpty());

  const auto& peers = of_two.back()->peers();
  const auto one = std::find_if(peers.begin(), peers.end(),
                                [&](const auto& peer) { return peer.map_id() == of_one.back()->map_id(); });
  ASSERT_NE(one, peers.end());
  EXPECT_EQ(one->places(), static_cast<std::uint32_t>(kPlaces));
  ASSERT_TRUE(one->joined()) << one->reason();
  const auto two_from_one = conversions::to_isometry(one->map_from_peer().pose());
  ASSERT_TRUE(two_from_one);
  EXPECT_LT(vision::pose_error(*two_from_one * second, map_of_two).norm(), 0.1);
}

/// More than a hundred landmarks before the localizer says that they are of another map.
TEST_F(FleetOfComponents, SaysHowManyLandmarksOfANewMapItLost) {
  load("one", "one");
  drives_->pause(0.0, 30.0);
  drives_->drive("one", flat(0, 0, 0), 1.0);
  drives_->drive("one", flat(500, 0, 0), 10.0);
  drives_->repeat_landmark("one", 1000, 97, 15.0);
  drives_->say_poses("one", flat(500, 0, 0), 16.0);
  ASSERT_THAT(harness_.container().run(), IsEmpty());
  EXPECT_TRUE(harness_.log_contains("has started a new map"));
  EXPECT_TRUE(harness_.log_contains("2 of its landmarks are not shared: more than 100 came before"));
}

TEST_F(FleetOfComponents, SurvivesAnInvalidMessage) {
  load("one", "one");
  drives_->pause(0.0, 8.0);
  drives_->drive("one", flat(0, 0, 0), 1.0);
  panvo_msgs::msg::FleetMember other;
  other.robot("other");
  other.map_id(5);
  other.settings("patches=300\n");
  harness_.publish(topics::kFleetMembers, other);
  const auto& states = harness_.collect(interfaces::Topic<panvo_msgs::msg::FleetState>{"/one/fleet/state"});
  ASSERT_THAT(harness_.container().run(), IsEmpty());
  EXPECT_EQ(states.back()->refused(), 1U);
  EXPECT_THAT(states.back()->last_refusal(), HasSubstr("other describes places with other settings"));
  EXPECT_TRUE(states.back()->peers().empty());
}

}  // namespace
}  // namespace panvo::fleet
