// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/consistency.hpp"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>

#include "panvo/test/temporary_folder.hpp"
#include "trajectories.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::HasSubstr;
using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr double kDtS = 0.1;

// Correlated and anisotropic, about 1 cm and 1 mrad.
Matrix6d step_covariance() {
  Matrix6d factor = Matrix6d::Zero();
  factor.diagonal() << 0.010, 0.004, 0.006, 0.0005, 0.0010, 0.0020;
  factor(1, 0) = 0.003;
  factor(5, 1) = 0.0012;
  factor(4, 2) = -0.0006;
  return factor * factor.transpose();
}

struct Walk {
  Trajectory estimate{{}, "walk", "test"};
  MotionCovariances covariances;
};

// The true path with each step disturbed by a sample of `step_covariance`. The reported covariance is `claimed` times
// that covariance.
Walk disturbed(const Trajectory& truth, unsigned seed, double claimed = 1.0) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const Matrix6d root = step_covariance().llt().matrixL();
  Walk walk;
  walk.estimate.poses.push_back({truth.poses.front().stamp_ns, make_pose(3, 1, 2, -1.0, 0.2, 0.1)});
  for (std::size_t i = 1; i < truth.poses.size(); ++i) {
    Vector6d sample;
    for (double& value : sample) value = normal(generator);
    const Vector6d error = root * sample;
    Eigen::Isometry3d disturbance = Eigen::Isometry3d::Identity();
    disturbance.linear() = Eigen::AngleAxisd(error.tail<3>().norm(), error.tail<3>().normalized()).toRotationMatrix();
    disturbance.translation() = error.head<3>();
    const Eigen::Isometry3d step = truth.poses[i - 1].world_from_base.inverse() * truth.poses[i].world_from_base;
    walk.estimate.poses.push_back(
        {truth.poses[i].stamp_ns, walk.estimate.poses.back().world_from_base * step * disturbance});
    walk.covariances[truth.poses[i].stamp_ns] = {Matrix6d::Identity(), claimed * step_covariance() / (kDtS * kDtS)};
  }
  return walk;
}

// Turns and climbs, 0.1 s apart.
Trajectory true_path(std::size_t count) {
  Trajectory truth = straight_line(count);
  for (std::size_t i = 1; i < count; ++i) {
    truth.poses[i].world_from_base = truth.poses[i - 1].world_from_base * make_pose(0.8, 0.05, 0.02, 0.04, 0.01, -0.01);
  }
  return truth;
}

TEST(Nees, OfErrorsDrawnFromTheStatedCovarianceIsTheDimension) {
  const Trajectory truth = true_path(5001);
  const Walk walk = disturbed(truth, 1);
  const auto result = consistency(pairs_of(walk.estimate, truth), walk.covariances);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->motion.samples, 5000u);
  EXPECT_EQ(result->unusable, 0u);
  // The standard deviation of the mean is sqrt(2 * 6 / 5000) = 0.049 and sqrt(2 * 3 / 5000) = 0.035.
  EXPECT_NEAR(result->motion.mean, 6.0, 0.15);
  EXPECT_NEAR(result->motion_translation.mean, 3.0, 0.11);
  EXPECT_NEAR(result->motion_rotation.mean, 3.0, 0.11);
  EXPECT_NEAR(result->motion.inside_95, 0.95, 0.012);
  EXPECT_NEAR(result->motion.lower_95, 6.0 - 1.96 * 0.049, 0.005);
  EXPECT_NEAR(result->motion.upper_95, 6.0 + 1.96 * 0.049, 0.005);
}

TEST(Nees, OverSeveralStepsIsTheDimensionToo) {
  const Trajectory truth = true_path(10001);
  const Walk walk = disturbed(truth, 2);
  const auto result = consistency(pairs_of(walk.estimate, truth), walk.covariances, {10, 0.0, 0.0});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->motion.samples, 1000u);
  EXPECT_NEAR(result->motion.mean, 6.0, 0.33);  // three standard deviations of the mean
  EXPECT_NEAR(result->motion_translation.mean, 3.0, 0.24);
  EXPECT_NEAR(result->motion_rotation.mean, 3.0, 0.24);
}

TEST(Nees, TellsOverconfidenceByItsFactor) {
  const Trajectory truth = true_path(2001);
  const Walk walk = disturbed(truth, 3, 0.25);
  const auto result = consistency(pairs_of(walk.estimate, truth), walk.covariances);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->motion.mean, 24.0, 1.0);
  EXPECT_GT(result->motion.mean, result->motion.upper_95);
}

TEST(Nees, OfTheAccumulatedPoseIsMeasuredInOdomAxes) {
  // Error of 0.3 m to the left in odom, independent of the frame of the ground truth; variance 0.01 m^2: 0.3^2 / 0.01 =
  // 9.
  const Trajectory truth = transformed(straight_line(3), make_pose(9, 8, 7, 2.0));
  Trajectory estimate = straight_line(3);
  MotionCovariances covariances;
  for (StampedPose& pose : estimate.poses) {
    Matrix6d pose_covariance = Matrix6d::Identity();
    pose_covariance(1, 1) = 0.01;
    covariances[pose.stamp_ns] = {pose_covariance, Matrix6d::Identity()};
  }
  estimate.poses[1].world_from_base.translation().y() += 0.3;
  estimate.poses[2].world_from_base.translation().y() += 0.3;
  const auto result = consistency(pairs_of(estimate, truth), covariances);
  ASSERT_TRUE(result && result->pose);
  EXPECT_NEAR(result->pose->mean, 9.0, 1e-6);
}

TEST(Nees, OfTheAccumulatedPoseHasItsRotationAboutOdomAxes) {
  // Rotated by 0.3 rad about the y axis of odom; variance 0.01 rad^2 about that axis, 1 about the others: 9.
  const Trajectory truth = transformed(straight_line(3), make_pose(9, 8, 7, 2.0));
  Trajectory estimate = straight_line(3);
  MotionCovariances covariances;
  for (StampedPose& pose : estimate.poses) {
    Matrix6d pose_covariance = Matrix6d::Identity();
    pose_covariance(4, 4) = 0.01;
    covariances[pose.stamp_ns] = {pose_covariance, Matrix6d::Identity()};
  }
  const Eigen::Matrix3d tilted = make_pose(0, 0, 0, 0, 0.3).linear();
  Trajectory turned_truth = truth;
  for (std::size_t i : {1u, 2u}) {
    // The true heading differs by 1 rad from the start, so that the axes of odom and base differ.
    const Eigen::Matrix3d turn = make_pose(0, 0, 0, 1.0).linear();
    turned_truth.poses[i].world_from_base.linear() = truth.poses[0].world_from_base.linear() * turn;
    estimate.poses[i].world_from_base.linear() = tilted * turn;
  }
  const auto result = consistency(pairs_of(estimate, turned_truth), covariances);
  ASSERT_TRUE(result && result->pose);
  EXPECT_NEAR(result->pose->mean, 9.0, 1e-6);
}

// The ground truth is noisy: unless its noise is given, an exact estimate seems overconfident.
TEST(Nees, CountsTheStatedNoiseOfTheGroundTruth) {
  const Trajectory truth = true_path(10001);
  const Walk walk = disturbed(truth, 5);
  Trajectory trembling = truth;
  std::mt19937 generator(6);
  std::normal_distribution<double> normal;
  for (StampedPose& pose : trembling.poses) {
    const Eigen::Vector3d turn = 0.003 * Eigen::Vector3d{normal(generator), normal(generator), normal(generator)};
    const Eigen::Vector3d move = 0.02 * Eigen::Vector3d{normal(generator), normal(generator), normal(generator)};
    pose.world_from_base =
        pose.world_from_base * Eigen::Translation3d(move) * Eigen::AngleAxisd(turn.norm(), turn.normalized());
  }
  const auto pairs = pairs_of(walk.estimate, trembling);
  EXPECT_GT(consistency(pairs, walk.covariances)->motion.mean, 30.0);
  EXPECT_NEAR(consistency(pairs, walk.covariances, {1, 0.02, 0.003})->motion.mean, 6.0, 0.15);
  EXPECT_NEAR(consistency(pairs, walk.covariances, {10, 0.02, 0.003})->motion.mean, 6.0, 0.35);
}

TEST(Nees, LeavesOutStretchesWithoutAUsableCovariance) {
  const Trajectory truth = true_path(101);
  Walk walk = disturbed(truth, 4);
  walk.covariances.erase(truth.poses[10].stamp_ns);
  walk.covariances[truth.poses[20].stamp_ns].twist.setZero();
  walk.covariances[truth.poses[30].stamp_ns].twist(0, 0) = -1.0;  // ROS's "unknown"
  const auto result = consistency(pairs_of(walk.estimate, truth), walk.covariances);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->unusable, 3u);
  EXPECT_EQ(result->motion.samples, 97u);
}

TEST(Nees, IsAbsentIfNoCovarianceIsUsable) {
  const Trajectory truth = true_path(10);
  EXPECT_FALSE(consistency(pairs_of(truth, truth), {}));
}

class MotionCovarianceFile : public ::testing::Test {
 protected:
  static std::string line(const std::string& stamp, const std::string& value = "0.5") {
    std::string text = stamp;
    for (int i = 0; i < 78; ++i) text += "," + (i == 37 ? std::string("7") : value);
    return text + "\n";
  }

  panvo::test::TemporaryFolder folder_;
};

TEST_F(MotionCovarianceFile, IsReadByRowsAfterItsHeader) {
  const auto file = folder_.write("odometry_binocular_covariance.csv", "stamp_ns,p00\n" + line("1700021000040000000"));
  const MotionCovariances covariances = read_motion_covariances(file);
  ASSERT_EQ(covariances.size(), 1u);
  EXPECT_EQ(covariances.begin()->first, 1700021000040000000);
  EXPECT_EQ(covariances.begin()->second.twist(0, 1), 7.0);
  EXPECT_EQ(covariances.begin()->second.twist(1, 0), 0.5);
  EXPECT_EQ(covariances.begin()->second.pose(5, 5), 0.5);
}

TEST_F(MotionCovarianceFile, NamesTheLineOfAFault) {
  const auto broken = folder_.write("nan.csv", "stamp_ns\n" + line("1") + line("2", "nan"));
  EXPECT_THAT(input_error_of([&] { read_motion_covariances(broken); }),
              HasSubstr("nan.csv:3: field 2 is not a finite"));
  const auto few = folder_.write("short.csv", "stamp_ns\n1,2,3\n");
  EXPECT_THAT(input_error_of([&] { read_motion_covariances(few); }), HasSubstr("short.csv:2: 3 fields, 79 expected"));
  const auto twice = folder_.write("twice.csv", "stamp_ns\n" + line("1") + line("1"));
  EXPECT_THAT(input_error_of([&] { read_motion_covariances(twice); }), HasSubstr("twice.csv:3: the stamp 1 occurs"));
}

}  // namespace
}  // namespace panvo::evaluation
