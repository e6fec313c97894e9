// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <string>

#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/position_corrector/point_messages.hpp"
#include "panvo/runtime/testing.hpp"
#include "synthetic_place.hpp"

namespace panvo::position_corrector {
namespace {

constexpr std::int64_t kPeriod_ns = 200'000'000;

class PositionCorrectorComponent : public testing::Test {
 protected:
  explicit PositionCorrectorComponent(const std::map<std::string, std::string>& parameters = {}) {
    harness.load("panvo_position_corrector", "PositionCorrectorComponent", parameters);
  }

  void publish_landmark(std::uint32_t id, unsigned seed, const landmarks::DescriptionSettings& settings) {
    auto landmark = landmark_of(place(seed), describer, Eigen::Vector3d(100.0 * id, 0.0, 0.0));
    landmark.id = id;
    landmark.base_from_panorama = mounted(2.0);
    harness.publish(topics::kLandmarks, to_message(landmark, settings, "map"));
  }
  void publish_landmark(std::uint32_t id, unsigned seed) {
    publish_landmark(id, seed, landmarks::landmark_settings({}, {}, 1));
  }

  void publish_panorama(const cv::Mat& panorama) {
    ++frames;
    auto message = conversions::make_image(frames * kPeriod_ns, "panorama", "mono8", panorama.cols, panorama.rows);
    cv::Mat pixels = conversions::pixels(*message);
    panorama.copyTo(pixels);
    if (has_noise) pixels.at<uchar>(0, frames % pixels.cols) ^= 1U;  // like sensor noise: no two images are equal
    harness.publish(topics::kPanorama, std::shared_ptr<const sensor_msgs::msg::Image>(message));
  }

  /// With the stamp of the next panorama.
  void publish_odometry(double x_m, double sigma_m, double speed_m_s = 0.0) {
    nav_msgs::msg::Odometry odometry;
    odometry.header().stamp(conversions::to_stamp((frames + 1) * kPeriod_ns));
    odometry.twist().twist().linear().x(speed_m_s);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().x() = x_m;
    odometry.pose().pose(conversions::to_pose(pose));
    odometry.pose().covariance(conversions::to_array(sigma_m * sigma_m * vision::Matrix6d::Identity()));
    harness.publish(topics::kOdometryBinocular, odometry);
  }

  void publish_mounting(double up_m) {
    tf2_msgs::msg::TFMessage message;
    message.transforms().push_back(conversions::to_static_transform(0, "base_link", "panorama", mounted(up_m)));
    harness.publish(topics::kTfStatic, message);
  }

  void publish_poses(const std::map<std::uint32_t, double>& x_by_id) {
    panvo_msgs::msg::LandmarkPoses message;
    for (const auto& [id, x_m] : x_by_id) {
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation().x() = x_m;
      message.ids().push_back(id);
      message.poses().emplace_back();
      message.poses().back().pose(conversions::to_pose(pose));
      message.poses().back().covariance(conversions::to_array(vision::Matrix6d::Identity()));
    }
    harness.publish(topics::kLandmarkPoses, message);
  }

  /// Passes place 2, one metre per panorama: a similar view, the exact one, and four more similar views.
  void pass() {
    cv::Mat nearly = place(2);
    cv::rectangle(nearly, {100, 150, 120, 150}, 30, cv::FILLED);
    for (int i = 0; i < 6; ++i) {
      publish_odometry(200.0, 5.0, 5.0);
      publish_panorama(i == 1 ? place(2) : nearly);
    }
  }

  /// Extrinsics of a forward-looking camera (X right, Y down, Z forward) above the base.
  static Eigen::Isometry3d mounted(double up_m) {
    Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
    base_from_panorama.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    base_from_panorama.translation().z() = up_m;
    return base_from_panorama;
  }

  landmarks::PanoramaDescriber describer{{}, 1};
  runtime::ComponentHarness harness;
  const std::vector<std::shared_ptr<const panvo_msgs::msg::LandmarkMatch>>& matches =
      harness.collect(topics::kLandmarkMatch);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::PositionCorrection>>& corrections =
      harness.collect(topics::kCorrection);
  int frames = 0;
  bool has_noise = true;
};

class PaperPositionCorrector : public PositionCorrectorComponent {
 protected:
  PaperPositionCorrector() : PositionCorrectorComponent({{"correction.method", "paper"}}) {}
};

TEST_F(PositionCorrectorComponent, TellsOfEachPanoramaWhatItShows) {
  publish_landmark(1, 1);
  publish_landmark(2, 2);
  publish_odometry(200.0, 1.0);
  publish_panorama(place(80));
  publish_panorama(turned(place(2), 270));
  ASSERT_EQ(matches.size(), 2U);
  EXPECT_NE(matches[0]->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED);
  EXPECT_FALSE(matches[0]->reason().empty());
  EXPECT_EQ(matches[1]->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED) << matches[1]->reason();
  EXPECT_EQ(matches[1]->landmark_id(), 2U);
  EXPECT_EQ(matches[1]->candidates(), 1U);
  EXPECT_NEAR(matches[1]->heading_rad(), M_PI / 2.0, 0.01);
  EXPECT_EQ(conversions::to_ns(matches[1]->header().stamp()), 2 * kPeriod_ns);
  EXPECT_EQ(matches[1]->header().frame_id(), "panorama");
}

/// The offset of a field of a point, which must exist.
std::size_t offset_of(const sensor_msgs::msg::PointCloud2& cloud, const std::string& name) {
  for (const auto& field : cloud.fields()) {
    if (field.name() == name) return field.offset();
  }
  ADD_FAILURE() << name;
  return 0;
}

float value_of(const sensor_msgs::msg::PointCloud2& cloud, std::size_t point, const std::string& name) {
  float value = 0.0F;
  std::memcpy(&value, &cloud.data()[point * cloud.point_step() + offset_of(cloud, name)], sizeof value);
  return value;
}

TEST_F(PositionCorrectorComponent, TellsAReaderWhichPointsOfTheLandmarkItSees) {
  const auto& clouds = harness.collect(kLandmarkPoints);
  publish_landmark(2, 2);
  publish_odometry(200.0, 1.0);
  publish_panorama(turned(place(2), 270));  // a quarter of a turn to the left
  ASSERT_EQ(clouds.size(), 1U);
  const auto& cloud = *clouds[0];
  EXPECT_EQ(conversions::to_ns(cloud.header().stamp()), kPeriod_ns);
  EXPECT_EQ(cloud.header().frame_id(), "panorama");
  ASSERT_GE(cloud.width(), 12U);
  ASSERT_EQ(cloud.data().size(), std::size_t{cloud.width()} * cloud.point_step());
  std::uint32_t agreeing = 0;
  for (std::size_t i = 0; i < cloud.width(); ++i) {
    std::uint32_t landmark = 0;
    std::memcpy(&landmark, &cloud.data()[i * cloud.point_step() + offset_of(cloud, "landmark")], sizeof landmark);
    EXPECT_EQ(landmark, 2U);
    if (cloud.data()[i * cloud.point_step() + offset_of(cloud, "state")] != 1) continue;
    ++agreeing;
    // what was ahead is seen at the right: the column grows by a quarter of the width
    const float shift = value_of(cloud, i, "u") - value_of(cloud, i, "place_u");
    EXPECT_NEAR(shift - std::floor(shift), 0.25F, 0.01F);
    EXPECT_NEAR(value_of(cloud, i, "v"), value_of(cloud, i, "place_v"), 0.01F);
    const float x = value_of(cloud, i, "x"), z = value_of(cloud, i, "z");
    EXPECT_NEAR(std::remainder(std::atan2(x, z) / (2.0 * M_PI) + 0.5 - value_of(cloud, i, "u"), 1.0), 0.0, 0.01);
  }
  EXPECT_EQ(agreeing, corrections.at(0)->inliers());
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
  publish_landmark(1, 1, landmarks::landmark_settings(parameters, {}, 1));
  publish_panorama(place(1));
  EXPECT_TRUE(harness.log_contains("top_deg"));
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0]->reason(), "no landmarks yet");
}

/// Unchecked, each of them would crash the process or the component.
TEST_F(PositionCorrectorComponent, LeavesOutLandmarksThatNoMatrixHereCouldDescribe) {
  const auto settings = landmarks::landmark_settings({}, {}, 1);
  auto landmark = landmark_of(place(2), describer, Eigen::Vector3d(200.0, 0.0, 0.0));
  landmark.id = 2;
  for (const std::uint16_t row : {800, 65535}) {
    for (auto* features : {&landmark.description.large, &landmark.description.small}) {
      auto broken = landmark;
      (features == &landmark.description.large ? broken.description.large : broken.description.small)[0].row = row;
      harness.publish(topics::kLandmarks, to_message(broken, settings, "map"));
    }
  }
  auto broken = landmark;
  broken.description.histogram = {1.0F};
  harness.publish(topics::kLandmarks, to_message(broken, settings, "map"));
  publish_odometry(200.0, 1.0);
  publish_panorama(place(2));
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0]->candidates(), 0U);
  EXPECT_TRUE(harness.log_contains("large_features.row is not a row of the measurement matrix"));
  EXPECT_TRUE(harness.log_contains("histogram does not have as many bins as the settings specify"));
  EXPECT_TRUE(harness.container().run().empty());
}

TEST_F(PositionCorrectorComponent, SaysThatAPanoramaIsOfNoUse) {
  publish_landmark(1, 1);
  publish_panorama(cv::Mat(540, 1080, CV_8UC1, cv::Scalar(0)));
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0]->state(), panvo_msgs::msg::LandmarkMatch_Constants::UNUSABLE);
  EXPECT_TRUE(harness.log_contains("panorama/image"));
}

TEST_F(PositionCorrectorComponent, UsesNoPanoramaThatIsTheLastAgainOrUpsideDown) {
  has_noise = false;
  publish_landmark(2, 2);
  publish_panorama(place(2));
  publish_panorama(place(2));
  cv::Mat turned_over;
  cv::flip(place(2), turned_over, -1);
  publish_panorama(turned_over);
  ASSERT_EQ(matches.size(), 3U);
  EXPECT_NE(matches[0]->state(), panvo_msgs::msg::LandmarkMatch_Constants::UNUSABLE) << matches[0]->reason();
  EXPECT_EQ(matches[1]->state(), panvo_msgs::msg::LandmarkMatch_Constants::UNUSABLE);
  EXPECT_EQ(matches[1]->reason(), "repeats its image (frozen)");
  EXPECT_EQ(matches[2]->state(), panvo_msgs::msg::LandmarkMatch_Constants::UNUSABLE);
  EXPECT_EQ(matches[2]->reason(), "is upside down");
  EXPECT_EQ(corrections.size(), 1U);
}

TEST_F(PositionCorrectorComponent, SaysWhereTheVehicleIsSeenFromTheLandmark) {
  publish_mounting(1.5);
  publish_landmark(2, 2);
  publish_panorama(turned(place(2), 270));
  ASSERT_EQ(corrections.size(), 1U);
  const auto& correction = *corrections[0];
  EXPECT_EQ(correction.state(), panvo_msgs::msg::PositionCorrection_Constants::FULL) << correction.reason();
  EXPECT_EQ(correction.reason(), "");
  EXPECT_EQ(correction.landmark_id(), 2U);
  EXPECT_GE(correction.inliers(), 12U);
  EXPECT_EQ(conversions::to_ns(correction.header().stamp()), kPeriod_ns);
  const auto pose = conversions::to_isometry(correction.landmark_from_base().pose());
  ASSERT_TRUE(pose);
  // a quarter turn to the left at the same position; the camera is half a metre lower than before
  EXPECT_LT((pose->linear() - vision::so3_exp(Eigen::Vector3d(0.0, 0.0, M_PI / 2.0))).norm(), 0.01);
  EXPECT_LT((pose->translation() - Eigen::Vector3d(0.0, 0.0, 0.5)).norm(), 0.1);
  const auto covariance = conversions::to_matrix(correction.landmark_from_base().covariance());
  EXPECT_GT(covariance(0, 0), 0.0);
  EXPECT_LT(covariance(0, 0), 0.1);
}

TEST_F(PositionCorrectorComponent, TakesTheLandmarksMountingForItsOwnAndSaysSoOnce) {
  publish_landmark(2, 2);
  publish_panorama(place(2));
  publish_panorama(place(2));
  ASSERT_EQ(corrections.size(), 2U);
  const auto pose = conversions::to_isometry(corrections[0]->landmark_from_base().pose());
  ASSERT_TRUE(pose);
  EXPECT_LT(pose->translation().norm(), 0.1);
  int said = 0;
  for (const auto& line : harness.log()) said += line.find("extrinsics stored with the landmark") != std::string::npos;
  EXPECT_EQ(said, 1);
}

TEST_F(PositionCorrectorComponent, SendsAPanoramasPoseOnce) {
  publish_landmark(2, 2);
  pass();
  ASSERT_EQ(matches.back()->state(), panvo_msgs::msg::LandmarkMatch_Constants::MATCHED);
  EXPECT_EQ(conversions::to_ns(matches.back()->header().stamp()), 2 * kPeriod_ns);
  ASSERT_GE(corrections.size(), 4U);
  for (std::size_t i = 1; i < corrections.size(); ++i) {
    EXPECT_LT(conversions::to_ns(corrections[i - 1]->header().stamp()),
              conversions::to_ns(corrections[i]->header().stamp()));
  }
}

TEST_F(PositionCorrectorComponent, IsLessSureAlongTheWayOfAVehicleThatDrivesFast) {
  publish_landmark(2, 2);
  publish_odometry(200.0, 1.0, 0.0);
  publish_panorama(place(2));
  publish_odometry(200.0, 1.0, 10.0);
  publish_panorama(place(2));
  ASSERT_EQ(corrections.size(), 2U);
  // 3 ms at either stamp, at 10 m/s
  EXPECT_NEAR(
      corrections[1]->landmark_from_base().covariance()[0] - corrections[0]->landmark_from_base().covariance()[0],
      2.0 * 0.03 * 0.03, 1e-4);
}

TEST_F(PositionCorrectorComponent, TellsThatGeometryRejectedALandmark) {
  auto landmark = landmark_of(place(2), describer, Eigen::Vector3d::Zero());
  landmark.id = 2;
  for (std::size_t i = 0; i < landmark.keypoints.size(); ++i) {  // wrong depths
    landmark.keypoints[i].point_in_panorama =
        Eigen::AngleAxisf(0.3F * static_cast<float>(i % 7), Eigen::Vector3f::UnitY()) *
        landmark.keypoints[i].point_in_panorama;
  }
  harness.publish(topics::kLandmarks, to_message(landmark, landmarks::landmark_settings({}, {}, 1), "map"));
  cv::Mat disturbed = place(2);
  publish_panorama(disturbed);
  ASSERT_EQ(corrections.size(), 1U);
  EXPECT_EQ(corrections[0]->state(), panvo_msgs::msg::PositionCorrection_Constants::REJECTED);
  EXPECT_EQ(corrections[0]->landmark_id(), 2U);
  EXPECT_EQ(corrections[0]->reason().rfind("landmark 2: ", 0), 0U) << corrections[0]->reason();
}

TEST_F(PositionCorrectorComponent, RejectsTheMostSimilarLandmarkWhereThereIsNone) {
  publish_landmark(1, 1);
  publish_panorama(place(80));
  EXPECT_NE(matches.back()->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED);
  ASSERT_EQ(corrections.size(), 1U);
  EXPECT_EQ(corrections[0]->state(), panvo_msgs::msg::PositionCorrection_Constants::REJECTED);
}

TEST_F(PositionCorrectorComponent, LooksForALandmarkWhereItWasMovedTo) {
  publish_landmark(2, 2);
  publish_poses({{2, 500.0}});
  publish_odometry(200.0, 1.0);
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->candidates(), 0U);
  publish_odometry(500.0, 1.0);
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED) << matches.back()->reason();
}

TEST_F(PositionCorrectorComponent, MovesALandmarkThatComesAfterItsPose) {
  publish_poses({{2, 500.0}});
  publish_landmark(2, 2);
  publish_odometry(500.0, 1.0);
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->candidates(), 1U);
}

TEST_F(PositionCorrectorComponent, LeavesLandmarksWhereTheyAreWhenTheirPosesAreMalformed) {
  publish_landmark(2, 2);
  panvo_msgs::msg::LandmarkPoses message;
  message.ids({2});
  harness.publish(topics::kLandmarkPoses, message);
  EXPECT_TRUE(harness.log_contains("was dropped: poses differ in number from ids"));
  publish_odometry(200.0, 1.0);
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->candidates(), 1U);
}

TEST_F(PositionCorrectorComponent, DoesNotTakeACorrectionsJumpForWayThatLeavesALandmark) {
  publish_odometry(0.0, 1.0, 1.0);
  publish_panorama(place(80));
  publish_landmark(2, 2);
  publish_odometry(200.0, 1.0, 1.0);  // a jump of 200 m at walking pace: a correction
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->candidates(), 0U) << "just built";
}

TEST_F(PositionCorrectorComponent, LooksWhereTheVehicleWasWhenALatePanoramaWasTaken) {
  publish_landmark(2, 2);
  publish_odometry(200.0, 1.0, 20.0);
  frames += 20;
  publish_odometry(400.0, 1.0, 20.0);
  frames -= 20;
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED) << matches.back()->reason();
}

TEST_F(PositionCorrectorComponent, KeepsKeypointsInMemoryWhereThereIsNoFolderForThem) {
  runtime::ComponentHarness other;
  const auto& found = other.collect(topics::kLandmarkMatch);
  other.load("panvo_position_corrector", "PositionCorrectorComponent", {{"spill_folder", "/no/such/folder"}});
  auto landmark = landmark_of(place(2), describer, Eigen::Vector3d::Zero());
  landmark.id = 2;
  other.publish(topics::kLandmarks, to_message(landmark, landmarks::landmark_settings({}, {}, 1), "map"));
  EXPECT_TRUE(other.log_contains("keypoints of landmarks stay in memory"));
  auto message = conversions::make_image(kPeriod_ns, "panorama", "mono8", kColumns, kRows);
  place(2).copyTo(conversions::pixels(*message));
  other.publish(topics::kPanorama, std::shared_ptr<const sensor_msgs::msg::Image>(message));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0]->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED) << found[0]->reason();
}

// [Lu2015 5.2]
TEST_F(PaperPositionCorrector, CorrectsOnceAPassAtTheNearestPoint) {
  publish_landmark(2, 2);
  pass();
  ASSERT_EQ(matches.back()->state(), panvo_msgs::msg::LandmarkMatch_Constants::MATCHED);
  ASSERT_EQ(corrections.size(), 1U);
  const auto& correction = *corrections[0];
  EXPECT_NE(correction.state(), panvo_msgs::msg::PositionCorrection_Constants::REJECTED) << correction.reason();
  EXPECT_EQ(conversions::to_ns(correction.header().stamp()), 2 * kPeriod_ns);
  EXPECT_EQ(correction.landmark_id(), 2U);
  const auto pose = conversions::to_isometry(correction.landmark_from_base().pose());
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->linear() - Eigen::Matrix3d::Identity()).norm(), 0.01);
}

}  // namespace
}  // namespace panvo::position_corrector
