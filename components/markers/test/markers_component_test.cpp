// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

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

class MarkersComponent : public ::testing::Test {
 protected:
  void load(const std::map<std::string, std::string>& parameters = {}) {
    harness_.load("panvo_markers", "MarkersComponent", parameters);
  }

  template <class Message>
  Message stamped(double t_s) {
    Message message;
    message.header().stamp(conversions::to_stamp(kBegin_ns + std::llround(t_s * 1e9)));
    message.header().frame_id("map");
    return message;
  }

  void publish_landmark(double t_s, std::uint32_t id, const Eigen::Isometry3d& pose, bool is_junction = false) {
    auto landmark = stamped<panvo_msgs::msg::PanoramicLandmark>(t_s);
    landmark.id(id);
    landmark.pose().pose(conversions::to_pose(pose));
    landmark.is_junction(is_junction);
    harness_.publish(topics::kLandmarks, landmark);
  }

  void publish_poses(double t_s, const std::map<std::uint32_t, Eigen::Isometry3d>& poses) {
    auto message = stamped<panvo_msgs::msg::LandmarkPoses>(t_s);
    for (const auto& [id, pose] : poses) {
      message.ids().push_back(id);
      message.poses().emplace_back().pose(conversions::to_pose(pose));
    }
    harness_.publish(topics::kLandmarkPoses, message);
  }

  void publish_outcome(double t_s, std::uint32_t id, std::uint8_t outcome, const Eigen::Isometry3d& after) {
    auto message = stamped<panvo_msgs::msg::CorrectionOutcome>(t_s);
    message.landmark_id(id);
    message.outcome(outcome);
    message.after(conversions::to_pose(after));
    harness_.publish(topics::kCorrectionOutcome, message);
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

  static constexpr std::int64_t kBegin_ns = 1'700'000'000'000'000'000;
  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const visualization_msgs::msg::MarkerArray>>& scenes_ =
      harness_.collect(kPlaceMarkers);
};

TEST_F(MarkersComponent, ShowsPlacesWhereTheyAreNow) {
  load();
  publish_landmark(0.0, 7, pose_at(1.0, 2.0, 0.0));
  publish_landmark(0.1, 9, pose_at(5.0, 2.0, M_PI / 2.0), true);
  publish_poses(0.2, {{7, pose_at(1.5, 2.5, 0.0)}});
  publish_landmark(2.0, 11, pose_at(8.0, 8.0, 0.0));
  ASSERT_THAT(scenes_, testing::Not(IsEmpty()));
  const Marker& places = marker("places");
  EXPECT_EQ(places.header().frame_id(), "map");
  EXPECT_EQ(places.scale().x(), 1.5);
  EXPECT_THAT(std::vector(places.points().size(), 0).size(), places.colors().size());
  EXPECT_GE(places.points().size(), 2U);
  EXPECT_EQ(places.points()[0].x(), 1.5);
  EXPECT_GT(places.colors()[0].g(), places.colors()[0].r()) << "of this journey: green";
  EXPECT_EQ(places.colors()[1].g(), places.colors()[1].r()) << "of the map: grey";
  const auto headings = coordinates(marker("headings").points());
  EXPECT_THAT((std::vector(headings.begin(), headings.begin() + 4)), ElementsAre(1.5, 2.5, 4.5, 2.5));
  EXPECT_NEAR(headings[7], 8.0, 1e-9) << "6 m to the north of the junction";
  EXPECT_EQ(marker("ids").text(), "7");
}

TEST_F(MarkersComponent, ShowsFromWhereAPlaceWasSeen) {
  load({{"ids", "false"}, {"max_sightings", "2"}});
  publish_landmark(0.0, 1, pose_at(0.0, 0.0, 0.0));
  publish_outcome(0.1, 1, outcomes::APPLIED, pose_at(9.0, 9.0, 0.0));
  publish_outcome(0.2, 1, outcomes::REJECTED, pose_at(2.0, 0.0, 0.0));
  publish_outcome(0.3, 1, outcomes::APPLIED, pose_at(3.0, 0.0, 0.0));
  publish_landmark(2.0, 2, pose_at(50.0, 0.0, 0.0));
  ASSERT_THAT(scenes_, testing::Not(IsEmpty()));
  EXPECT_THAT(scenes_.back()->markers(), SizeIs(3));
  const Marker& lines = marker("sightings");
  EXPECT_THAT(coordinates(lines.points()), ElementsAre(2.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0)) << "the last two";
  ASSERT_THAT(lines.colors(), SizeIs(4));
  EXPECT_GT(lines.colors()[0].r(), lines.colors()[0].g()) << "rejected: orange";
  EXPECT_GT(lines.colors()[2].g(), lines.colors()[2].r()) << "applied: green";
}

TEST_F(MarkersComponent, IsSilentWithoutChange) {
  load();
  publish_landmark(0.0, 1, pose_at(0.0, 0.0, 0.0));
  publish_outcome(2.0, 99, outcomes::APPLIED, pose_at(3.0, 0.0, 0.0));
  const auto before = scenes_.size();
  ASSERT_GT(before, 0U);
  auto other = stamped<nav_msgs::msg::Odometry>(10.0);
  harness_.publish(topics::kOdometryEnhanced, other);
  EXPECT_LE(scenes_.size(), before + 1);
}

}  // namespace
}  // namespace panvo::markers
