// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/vision/stereo_geometry.hpp"
#include "synthetic_scene.hpp"

namespace panvo::binocular_odometry {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// A forward-looking camera on a mast: rotates optical axes to vehicle axes.
Eigen::Isometry3d base_from_left() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  pose.translation() << 0.3, 0.1, 1.2;
  return pose;
}

class BinocularOdometryComponent : public ::testing::Test {
 protected:
  void load(const std::map<std::string, std::string>& parameters = {}) {
    harness_.load("panvo_binocular_odometry", "BinocularOdometryComponent", parameters);
  }

  void publish_infos(const vision::RectifiedStereo& stereo = SyntheticScene::stereo()) {
    publish_infos(stereo, stereo);
  }

  void publish_infos(const vision::RectifiedStereo& of_left, const vision::RectifiedStereo& of_right) {
    const auto calibrated = [](const vision::RectifiedStereo& stereo) {
      vision::StereoCalibration raw;
      raw.left.pinhole = raw.right.pinhole = stereo.camera;
      raw.right_from_left.translation().x() = -stereo.baseline_m;
      return raw;
    };
    const auto left = conversions::left_camera(calibrated(of_left), of_left);
    const auto right = conversions::right_camera(calibrated(of_right), of_right);
    harness_.publish(topics::kStereoLeftCameraInfo, conversions::to_camera_info(left, 1, "left_optical"));
    harness_.publish(topics::kStereoRightCameraInfo, conversions::to_camera_info(right, 1, "right_optical"));
  }

  void publish_mounting(const Eigen::Isometry3d& mounting = base_from_left()) {
    geometry_msgs::msg::TransformStamped transform;
    transform.header().frame_id("base_link");
    transform.child_frame_id("left_optical");
    transform.transform(conversions::to_transform(mounting));
    tf2_msgs::msg::TFMessage message;
    message.transforms({transform});
    harness_.publish(topics::kTfStatic, message);
  }

  void publish_pair(const StereoFrame& frame) {
    publish_image(topics::kStereoLeftImageRect, frame.stamp_ns, "left_optical", frame.left);
    publish_image(topics::kStereoRightImageRect, frame.stamp_ns, "right_optical", frame.right);
  }

  void publish_image(const interfaces::Topic<sensor_msgs::msg::Image>& topic, std::int64_t stamp_ns,
                     const std::string& frame_id, const cv::Mat& pixels) {
    auto message = conversions::make_image(stamp_ns, frame_id, "mono8", pixels.cols, pixels.rows);
    pixels.copyTo(conversions::pixels(*message));
    harness_.publish(topic, std::shared_ptr<const sensor_msgs::msg::Image>(message));
  }

  std::int64_t lines_with(const std::string& text) const {
    return std::ranges::count_if(harness_.log(),
                                 [&](const std::string& line) { return line.find(text) != std::string::npos; });
  }

  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const nav_msgs::msg::Odometry>>& odometry_ =
      harness_.collect(topics::kOdometryBinocular);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::OdometryQuality>>& quality_ =
      harness_.collect(topics::kOdometryQuality);
};

TEST_F(BinocularOdometryComponent, PublishesTheRobotsMotionUnderTheImagesStamp) {
  load();
  publish_infos();
  publish_mounting();
  for (int i = 0; i < 5; ++i) publish_pair(SyntheticScene::frame(i));
  ASSERT_THAT(odometry_, SizeIs(5));
  ASSERT_THAT(quality_, SizeIs(5));
  EXPECT_FALSE(harness_.container().links().published.empty());
  EXPECT_THAT(harness_.container().links().published, testing::Not(testing::Contains("/tf")));
  const auto& last = *odometry_.back();
  EXPECT_EQ(conversions::stamp_ns(last), 1'400'000'000);
  EXPECT_EQ(last.header().frame_id(), "odom");
  EXPECT_EQ(last.child_frame_id(), "base_link");
  const Eigen::Isometry3d expected = base_from_left() * SyntheticScene::world_from_left(4) * base_from_left().inverse();
  const auto pose = conversions::to_isometry(last.pose().pose());
  ASSERT_TRUE(pose) << pose.reason();
  EXPECT_LT((pose->translation() - expected.translation()).norm(), 0.005);
  EXPECT_NEAR(last.twist().twist().linear().x(), 1.2, 0.02);      // 0.12 m per frame of 0.1 s, forward
  EXPECT_NEAR(last.twist().twist().angular().z(), -0.06, 0.005);  // to the right
  EXPECT_GT(last.pose().covariance()[0], 0.0);
  EXPECT_GT(last.twist().covariance()[0], 0.0);
  EXPECT_TRUE(quality_.back()->reliable()) << quality_.back()->reason();
}

/// A value of a point in a cloud.
float value(const sensor_msgs::msg::PointCloud2& cloud, std::size_t point, const std::string& name) {
  const auto field = std::ranges::find_if(cloud.fields(), [&](const auto& one) { return one.name() == name; });
  float read = 0.0F;
  std::memcpy(&read, cloud.data().data() + point * cloud.point_step() + field->offset(), sizeof read);
  return read;
}

TEST_F(BinocularOdometryComponent, PublishesItsPointsWhereTheyAreSeen) {
  const auto& clouds = harness_.collect(topics::kOdometryPoints);
  load();
  publish_infos();
  publish_mounting();
  for (int i = 0; i < 5; ++i) publish_pair(SyntheticScene::frame(i));
  ASSERT_THAT(clouds, SizeIs(5));
  const auto& cloud = *clouds.back();
  EXPECT_EQ(cloud.header(), odometry_.back()->header());
  EXPECT_EQ(cloud.data().size(), std::size_t{cloud.width()} * cloud.point_step());
  ASSERT_GT(cloud.width(), 50U);
  const Eigen::Isometry3d odom_from_left =
      *conversions::to_isometry(odometry_.back()->pose().pose()) * base_from_left();
  std::size_t seen = 0;
  for (std::size_t i = 0; i < cloud.width(); ++i) {
    const auto* unused = cloud.data().data() + i * cloud.point_step() + 25;
    EXPECT_EQ(std::count(unused, unused + 3, 0), 3) << "a replay must be the same in each byte";
    const Eigen::Vector3d in_odom(value(cloud, i, "x"), value(cloud, i, "y"), value(cloud, i, "z"));
    if (!in_odom.allFinite()) continue;
    const Eigen::Vector3d pixel = vision::observe(SyntheticScene::stereo(), odom_from_left.inverse() * in_odom);
    seen += (pixel.head<2>() - Eigen::Vector2d(value(cloud, i, "u"), value(cloud, i, "v"))).norm() < 1.0;
  }
  EXPECT_GT(seen, cloud.width() * 9 / 10);
}

TEST_F(BinocularOdometryComponent, PublishesThePoseAsATransformOnlyIfAsked) {
  const auto& tf = harness_.collect(topics::kTf);
  load({{"publish_tf", "true"}, {"odom_frame", "start"}});
  publish_infos();
  publish_mounting();
  for (int i = 0; i < 3; ++i) publish_pair(SyntheticScene::frame(i));
  ASSERT_THAT(odometry_, SizeIs(3));
  ASSERT_THAT(tf, SizeIs(3));
  const auto& odometry = *odometry_.back();
  ASSERT_THAT(tf.back()->transforms(), SizeIs(1));
  const auto& transform = tf.back()->transforms()[0];
  EXPECT_EQ(transform.header(), odometry.header());
  EXPECT_EQ(transform.header().frame_id(), "start");
  EXPECT_EQ(transform.child_frame_id(), "base_link");
  EXPECT_GT(transform.transform().translation().x(), 0.1);
  EXPECT_EQ(transform.transform().translation().x(), odometry.pose().pose().position().x());
  EXPECT_EQ(transform.transform().translation().y(), odometry.pose().pose().position().y());
  EXPECT_EQ(transform.transform().translation().z(), odometry.pose().pose().position().z());
  EXPECT_EQ(transform.transform().rotation(), odometry.pose().pose().orientation());
}

TEST_F(BinocularOdometryComponent, WaitsForTheMountingAndSaysSo) {
  load();
  publish_infos();
  publish_pair(SyntheticScene::frame(0));
  EXPECT_THAT(odometry_, IsEmpty());
  EXPECT_TRUE(harness_.log_contains("/tf_static"));
  publish_mounting();
  publish_pair(SyntheticScene::frame(1));
  EXPECT_THAT(odometry_, SizeIs(1));
}

TEST_F(BinocularOdometryComponent, WaitsForTheCalibrationAndSaysSo) {
  load();
  publish_mounting();
  publish_pair(SyntheticScene::frame(0));
  EXPECT_THAT(odometry_, IsEmpty());
  EXPECT_TRUE(harness_.log_contains("camera_info"));
}

TEST_F(BinocularOdometryComponent, SaysWhyAPoseIsUnreliableAndWhenItIsReliableAgain) {
  load();
  publish_infos();
  publish_mounting();
  publish_pair(SyntheticScene::frame(0));
  publish_pair(SyntheticScene::frame(1));
  StereoFrame black = SyntheticScene::frame(2);
  black.left.setTo(0);
  publish_pair(black);
  ASSERT_THAT(quality_, SizeIs(3));
  EXPECT_FALSE(quality_.back()->reliable());
  EXPECT_THAT(quality_.back()->reason(), HasSubstr("left image is black"));
  EXPECT_TRUE(harness_.log_contains("unreliable: left image is black"));
  publish_pair(SyntheticScene::frame(3));
  EXPECT_TRUE(quality_.back()->reliable());
  EXPECT_TRUE(harness_.log_contains("reliable again"));
  EXPECT_THAT(odometry_, SizeIs(4));
}

TEST_F(BinocularOdometryComponent, WarnsOnceOfAStaleCalibration) {
  load();
  publish_infos();
  publish_mounting();
  const Eigen::Matrix3d turned = vision::so3_exp({2.0 / SyntheticScene::stereo().camera.fx, 0.0, 0.0});
  for (int i = 0; i < 12; ++i) {
    publish_pair(SyntheticScene::frame(i, SyntheticScene::world_from_left(i), turned));
  }
  EXPECT_EQ(lines_with("Recalibrate the pair"), 1);
}

TEST_F(BinocularOdometryComponent, GoesOnWithAnotherCalibrationAndMounting) {
  load();
  publish_infos();
  publish_mounting();
  constexpr int kChange = 6, kFrames = 14;
  for (int i = 0; i < kChange; ++i) publish_pair(SyntheticScene::frame(i));
  // The cameras restart with smaller images, elsewhere on the vehicle. At first, one of them is black.
  const cv::Rect part(20, 30, 280, 200);
  vision::RectifiedStereo smaller = SyntheticScene::stereo();
  smaller.camera = {220.0, 220.0, 159.5 - part.x, 119.5 - part.y, part.width, part.height};
  Eigen::Isometry3d moved(Eigen::Translation3d(0.1, -0.2, 0.3));
  moved.linear() = vision::so3_exp({0.08, 0.05, 0.0});
  publish_infos(smaller);
  publish_mounting(base_from_left() * moved);
  for (int i = kChange; i < kFrames; ++i) {
    StereoFrame frame = SyntheticScene::frame(i, SyntheticScene::world_from_left(i) * moved);
    if (i == kChange) frame.left.setTo(0);
    publish_pair({frame.stamp_ns, frame.left(part), frame.right(part)});
  }
  ASSERT_THAT(odometry_, SizeIs(kFrames));
  for (int i = 0; i < kFrames; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_EQ(quality_[at]->reliable(), i != kChange && i != kChange + 1) << i << ": " << quality_[at]->reason();
    const Eigen::Isometry3d expected =
        base_from_left() * SyntheticScene::world_from_left(i) * base_from_left().inverse();
    const auto pose = conversions::to_isometry(odometry_[at]->pose().pose());
    EXPECT_LT((pose->translation() - expected.translation()).norm(), 0.02) << i;
    EXPECT_LT(vision::so3_log(pose->linear().transpose() * expected.linear()).norm(), 0.01) << i;
    if (i == 0) continue;
    EXPECT_NEAR(odometry_[at]->twist().twist().linear().x(), 1.2, 0.05) << i;
  }
  EXPECT_THAT(quality_[kChange + 1]->reason(), HasSubstr("calibration"));
  // Two frames that were not measured, at an acceleration that nobody knows.
  EXPECT_GT(odometry_[kChange + 1]->pose().covariance()[0], 10.0 * odometry_[kChange - 1]->pose().covariance()[0]);
  EXPECT_GT(odometry_[kFrames - 1]->pose().covariance()[0], odometry_[kChange + 1]->pose().covariance()[0]);
  EXPECT_EQ(lines_with("tracking restarts with the new calibration"), 1);
}

TEST_F(BinocularOdometryComponent, GoesOnWithAnotherCalibrationThatLasts) {
  load();
  publish_infos();
  publish_mounting();
  publish_pair(SyntheticScene::frame(0));
  vision::RectifiedStereo longer = SyntheticScene::stereo();
  longer.baseline_m *= 1.5;
  publish_infos(longer);  // once, as of a driver that keeps it for late readers
  for (int i = 1; i < 5; ++i) publish_pair(SyntheticScene::frame(i));
  EXPECT_EQ(lines_with("tracking restarts with the new calibration"), 0);
  for (int i = 5; i < 10; ++i) publish_pair(SyntheticScene::frame(i));
  EXPECT_EQ(lines_with("tracking restarts with the new calibration"), 1);
  ASSERT_THAT(odometry_, SizeIs(10));
  EXPECT_TRUE(quality_.back()->reliable()) << quality_.back()->reason();
  EXPECT_NEAR(odometry_.back()->twist().twist().linear().x(), 1.5 * 1.2, 0.05);
}

TEST_F(BinocularOdometryComponent, RestartsOnceIfTheCamerasTellAnotherCalibrationOneAfterTheOther) {
  load();
  publish_infos();
  publish_mounting();
  publish_pair(SyntheticScene::frame(0));
  vision::RectifiedStereo longer = SyntheticScene::stereo();
  longer.camera.fx *= 1.02;
  longer.camera.fy *= 1.02;
  constexpr int kFrames = 12;
  for (int i = 1; i < kFrames; ++i) {
    publish_infos(longer, i > 1 ? longer : SyntheticScene::stereo());
    publish_pair(SyntheticScene::frame(i));
  }
  EXPECT_EQ(lines_with("do not form a stereo pair"), 0);
  EXPECT_EQ(lines_with("tracking restarts with the new calibration"), 1);
  ASSERT_THAT(odometry_, SizeIs(kFrames)) << "no pair is lost";
}

TEST_F(BinocularOdometryComponent, KeepsTheCalibrationIfTwoPublishersDisagree) {
  load();
  publish_mounting();
  vision::RectifiedStereo longer = SyntheticScene::stereo();
  longer.baseline_m *= 1.5;
  constexpr int kFrames = 12;
  for (int i = 0; i < kFrames; ++i) {
    if (i > 0) publish_infos(longer);
    if (i % 2 == 0) publish_infos();
    publish_pair(SyntheticScene::frame(i));
  }
  ASSERT_THAT(odometry_, SizeIs(kFrames));
  for (int i = 1; i < kFrames; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_TRUE(quality_[at]->reliable()) << i << ": " << quality_[at]->reason();
    EXPECT_NEAR(odometry_[at]->twist().twist().linear().x(), 1.2, 0.03) << i;
  }
  EXPECT_EQ(lines_with("/stereo/right/camera_info alternates between two calibrations: two publishers disagree"), 1);
  EXPECT_EQ(lines_with("tracking restarts"), 0);
}

TEST_F(BinocularOdometryComponent, SaysOnceThatAnotherMountingIsIgnored) {
  load();
  publish_infos();
  publish_mounting();
  for (int i = 0; i < 3; ++i) publish_pair(SyntheticScene::frame(i));
  publish_mounting();
  publish_pair(SyntheticScene::frame(3));
  EXPECT_EQ(lines_with("used only when tracking restarts"), 0);
  publish_mounting(base_from_left() * Eigen::Isometry3d(Eigen::Translation3d(0.1, 0.0, 0.0)));
  for (int i = 4; i < 7; ++i) publish_pair(SyntheticScene::frame(i));
  EXPECT_EQ(lines_with("/tf_static has another pose of left_optical on base_link than when tracking began: it is "
                       "used only when tracking restarts"),
            1);
  ASSERT_THAT(odometry_, SizeIs(7));
  const Eigen::Isometry3d expected = base_from_left() * SyntheticScene::world_from_left(6) * base_from_left().inverse();
  EXPECT_LT((conversions::to_isometry(odometry_.back()->pose().pose())->translation() - expected.translation()).norm(),
            0.01);
}

TEST_F(BinocularOdometryComponent, APairThatComesLateHasItsQualityButNoPose) {
  load();
  publish_infos();
  publish_mounting();
  publish_pair(SyntheticScene::frame(1));
  publish_pair(SyntheticScene::frame(2));
  publish_pair(SyntheticScene::frame(0));
  EXPECT_THAT(odometry_, SizeIs(2));
  ASSERT_THAT(quality_, SizeIs(3));
  EXPECT_FALSE(quality_.back()->reliable());
}

TEST_F(BinocularOdometryComponent, APairThatComesTwiceOrLateDoesNotChangeTheNextTwist) {
  load();
  publish_infos();
  publish_mounting();
  const auto publish = [this](int index) {
    StereoFrame frame = SyntheticScene::frame(index);
    frame.stamp_ns = 1'000'000'000 + index * 24'000'000;  // 5 m/s
    publish_pair(frame);
  };
  for (const int index : {0, 1, 2, 3, 4, 4, 5, 6, 5, 7, 8, 6, 7, 8, 9}) publish(index);
  ASSERT_THAT(odometry_, SizeIs(10));
  EXPECT_THAT(quality_, SizeIs(15));
  for (std::size_t i = 1; i < odometry_.size(); ++i) {
    EXPECT_NEAR(odometry_[i]->twist().twist().linear().x(), 5.0, 0.25) << i;
    const Eigen::Isometry3d expected =
        base_from_left() * SyntheticScene::world_from_left(static_cast<int>(i)) * base_from_left().inverse();
    const auto pose = conversions::to_isometry(odometry_[i]->pose().pose());
    EXPECT_LT((pose->translation() - expected.translation()).norm(), 0.01) << i;
  }
}

TEST_F(BinocularOdometryComponent, ATwistThatIsUnknownHasALargeCovariance) {
  load();
  publish_infos();
  publish_mounting();
  const auto publish = [this](int index, std::int64_t stamp_ns) {
    StereoFrame frame = SyntheticScene::frame(index);
    frame.stamp_ns = stamp_ns;
    publish_pair(frame);
  };
  for (int i = 0; i < 4; ++i) publish(i, 101'000'000'000 + i * SyntheticScene::kInterval_ns);
  // The clock is set back by 100 s. The first pair after that is lost.
  for (int i = 4; i < 8; ++i) publish(i, 1'000'000'000 + i * SyntheticScene::kInterval_ns);
  ASSERT_THAT(odometry_, SizeIs(7));
  for (std::size_t i = 0; i < odometry_.size(); ++i) {
    const auto& twist = odometry_[i]->twist();
    const bool is_unknown = i == 0 || i == 4;
    EXPECT_EQ(twist.twist().linear().x() == 0.0, is_unknown) << i;
    for (const std::size_t diagonal : {0, 7, 14, 21, 28, 35}) {
      EXPECT_EQ(twist.covariance()[diagonal] >= 1e6, is_unknown) << i;
    }
  }
}

TEST_F(BinocularOdometryComponent, RefusesAParameterOutOfItsRange) {
  EXPECT_ANY_THROW(load({{"tracking.front_end", "surf"}}));
  EXPECT_ANY_THROW(load({{"tracking.max_feature", "100"}}));
}

}  // namespace
}  // namespace panvo::binocular_odometry
