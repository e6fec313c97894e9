// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"
#include "place_scene.hpp"

namespace panvo::markers {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using visualization_msgs::msg::Marker;
namespace outcomes = panvo_msgs::msg::CorrectionOutcome_Constants;

Eigen::Isometry3d pose_at(double x_m, double y_m, double yaw_rad) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  pose.translation() << x_m, y_m, 0.0;
  return pose;
}

/// Plays messages, so that time passes.
class Player final : public runtime::Component, public runtime::Source {
 public:
  explicit Player(runtime::Context& context)
      : landmarks_(context.output(topics::kLandmarks)),
        poses_(context.output(topics::kLandmarkPoses)),
        outcomes_(context.output(topics::kCorrectionOutcome)) {
    context.source(*this);
  }

  void landmark(double t_s, std::uint32_t id, const Eigen::Isometry3d& pose, bool is_junction = false) {
    auto landmark = stamped<panvo_msgs::msg::PanoramicLandmark>(t_s);
    landmark.id(id);
    landmark.pose().pose(conversions::to_pose(pose));
    landmark.is_junction(is_junction);
    landmark.settings("histogram_bins=2");
    landmark.histogram({0.5F, 0.5F});
    at(t_s, [this, landmark] { landmarks_.publish(landmark); });
  }

  void move(double t_s, std::uint32_t id, const Eigen::Isometry3d& pose) {
    auto poses = stamped<panvo_msgs::msg::LandmarkPoses>(t_s);
    poses.ids().push_back(id);
    poses.poses().emplace_back().pose(conversions::to_pose(pose));
    at(t_s, [this, poses] { poses_.publish(poses); });
  }

  void outcome(double t_s, std::uint32_t id, std::uint8_t outcome, const Eigen::Isometry3d& after) {
    auto message = stamped<panvo_msgs::msg::CorrectionOutcome>(t_s);
    message.landmark_id(id);
    message.outcome(outcome);
    message.after(conversions::to_pose(after));
    at(t_s, [this, message] { outcomes_.publish(message); });
  }

  void pause_until(double t_s) {
    at(t_s, [] {});
  }

  std::optional<std::int64_t> next_stamp_ns() override {
    return played_ < events_.size() ? std::optional(events_[played_].first) : std::nullopt;
  }
  void emit() override { events_[played_++].second(); }
  Progress progress() const override { return {played_, events_.size()}; }

 private:
  static std::int64_t stamp_ns(double t_s) { return 1'700'000'000'000'000'000 + std::llround(t_s * 1e9); }

  template <class Message>
  static Message stamped(double t_s) {
    Message message;
    message.header().stamp(conversions::to_stamp(stamp_ns(t_s)));
    message.header().frame_id("map");
    return message;
  }

  void at(double t_s, std::function<void()> publish) { events_.emplace_back(stamp_ns(t_s), std::move(publish)); }

  runtime::Output<panvo_msgs::msg::PanoramicLandmark> landmarks_;
  runtime::Output<panvo_msgs::msg::LandmarkPoses> poses_;
  runtime::Output<panvo_msgs::msg::CorrectionOutcome> outcomes_;
  std::vector<std::pair<std::int64_t, std::function<void()>>> events_;
  std::size_t played_ = 0;
};

class MarkersComponent : public ::testing::Test {
 protected:
  void SetUp() override {
    runtime::ComponentDescription player;
    player.name = "player";
    player.name_space = "/";
    harness_.container().add(player, [this](runtime::Context& context) {
      auto made = std::make_unique<Player>(context);
      player_ = made.get();
      return made;
    });
  }

  void play(const std::map<std::string, std::string>& parameters = {}) {
    harness_.load("panvo_markers", "MarkersComponent", parameters);
    ASSERT_THAT(harness_.container().run(), IsEmpty());
    ASSERT_THAT(scenes_, testing::Not(IsEmpty()));
  }

  /// The last message's marker of a namespace.
  const Marker& marker(const std::string& name_space) const {
    const auto& markers = scenes_.back()->markers();
    return *std::ranges::find_if(markers, [&](const Marker& one) { return one.ns() == name_space; });
  }

  static std::vector<double> coordinates(const std::vector<geometry_msgs::msg::Point>& points) {
    std::vector<double> all;
    for (const auto& point : points) all.insert(all.end(), {point.x(), point.y()});
    return all;
  }

  runtime::ComponentHarness harness_;
  Player* player_ = nullptr;
  const std::vector<std::shared_ptr<const visualization_msgs::msg::MarkerArray>>& scenes_ =
      harness_.collect(kPlaceMarkers);
};

TEST_F(MarkersComponent, ShowsPlacesWhereTheyAreNow) {
  player_->landmark(0.0, 7, pose_at(1.0, 2.0, 0.0));
  player_->landmark(0.1, 9, pose_at(5.0, 2.0, M_PI / 2.0), true);
  player_->move(0.2, 7, pose_at(1.5, 2.5, 0.0));
  player_->landmark(0.3, 7, pose_at(1.0, 2.0, 0.0));  // late, or again
  player_->pause_until(2.0);
  play();
  const Marker& places = marker("places");
  EXPECT_EQ(places.header().frame_id(), "map");
  EXPECT_EQ(places.scale().x(), 1.5);
  EXPECT_THAT(coordinates(places.points()), ElementsAre(1.5, 2.5, 5.0, 2.0));
  ASSERT_THAT(places.colors(), SizeIs(2));
  EXPECT_GT(places.colors()[0].g(), places.colors()[0].r()) << "of this journey: green";
  EXPECT_EQ(places.colors()[1].g(), places.colors()[1].r()) << "of the map: grey";
  const auto headings = coordinates(marker("headings").points());
  EXPECT_THAT((std::vector(headings.begin(), headings.begin() + 4)), ElementsAre(1.5, 2.5, 4.5, 2.5));
  EXPECT_NEAR(headings[7], 8.0, 1e-9) << "6 m to the north of the junction";
  EXPECT_EQ(marker("ids").text(), "7");
}

TEST_F(MarkersComponent, PutsNumbersBesidePlaces) {
  player_->landmark(0.0, 7, pose_at(1.0, 2.0, M_PI / 2.0));
  player_->pause_until(2.0);
  play();
  const Marker& number = marker("ids");
  const double sphere_radius_m = marker("places").scale().x() / 2.0;
  EXPECT_LT(number.pose().position().x(), 1.0 - sphere_radius_m - number.scale().z() / 2.0)
      << "readable from above: to the left, off the sphere";
  EXPECT_NEAR(number.pose().position().y(), 2.0, 1e-9) << "off the path, too";
}

TEST_F(MarkersComponent, ShowsFromWhereAPlaceWasSeen) {
  player_->landmark(0.0, 1, pose_at(0.0, 0.0, 0.0));
  player_->outcome(0.1, 1, outcomes::APPLIED, pose_at(9.0, 9.0, 0.0));
  player_->outcome(0.2, 1, outcomes::REJECTED, pose_at(2.0, 0.0, 0.0));
  player_->outcome(0.3, 1, outcomes::APPLIED, pose_at(3.0, 0.0, 0.0));
  player_->outcome(0.4, 99, outcomes::APPLIED, pose_at(4.0, 0.0, 0.0));  // of no known place
  player_->pause_until(2.0);
  play({{"ids", "false"}, {"max_sightings", "3"}});
  EXPECT_THAT(scenes_.back()->markers(), SizeIs(3));
  const Marker& lines = marker("sightings");
  EXPECT_THAT(coordinates(lines.points()), ElementsAre(2.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0)) << "of the last three";
  ASSERT_THAT(lines.colors(), SizeIs(4));
  EXPECT_GT(lines.colors()[0].r(), lines.colors()[0].g()) << "rejected: orange";
  EXPECT_GT(lines.colors()[2].g(), lines.colors()[2].r()) << "applied: green";
}

TEST_F(MarkersComponent, IsSilentWithoutChange) {
  player_->landmark(0.0, 1, pose_at(0.0, 0.0, 0.0));
  player_->pause_until(5.0);
  player_->landmark(5.1, 2, pose_at(9.0, 0.0, 0.0));
  player_->pause_until(10.0);
  play();
  ASSERT_THAT(scenes_, SizeIs(2));
  EXPECT_THAT(scenes_[0]->markers(), SizeIs(4)) << "spheres, headings, sightings, one number";
  EXPECT_EQ(marker("sightings").action(), visualization_msgs::msg::Marker_Constants::DELETE) << "there are none";
  EXPECT_THAT(scenes_[1]->markers(), SizeIs(5));
}

}  // namespace
}  // namespace panvo::markers
