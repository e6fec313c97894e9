// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/runtime/testing.hpp"
#include "synthetic_place.hpp"

namespace panvo::position_corrector {
namespace {

constexpr std::int64_t kPeriod_ns = 200'000'000;

class PositionCorrectorComponent : public testing::Test {
 protected:
  PositionCorrectorComponent() { harness.load("panvo_position_corrector", "PositionCorrectorComponent"); }

  void publish_landmark(std::uint32_t id, unsigned seed, const landmarks::DescriptionSettings& settings) {
    auto landmark = landmark_of(place(seed), describer, Eigen::Vector3d(100.0 * id, 0.0, 0.0));
    landmark.id = id;
    harness.publish(topics::kLandmarks, to_message(landmark, settings, "map"));
  }
  void publish_landmark(std::uint32_t id, unsigned seed) {
    publish_landmark(id, seed, landmarks::description_settings(landmarks::DescriptionParameters{}, 1));
  }

  void publish_panorama(const cv::Mat& panorama) {
    ++frames;
    auto message = conversions::make_image(frames * kPeriod_ns, "panorama", "mono8", panorama.cols, panorama.rows);
    panorama.copyTo(conversions::pixels(*message));
    harness.publish(topics::kPanorama, std::shared_ptr<const sensor_msgs::msg::Image>(message));
  }

  void publish_odometry(double x_m, double sigma_m) {
    nav_msgs::msg::Odometry odometry;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().x() = x_m;
    odometry.pose().pose(conversions::to_pose(pose));
    odometry.pose().covariance(conversions::to_array(sigma_m * sigma_m * vision::Matrix6d::Identity()));
    harness.publish(topics::kOdometryBinocular, odometry);
  }

  landmarks::PanoramaDescriber describer{{}, 1};
  runtime::ComponentHarness harness;
  const std::vector<std::shared_ptr<const panvo_msgs::msg::LandmarkMatch>>& matches =
      harness.collect(topics::kLandmarkMatch);
  int frames = 0;
};

TEST_F(PositionCorrectorComponent, TellsOfEachPanoramaWhatItShows) {
  publish_landmark(1, 1);
  publish_landmark(2, 2);
  publish_odometry(200.0, 1.0);
  publish_panorama(place(80));
  publish_panorama(turned(place(2), 270));
  ASSERT_EQ(matches.size(), 2U);
  EXPECT_NE(matches[0]->state(), "locked");
  EXPECT_FALSE(matches[0]->reason().empty());
  EXPECT_EQ(matches[1]->state(), "locked") << matches[1]->reason();
  EXPECT_EQ(matches[1]->landmark_id(), 2U);
  EXPECT_EQ(matches[1]->candidates(), 1U);
  EXPECT_NEAR(matches[1]->heading_rad(), M_PI / 2.0, 0.01);
  EXPECT_EQ(conversions::to_ns(matches[1]->header().stamp()), 2 * kPeriod_ns);
  EXPECT_EQ(matches[1]->header().frame_id(), "panorama");
}

TEST_F(PositionCorrectorComponent, SearchesEverythingWithoutOdometryAndSaysSo) {
  publish_landmark(1, 1);
  publish_landmark(2, 2);
  publish_panorama(place(1));
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0]->candidates(), 2U);
  EXPECT_EQ(matches[0]->landmark_id(), 1U);
  EXPECT_TRUE(harness.log_contains("the whole library is searched"));
}

TEST_F(PositionCorrectorComponent, LeavesOutALandmarkThatWasDescribedOtherwise) {
  auto parameters = landmarks::DescriptionParameters{};
  parameters.top_deg = 45.0;
  publish_landmark(1, 1, landmarks::description_settings(parameters, 1));
  publish_panorama(place(1));
  EXPECT_TRUE(harness.log_contains("top_deg"));
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0]->reason(), "no landmarks yet");
}

TEST_F(PositionCorrectorComponent, SaysThatAPanoramaIsOfNoUse) {
  publish_landmark(1, 1);
  publish_panorama(cv::Mat(540, 1080, CV_8UC1, cv::Scalar(0)));
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0]->state(), "unusable");
  EXPECT_TRUE(harness.log_contains("panorama/image"));
}

}  // namespace
}  // namespace panvo::position_corrector
