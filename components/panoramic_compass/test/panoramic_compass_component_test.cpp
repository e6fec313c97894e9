// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>

#include "painted_panorama.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/panoramic_compass/panoramic_compass.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::panoramic_compass {
namespace {

constexpr std::int64_t kPeriod_ns = 200'000'000;

class PanoramicCompassComponent : public testing::Test {
 protected:
  void load(const std::map<std::string, std::string>& parameters = {}) {
    harness.load("panvo_panoramic_compass", "PanoramicCompassComponent", parameters);
  }
  void publish(const cv::Mat& panorama, const std::string& encoding = "mono8") {
    ++frames;
    auto message = conversions::make_image(frames * kPeriod_ns, "panorama", encoding, panorama.cols, panorama.rows);
    panorama.copyTo(conversions::pixels(*message));
    harness.publish(topics::kPanorama, std::shared_ptr<const sensor_msgs::msg::Image>(message));
  }
  void publish_mounting(const Eigen::Matrix3d& base_from_panorama) {
    Eigen::Isometry3d mounting = Eigen::Isometry3d::Identity();
    mounting.linear() = base_from_panorama;
    tf2_msgs::msg::TFMessage message;
    message.transforms({conversions::to_static_transform(0, "base_link", "panorama", mounting)});
    harness.publish(topics::kTfStatic, message);
  }

  void publish_heading(double yaw_rad) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.rotate(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
    nav_msgs::msg::Odometry odometry;
    odometry.header().stamp(conversions::to_stamp(frames * kPeriod_ns + 1'000'000));  // just after the last panorama
    odometry.pose().pose(conversions::to_pose(pose));
    harness.publish(topics::kOdometryBinocular, odometry);
  }
  /// Turns by 30 degrees with a mast between the columns 400 and 500.
  void turn_with_mast() {
    const cv::Mat mast = paint_panorama(5);
    for (double columns = 0.0; columns < 90.0; columns += 9.0) {
      cv::Mat view = turned_left(street, columns);
      mast.colRange(400, 500).copyTo(view.colRange(400, 500));
      publish(view);
      publish_heading(columns * kColumn_rad);
    }
  }

  runtime::ComponentHarness harness;
  const std::vector<std::shared_ptr<const panvo_msgs::msg::AzimuthChange>>& changes =
      harness.collect(topics::kAzimuthChange);
  const cv::Mat street = paint_panorama();
  int frames = 0;
};

TEST_F(PanoramicCompassComponent, TellsTheTurnOfEachPanoramaButTheFirst) {
  load();
  publish_mounting(upright_base_from_panorama());
  publish(street);
  EXPECT_TRUE(changes.empty());
  publish(turned_left(street, 10.0));
  publish(turned_left(street, 25.0));
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_TRUE(changes[1]->valid()) << changes[1]->reason();
  EXPECT_NEAR(changes[1]->azimuth_change_rad(), 25.0 * kColumn_rad, 0.1 * kColumn_rad);
  EXPECT_GT(changes[1]->variance_rad2(), 0.0);
  EXPECT_EQ(conversions::to_ns(changes[1]->from_stamp()), kPeriod_ns);
  EXPECT_EQ(conversions::to_ns(changes[1]->header().stamp()), 3 * kPeriod_ns);
  EXPECT_EQ(changes[1]->header().frame_id(), "panorama");
  EXPECT_FALSE(harness.log_contains("warning"));
}

TEST_F(PanoramicCompassComponent, WarnsOfAnUprightCameraWithTheVehiclesAxes) {
  load();
  publish_mounting(Eigen::Matrix3d::Identity());
  publish(street);
  EXPECT_TRUE(harness.log_contains("lies on its side in base_link"));
  EXPECT_TRUE(harness.log_contains("x right, y down, z ahead"));
}

TEST_F(PanoramicCompassComponent, TellsThePointsIfAnybodyReadsThem) {
  const auto& points = harness.collect(topics::kPanoramaPoints);
  load();
  publish(street);
  publish(turned_left(street, 10.0));
  publish(cv::Mat(street.size(), CV_8UC1, cv::Scalar(0)));
  ASSERT_EQ(points.size(), 3U) << "one per panorama";
  EXPECT_TRUE(points[0]->tracks().empty());
  ASSERT_EQ(points[1]->tracks().size(), 1U);
  EXPECT_EQ(conversions::to_ns(points[1]->tracks()[0].from_stamp()), kPeriod_ns);
  EXPECT_EQ(conversions::to_ns(points[1]->header().stamp()), 2 * kPeriod_ns);
  EXPECT_GT(points[1]->tracks()[0].points().size(), 50U);
  EXPECT_NEAR(points[1]->now_from_then().z(), -std::sin(0.5 * 10.0 * kColumn_rad), 1e-4);
  EXPECT_TRUE(points[2]->tracks().empty()) << "a black panorama";
}

TEST_F(PanoramicCompassComponent, HasThePapersMethodToo) {
  load({{"method", "two_patches"}});
  publish(street);
  publish(turned_left(street, 10.0));
  publish(turned_left(street, 25.0));
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_NEAR(changes[1]->azimuth_change_rad(), 15.0 * kColumn_rad, 0.5 * kColumn_rad);
  EXPECT_EQ(conversions::to_ns(changes[1]->from_stamp()), 2 * kPeriod_ns);
}

TEST_F(PanoramicCompassComponent, TakesColour) {
  load();
  cv::Mat colour;
  for (const double columns : {0.0, 10.0}) {
    cv::cvtColor(turned_left(street, columns), colour, cv::COLOR_GRAY2BGR);
    publish(colour, "rgb8");
  }
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_NEAR(changes[0]->azimuth_change_rad(), 10.0 * kColumn_rad, 0.1 * kColumn_rad);
}

TEST_F(PanoramicCompassComponent, SaysThatItDoesNotKnowHowTheCameraSits) {
  load();
  publish(street);
  EXPECT_TRUE(harness.log_contains("no chain from base_link to panorama"));
}

TEST_F(PanoramicCompassComponent, SaysWhyThereIsNoTurnAndWhenThereIsAgain) {
  load();
  publish(street);
  publish(cv::Mat(kRows, kColumns, CV_8UC1, cv::Scalar(0)));
  publish(turned_left(street, 3.0));
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_FALSE(changes[0]->valid());
  EXPECT_NE(changes[0]->reason().find("is black"), std::string::npos);
  EXPECT_TRUE(changes[1]->valid());
  EXPECT_TRUE(harness.log_contains("is black"));
  EXPECT_TRUE(harness.log_contains("valid again"));
}

TEST_F(PanoramicCompassComponent, TellsNoTurnOfAPanoramaThatIsTheLastAgain) {
  load();
  publish(street);
  publish(turned_left(street, 3.0));
  publish(turned_left(street, 3.0));
  publish(turned_left(street, 6.0));
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_FALSE(changes[1]->valid());
  EXPECT_EQ(changes[1]->reason(), "the panorama repeats its image (frozen)");
  EXPECT_TRUE(changes[2]->valid()) << changes[2]->reason();
  EXPECT_NEAR(changes[2]->azimuth_change_rad(), 6.0 * kColumn_rad, 0.1 * kColumn_rad);
}

/// Turns in upside-down or mirrored panoramas have the opposite sign, with the same certainty.
TEST_F(PanoramicCompassComponent, TellsNoTurnWhileTheCameraIsTurnedOver) {
  load();
  for (const auto& [code, fault] : {std::pair{-1, "upside down"}, {0, "upside down and mirrored"}, {1, "mirrored"}}) {
    publish(turned_left(street, -2.0));
    publish(street);
    for (int i = 1; i < 12; ++i) {
      cv::Mat over;
      cv::flip(turned_left(street, 2.0 * i), over, code);
      publish(over);
      EXPECT_FALSE(changes.back()->valid()) << fault << ", panorama " << i;
      EXPECT_EQ(changes.back()->reason(), std::string("the panorama is ") + fault);
    }
    publish(turned_left(street, 25.0));
    EXPECT_TRUE(changes.back()->valid()) << changes.back()->reason();
  }
}

TEST_F(PanoramicCompassComponent, TellsNoTurnWhileHalfOfTheViewIsCovered) {
  load();
  publish(street);
  for (int i = 1; i < 8; ++i) {
    cv::Mat covered = turned_left(street, 4.0 * i);
    covered.colRange(0, covered.cols / 2).setTo(cv::Scalar(25));
    publish(covered);
    EXPECT_FALSE(changes.back()->valid());
    EXPECT_NE(changes.back()->reason().find("is covered: 50 %"), std::string::npos) << changes.back()->reason();
  }
}

TEST_F(PanoramicCompassComponent, SaysThatItWaitsForAFirstUsablePanorama) {
  load();
  publish(street.colRange(0, 600));
  EXPECT_TRUE(changes.empty());
  EXPECT_TRUE(harness.log_contains("twice as wide"));
}

TEST_F(PanoramicCompassComponent, LeavesOutWhatComesOutOfOrder) {
  load();
  publish(street);
  frames = 0;
  publish(street);
  EXPECT_TRUE(changes.empty());
  EXPECT_TRUE(harness.log_contains("not later than the previous one"));
}

TEST_F(PanoramicCompassComponent, TakesANewReferenceIfTheClockIsSetBack) {
  load();
  frames = 5000;
  publish(street);
  publish(turned_left(street, 5.0));
  ASSERT_EQ(changes.size(), 1U);
  frames -= 3000;  // ten minutes
  for (int i = 0; i < 5; ++i) publish(turned_left(street, 6.0 + i));
  EXPECT_EQ(changes.size(), 1U) << "the fifth is the new reference";
  const std::int64_t reference_ns = frames * kPeriod_ns;
  publish(turned_left(street, 20.0));
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_TRUE(changes[1]->valid()) << changes[1]->reason();
  EXPECT_EQ(conversions::to_ns(changes[1]->from_stamp()), reference_ns);
  EXPECT_NEAR(changes[1]->azimuth_change_rad(), 10.0 * kColumn_rad, 0.1 * kColumn_rad);
}

TEST_F(PanoramicCompassComponent, GoesOnIfSinglePanoramasAreLate) {
  load();
  frames = 5000;
  publish(street);
  for (int i = 1; i < 10; ++i) {
    frames -= 3000;
    publish(turned_left(street, -50.0 + i));
    frames += 3000 - 1;
    publish(turned_left(street, 2.0 * i));
    ASSERT_EQ(changes.size(), static_cast<std::size_t>(i));
    EXPECT_TRUE(changes.back()->valid()) << changes.back()->reason();
    EXPECT_GE(conversions::to_ns(changes.back()->from_stamp()), 5001 * kPeriod_ns);
  }
}

TEST_F(PanoramicCompassComponent, LearnsTheVehicleAlsoAfterTheClockWasSetBack) {
  const auto& masks = harness.collect(topics::kVehicleMask);
  load();
  frames = 5000;
  publish(street);  // waits for its heading
  frames -= 3000;
  for (int i = 0; i < 5; ++i) publish(turned_left(street, 1.0 + i));
  publish_heading(0.0);
  turn_with_mast();
  EXPECT_FALSE(masks.empty());
}

TEST_F(PanoramicCompassComponent, LearnsTheVehicleAndTellsOthers) {
  const auto& masks = harness.collect(topics::kVehicleMask);
  load();
  turn_with_mast();
  ASSERT_FALSE(masks.empty());
  const cv::Mat mask = *conversions::grey(*masks.back());
  const cv::Mat walls = mask.rowRange(15, 27);
  EXPECT_LT(cv::mean(walls.colRange(41, 49))[0], 50.0);
  EXPECT_GT(cv::mean(walls.colRange(0, 38))[0], 200.0);
}

TEST_F(PanoramicCompassComponent, LearnsNoVehicleIfNotAllowed) {
  const auto& masks = harness.collect(topics::kVehicleMask);
  load({{"learn_vehicle_mask", "false"}});
  turn_with_mast();
  EXPECT_TRUE(masks.empty());
}

TEST_F(PanoramicCompassComponent, TakesTheVehicleFromAPicture) {
  const test::TemporaryFolder folder;
  cv::Mat picture(540, 1080, CV_8UC1, cv::Scalar(255));
  picture.colRange(400, 500).setTo(0);
  cv::imwrite((folder / "vehicle.png").string(), picture);
  const auto& masks = harness.collect(topics::kVehicleMask);
  load({{"vehicle_mask", (folder / "vehicle.png").string()}});
  turn_with_mast();
  ASSERT_EQ(masks.size(), 1U);
  const cv::Mat mask = *conversions::grey(*masks[0]);
  EXPECT_EQ(cv::countNonZero(mask), 98 * 54);
  EXPECT_EQ(cv::countNonZero(mask.colRange(40, 50)), 0);
}

TEST_F(PanoramicCompassComponent, RefusesAPictureOfTheVehicleThatIsNone) {
  const test::TemporaryFolder folder;
  folder.write("text.png", "no picture");
  for (const char* file : {"text.png", "nowhere.png"}) {
    try {
      load({{"vehicle_mask", (folder / file).string()}});
      FAIL() << file;
    } catch (const runtime::ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find(std::string(file) + " cannot be read"), std::string::npos)
          << error.what();
    }
  }
}

TEST_F(PanoramicCompassComponent, RefusesParametersThatContradictEachOther) {
  EXPECT_THROW(load({{"patches.beta_deg", "1.0"}}), runtime::ConfigError);
}

}  // namespace
}  // namespace panvo::panoramic_compass
