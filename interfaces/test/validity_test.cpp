// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/validity.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "panvo/interfaces/check.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "std_msgs/msg/String.h"

namespace panvo::interfaces {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using Covariance = std::array<double, 36>;

Covariance diagonal(const std::array<double, 6>& variances) {
  Covariance covariance{};
  for (std::size_t i = 0; i < 6; ++i) covariance[7 * i] = variances[i];
  return covariance;
}

std::string problem_of_covariance(const Covariance& covariance) {
  return Check().covariance("covariance", covariance).problem().value_or("");
}

template <class Message>
std::string problem(const Message& message) {
  return problem_of(message).value_or("");
}

nav_msgs::msg::Odometry odometry() {
  nav_msgs::msg::Odometry message;
  message.header().frame_id("odom");
  message.pose().covariance(diagonal({1, 1, 1, 0.1, 0.1, 0.1}));
  return message;
}

panvo_msgs::msg::PanoramicLandmark landmark() {
  panvo_msgs::msg::PanoramicLandmark message;
  message.id(1);
  message.settings("histogram_bins=4\npatches=400\nseed=1\n");
  message.histogram({0.25F, 0.25F, 0.25F, 0.25F});
  panvo_msgs::msg::AdaptiveFeature feature;
  feature.row(799);
  feature.scale(0.1F);
  feature.weight(0.5F);
  message.large_features({feature, feature});
  message.small_features({feature});
  panvo_msgs::msg::LandmarkKeypoint keypoint;
  keypoint.bearing({0.0F, 0.0F, 1.0F});
  message.keypoints({keypoint});
  return message;
}

sensor_msgs::msg::Image image(const std::string& encoding, std::uint32_t width, std::uint32_t height,
                              std::uint32_t step) {
  sensor_msgs::msg::Image message;
  message.encoding(encoding);
  message.width(width);
  message.height(height);
  message.step(step);
  message.data().resize(std::size_t{step} * height);
  return message;
}

sensor_msgs::msg::CameraInfo camera_info() {
  sensor_msgs::msg::CameraInfo message;
  message.width(640);
  message.height(480);
  message.k({500, 0, 320, 0, 500, 240, 0, 0, 1});
  message.r({1, 0, 0, 0, 1, 0, 0, 0, 1});
  message.p({500, 0, 320, -100, 0, 500, 240, 0, 0, 0, 1, 0});
  return message;
}

TEST(Covariance, OfZerosSaysThatNothingIsKnown) { EXPECT_EQ(problem_of_covariance({}), ""); }

TEST(Covariance, MayMixMetresRadiansAndWhatIsNotKnown) {
  EXPECT_EQ(problem_of_covariance(diagonal({1e-4, 1e-4, 1e12, 1e-8, 1e-8, 1e6})), "");
  EXPECT_EQ(problem_of_covariance(diagonal({1e-4, 1e-4, 0, 0, 0, 1e-6})), "") << "a vehicle in the plane";
}

TEST(Covariance, OfAKnownDirectionIsSemidefinite) {
  Covariance covariance{};  // of a position along the line (1, 2), without variance across it
  covariance[0] = 1;
  covariance[1] = covariance[6] = 2;
  covariance[7] = 4;
  EXPECT_EQ(problem_of_covariance(covariance), "");
  covariance[1] = covariance[6] = 2.01;
  EXPECT_EQ(problem_of_covariance(covariance), "covariance is not positive semidefinite");
}

TEST(Covariance, IsRefusedWhereASmallPartIsIndefiniteBesideAHugeOne) {
  Covariance covariance = diagonal({1e6, 1e6, 1e6, 1e-6, 1e-6, 1e-6});
  covariance[3 * 6 + 4] = covariance[4 * 6 + 3] = 2e-6;
  EXPECT_EQ(problem_of_covariance(covariance), "covariance is not positive semidefinite");
}

TEST(Covariance, IsRefusedForEachRuleItBreaks) {
  EXPECT_EQ(problem_of_covariance(diagonal({1, 1, 1, 1, -0.1, 1})), "covariance has a negative variance");
  EXPECT_EQ(problem_of_covariance(diagonal({1, 1, kNaN, 1, 1, 1})), "covariance is not finite");
  EXPECT_EQ(problem_of_covariance(diagonal({1, 1, 1e308, 1, 1, 1})), "covariance has a variance above 1e+15");
  Covariance covariance = diagonal({1, 1, 1, 1, 1, 1});
  covariance[1] = 0.5;
  EXPECT_EQ(problem_of_covariance(covariance), "covariance is not symmetric");
  covariance = diagonal({0, 1, 1, 1, 1, 1});
  covariance[1] = covariance[6] = 0.5;
  EXPECT_EQ(problem_of_covariance(covariance), "covariance is not positive semidefinite");
}

TEST(Covariance, OfAMeasurementHasVariances) {
  const auto problem_of_measured = [](const Covariance& covariance) {
    return Check().measured_covariance("covariance", covariance).problem().value_or("");
  };
  EXPECT_EQ(problem_of_measured(diagonal({1, 1, 1, 1, 1, 1e-12})), "");
  EXPECT_EQ(problem_of_measured(diagonal({1, 1, 1, 1, 1, 1e-300})), "covariance has a variance below 1e-12");
  EXPECT_EQ(problem_of_measured({}), "covariance has a variance below 1e-12");
}

TEST(Validity, IsReachedThroughTheMessageType) {
  auto message = odometry();
  const auto& type = message_type<nav_msgs::msg::Odometry>();
  EXPECT_EQ(type.problem(&message), std::nullopt);
  message.pose().covariance()[3] = kNaN;
  EXPECT_EQ(type.problem(&message), "pose.covariance is not finite");
  EXPECT_EQ(message_type<std_msgs::msg::String>().problem, nullptr) << "any text is valid";
}

TEST(Validity, IsDeclaredForEveryMessageOfOurs) {
  for (const MessageType* type : message_types()) {
    const bool is_part = type->name == "panvo_msgs/msg/AdaptiveFeature" ||
                         type->name == "panvo_msgs/msg/LandmarkKeypoint" ||
                         type->name == "panvo_msgs/msg/PointTracks" || type->name == "panvo_msgs/msg/TrackedPoint";
    const bool is_ours = type->name.starts_with("panvo_msgs/msg/");
    EXPECT_TRUE(!is_ours || is_part || type->problem != nullptr) << type->name;
  }
}

TEST(Validity, OfOdometryNeedsAPoseThatAVehicleCanHave) {
  EXPECT_EQ(problem(odometry()), "");
  auto message = odometry();
  message.pose().pose().position().x(1e200);
  EXPECT_EQ(problem(message), "pose.pose.position is beyond +-1e+08");
  message = odometry();
  message.pose().pose().position().z(kNaN);
  EXPECT_EQ(problem(message), "pose.pose.position is not finite");
  message = odometry();
  message.pose().pose().orientation().w(0.0);
  EXPECT_EQ(problem(message), "pose.pose.orientation is not a unit quaternion");
  message = odometry();
  message.header().stamp().nanosec(1'000'000'000);
  EXPECT_EQ(problem(message), "header.stamp has a nanosec of 1e+09 or more");
  message = odometry();
  message.child_frame_id(std::string(257, 'x'));
  EXPECT_EQ(problem(message), "child_frame_id is longer than 256");
  message = odometry();
  message.twist().twist().linear().x(std::numeric_limits<double>::infinity());
  EXPECT_EQ(problem(message), "twist.twist.linear is not finite");
}

TEST(Validity, OfOdometryLeavesATwistThatIsNotKnownAlone) {
  auto message = odometry();
  message.twist().covariance()[0] = -1.0;
  EXPECT_EQ(problem(message), "");
}

TEST(Validity, OfATwistIsThatOfOdometry) {
  geometry_msgs::msg::TwistWithCovarianceStamped message;
  EXPECT_EQ(problem(message), "");
  message.twist().covariance()[0] = -1.0;
  EXPECT_EQ(problem(message), "");
  message.twist().twist().linear().x(NAN);
  EXPECT_EQ(problem(message), "twist.twist.linear is not finite");
}

TEST(Validity, OfALandmarkNeedsRowsWithinTheMatrixOfItsSettings) {
  EXPECT_EQ(problem(landmark()), "");
  for (const std::uint16_t row : {800, 65535}) {
    auto message = landmark();
    message.large_features()[1].row(row);
    EXPECT_EQ(problem(message), "large_features.row is not a row of the measurement matrix");
    message = landmark();
    message.small_features()[0].row(row);
    EXPECT_EQ(problem(message), "small_features.row is not a row of the measurement matrix");
    message.settings("seed=1\n");  // no number of rows: the maximum applies
    EXPECT_EQ(problem(message).empty(), row == 800);
  }
}

TEST(Validity, OfALandmarkNeedsAsManyBinsAsItsSettingsSay) {
  auto message = landmark();
  message.histogram({1.0F});
  EXPECT_EQ(problem(message), "histogram does not have as many bins as the settings specify");
  message.histogram({0.5F, 0.5F, 0.5F, -0.5F});
  EXPECT_EQ(problem(message), "histogram has negative values or does not sum to 1");
  message.histogram({0.5F, 0.5F, 0.5F, 0.5F});
  EXPECT_EQ(problem(message), "histogram has negative values or does not sum to 1");
}

TEST(Validity, OfALandmarkNeedsFeaturesAndKeypointsThatAreSome) {
  auto message = landmark();
  message.large_features()[1].weight(0.6F);
  EXPECT_EQ(problem(message), "large_features.weight is not in descending order");
  message = landmark();
  message.large_features()[0].value(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(problem(message), "large_features.value is beyond +-1e+06 or not finite");
  message = landmark();
  message.small_features()[0].scale(-1.0F);
  EXPECT_EQ(problem(message), "small_features.scale is negative, above 1e+06 or not finite");
  message = landmark();
  message.keypoints()[0].bearing({0.0F, 0.0F, 2.0F});
  EXPECT_EQ(problem(message), "keypoints.bearing is not a unit vector");
  message = landmark();
  message.keypoints()[0].has_point(true);
  message.keypoints()[0].inverse_range_sigma(-1.0F);
  EXPECT_EQ(problem(message), "keypoints.inverse_range_sigma is negative, above 1e+06 or not finite");
  message = landmark();
  message.pose().pose().position().x(kNaN);
  EXPECT_EQ(problem(message), "pose.pose.position is not finite");
  message = landmark();
  message.id(0);
  EXPECT_EQ(problem(message), "id is 0");
  message.id(4'000'000'001);
  EXPECT_EQ(problem(message), "id is above 4000000000");
}

TEST(Validity, OfLandmarkPosesNeedsOnePoseForEachId) {
  panvo_msgs::msg::LandmarkPoses message;
  message.ids({1, 2});
  message.poses().resize(1);
  EXPECT_EQ(problem(message), "poses differ in number from ids");
  message.poses().resize(2);
  EXPECT_EQ(problem(message), "");
  message.poses()[1].covariance()[0] = -1.0;
  EXPECT_EQ(problem(message), "poses.covariance has a negative variance");
}

TEST(Validity, OfAnInitialPoseNeedsAPlaceOnEarthAndACovariance) {
  geometry_msgs::msg::PoseWithCovarianceStamped message;
  EXPECT_EQ(problem(message), "");
  message.pose().covariance(diagonal({1e308, 1, 1, 1, 1, 1}));
  EXPECT_EQ(problem(message), "pose.covariance has a variance above 1e+15");
  message.pose().covariance({});
  message.pose().pose().position().y(1e200);
  EXPECT_EQ(problem(message), "pose.pose.position is beyond +-1e+08");
}

TEST(Validity, OfTheCompassNeedsAVarianceThatAPanoramaCanGive) {
  panvo_msgs::msg::AzimuthChange message;
  message.valid(true);
  message.variance_rad2(1e-6);
  EXPECT_EQ(problem(message), "");
  message.variance_rad2(1e-300);
  EXPECT_EQ(problem(message), "variance_rad2 is not between 1e-12 and 1000");
  message.valid(false);
  EXPECT_EQ(problem(message), "") << "not used as a measurement";
}

TEST(Validity, OfTheCompassNeedsADirectionThatIsAnAngleOrNotKnown) {
  panvo_msgs::msg::AzimuthChange message;
  message.valid(true);
  message.variance_rad2(1e-6);
  message.motion_azimuth_rad(3.0);
  message.motion_azimuth_variance_rad2(0.5);
  EXPECT_EQ(problem(message), "");
  message.motion_azimuth_variance_rad2(-1e-3);
  EXPECT_EQ(problem(message), "motion_azimuth_variance_rad2 is not between 0 and 1000");
  message.motion_azimuth_variance_rad2(0.0);
  message.motion_azimuth_rad(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(problem(message), "motion_azimuth_rad is not finite");
}

TEST(Validity, OfPointsInAPanoramaNeedsBearingsOfUnitLength) {
  panvo_msgs::msg::PanoramaPoints message;
  EXPECT_EQ(problem(message), "") << "no motion can be seen";
  panvo_msgs::msg::TrackedPoint point;
  point.then().x(1.0);
  point.now().y(-1.0);
  point.azimuth_variance_rad2(1e-6);
  point.elevation_variance_rad2(1e-6);
  message.now_from_then().w(1.0);
  message.tracks().resize(1);
  message.tracks()[0].points() = {point, point};
  EXPECT_EQ(problem(message), "");
  message.tracks()[0].points()[1].now().z(0.1);
  EXPECT_EQ(problem(message), "tracks.points.now is not a unit vector");
  message.tracks()[0].points()[1].now().z(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(problem(message), "tracks.points.now is not a unit vector");
  message.tracks()[0].points()[1] = point;
  message.tracks()[0].points()[1].elevation_variance_rad2(0.0);
  EXPECT_EQ(problem(message), "tracks.points.elevation_variance_rad2 is not between 1e-12 and 1000");
  message.tracks()[0].points().pop_back();
  message.now_from_then().w(0.5);
  EXPECT_NE(problem(message), "");
}

TEST(Validity, KnowsWhichStampsAreOfTheTimeOfSending) {
  EXPECT_TRUE(find_message_type("nav_msgs/msg/Odometry")->is_stamped_when_sent);
  EXPECT_TRUE(find_message_type("panvo_msgs/msg/AzimuthChange")->is_stamped_when_sent);
  EXPECT_FALSE(find_message_type("panvo_msgs/msg/LandmarkMatch")->is_stamped_when_sent);
  EXPECT_FALSE(find_message_type("panvo_msgs/msg/PositionCorrection")->is_stamped_when_sent);
  EXPECT_FALSE(find_message_type("geometry_msgs/msg/PoseWithCovarianceStamped")->is_stamped_when_sent);
}

TEST(Validity, OfACorrectionNeedsAnUncertaintyUnlessItIsRejected) {
  panvo_msgs::msg::PositionCorrection message;
  message.state(panvo_msgs::msg::PositionCorrection_Constants::FULL);
  message.landmark_from_base().covariance(diagonal({1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(problem(message), "");
  message.landmark_from_base().covariance()[1] = message.landmark_from_base().covariance()[6] = 2.0;
  EXPECT_EQ(problem(message), "landmark_from_base.covariance is not positive semidefinite");
  message.landmark_from_base().covariance({});
  EXPECT_EQ(problem(message), "landmark_from_base.covariance has a variance below 1e-12");
  message.state(panvo_msgs::msg::PositionCorrection_Constants::REJECTED);
  EXPECT_EQ(problem(message), "");
}

TEST(Validity, OfAnImageNeedsAKnownEncodingAndAllItsRows) {
  for (const auto& [encoding, bytes] : std::vector<std::pair<std::string, std::uint32_t>>{{"mono8", 1},
                                                                                          {"bgr8", 3},
                                                                                          {"16UC1", 2},
                                                                                          {"bayer_rggb8", 1},
                                                                                          {"32FC4", 16},
                                                                                          {"yuv422_yuy2", 2},
                                                                                          {"rgba16", 8}}) {
    EXPECT_EQ(problem(image(encoding, 10, 4, 10 * bytes + 6)), "") << encoding;
    EXPECT_EQ(problem(image(encoding, 10, 4, 10 * bytes - 1)), "step is too small for a row") << encoding;
  }
  auto message = image("mono8", 10, 4, 12);
  message.data().resize(46);  // the last row may lack its padding
  EXPECT_EQ(problem(message), "");
  message.data().resize(45);
  EXPECT_EQ(problem(message), "data is shorter than height rows of step bytes");
  for (const auto* encoding : {"", "jpeg", "8UC5", "8UC0", "16U", "64FC12", "mono88"}) {
    EXPECT_EQ(problem(image(encoding, 10, 4, 100)), "encoding is not in sensor_msgs/image_encodings") << encoding;
  }
  message = image("mono8", 1, 1, 1);
  message.height(0xFFFFFFFF);
  EXPECT_EQ(problem(message), "width or height exceeds 65536 px");
  message.height(0);
  EXPECT_EQ(problem(message), "width or height is 0");
}

TEST(Validity, OfACameraNeedsNumbersThatALensCanHave) {
  EXPECT_EQ(problem(camera_info()), "");
  EXPECT_EQ(problem(sensor_msgs::msg::CameraInfo()), "") << "not calibrated";
  auto message = camera_info();
  message.k()[0] = 1e300;
  EXPECT_EQ(problem(message), "k is beyond +-1e+06");
  message = camera_info();
  message.p()[3] = -1e300;
  EXPECT_EQ(problem(message), "p is beyond +-500000");
  message = camera_info();
  message.r()[1] = 1.0;
  EXPECT_EQ(problem(message), "r is not a rotation matrix");
  message = camera_info();
  message.d({kNaN});
  EXPECT_EQ(problem(message), "d is not finite");
}

TEST(Validity, OfAnImuLeavesOutWhatItSaysItDoesNotMeasure) {
  sensor_msgs::msg::Imu message;
  message.orientation().w(0.0);
  EXPECT_EQ(problem(message), "orientation is not a unit quaternion");
  message.orientation_covariance()[0] = -1.0;
  EXPECT_EQ(problem(message), "");
  message.angular_velocity().x(kNaN);
  EXPECT_EQ(problem(message), "angular_velocity is not finite");
}

TEST(Validity, OfAPointCloudNeedsAllItsRows) {
  sensor_msgs::msg::PointCloud2 message;
  message.width(0xFFFFFFFF);
  message.height(0xFFFFFFFF);
  message.point_step(0xFFFFFFFF);
  message.row_step(0xFFFFFFFF);
  EXPECT_EQ(problem(message), "row_step is too small for width points");
  message.width(1);
  EXPECT_EQ(problem(message), "data is shorter than height rows of row_step bytes");
}

TEST(Validity, OfOneTransformDoesNotSpeakForTheOthers) {
  tf2_msgs::msg::TFMessage message;
  message.transforms().resize(2);
  message.transforms()[1].transform().translation().x(kNaN);
  EXPECT_EQ(problem(message), "");
  EXPECT_EQ(problem(message.transforms()[0]), "");
  EXPECT_EQ(problem(message.transforms()[1]), "transform.translation is not finite");
}

}  // namespace
}  // namespace panvo::interfaces
