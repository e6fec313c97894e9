// SPDX-License-Identifier: Apache-2.0
#include "panvo/binocular_odometry/binocular_odometry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "synthetic_scene.hpp"

namespace panvo::binocular_odometry {
namespace {

using ::testing::HasSubstr;

Parameters with_front_end(const std::string& front_end) {
  Parameters parameters;
  parameters.tracking.front_end = front_end;
  return parameters;
}

const std::vector<StereoFrame>& drive() {
  static const std::vector<StereoFrame> frames = SyntheticScene::drive(16);
  return frames;
}

Eigen::Isometry3d truth(int frame) { return SyntheticScene::world_from_left(frame); }

class EitherFrontEnd : public ::testing::TestWithParam<std::string> {};

TEST_P(EitherFrontEnd, FollowsAKnownPath) {
  BinocularOdometry odometry(SyntheticScene::stereo(), with_front_end(GetParam()));
  OdometryEstimate last;
  for (const auto& frame : drive()) {
    last = odometry.step(frame);
    ASSERT_TRUE(last.quality.reliable) << last.quality.reason;
  }
  const Eigen::Isometry3d expected = truth(15);
  EXPECT_LT((last.odom_from_left.translation() - expected.translation()).norm(), 0.006 * expected.translation().norm());
  EXPECT_LT(vision::so3_log(last.odom_from_left.linear() * expected.linear().transpose()).norm(), 0.002);
  EXPECT_GT(last.quality.inlier_ratio, 0.8);
  EXPECT_LT(last.quality.residual_px, 0.5);
}

INSTANTIATE_TEST_SUITE_P(All, EitherFrontEnd, ::testing::Values("klt", "sift"));

/// Arrival stamps, with two images arriving at once now and then.
TEST_P(EitherFrontEnd, FollowsThroughStampsThatJitter) {
  for (const int late : {0, 1, 4}) {
    BinocularOdometry odometry(SyntheticScene::stereo(), with_front_end(GetParam()));
    for (int i = 0; i < 10; ++i) {
      auto frame = drive()[static_cast<size_t>(i)];
      if (i == late) frame.stamp_ns += SyntheticScene::kInterval_ns - 2'000'000;
      const auto estimate = odometry.step(frame);
      ASSERT_TRUE(estimate.quality.reliable) << "frame " << i << ": " << estimate.quality.reason;
      ASSERT_LT((estimate.odom_from_left.translation() - truth(i).translation()).norm(), 0.01) << "frame " << i;
    }
  }
}

TEST(BinocularOdometry, LearnsHowTheRightCameraHasTurned) {
  BinocularOdometry odometry(SyntheticScene::stereo(), {});
  const Eigen::Matrix3d turned = vision::so3_exp({1.0 / 220.0, 0.0, 6e-3});  // row error of one pixel, two on one side
  // Forward, back, forward: the first two passes train the calibration, the third is measured.
  constexpr int kFrames = 40, kThereAndBack = 2 * kFrames - 2;  // no frame twice in a row: repeats count as frozen
  Eigen::Isometry3d began = Eigen::Isometry3d::Identity(), ended = began;
  for (int i = 0; i < kThereAndBack + kFrames; ++i) {
    const int phase = i % kThereAndBack, place = phase < kFrames ? phase : kThereAndBack - phase;
    auto frame = SyntheticScene::frame(place, truth(place), turned);
    frame.stamp_ns = 1 + i * SyntheticScene::kInterval_ns;
    const OdometryEstimate estimate = odometry.step(frame);
    ASSERT_TRUE(estimate.quality.reliable) << estimate.quality.reason;
    if (i == kThereAndBack) began = estimate.odom_from_left;
    ended = estimate.odom_from_left;
  }
  const Eigen::Isometry3d moved = began.inverse() * ended, expected = truth(kFrames - 1);
  EXPECT_LT((moved.translation() - expected.translation()).norm(), 0.005 * expected.translation().norm());
  EXPECT_LT(vision::so3_log(moved.linear() * expected.linear().transpose()).norm(), 0.001);
}

/// Residual rotation between the cameras, which rows do not show and which would shorten the path.
TEST(BinocularOdometry, LearnsWhatAllDisparitiesAreTooLargeBy) {
  constexpr double kOffset_px = 0.5;
  TrackingStage tracking(SyntheticScene::stereo(), {}, nullptr);
  MotionStage motion(SyntheticScene::stereo(), {}, nullptr);
  const Eigen::Matrix3d turned = vision::so3_exp({0.0, kOffset_px / SyntheticScene::stereo().camera.fx, 0.0});
  constexpr int kFrames = 40;
  Eigen::Isometry3d began = Eigen::Isometry3d::Identity(), ended = began;
  for (int i = 0; i < 2 * kFrames - 1; ++i) {
    const int place = i < kFrames ? i : 2 * kFrames - 2 - i;  // no frame twice in a row: repeats count as frozen
    auto frame = SyntheticScene::frame(place, truth(place), turned);
    frame.stamp_ns = 1 + i * SyntheticScene::kInterval_ns;
    const TrackedFrame tracked = tracking.track(frame);
    ended = motion.estimate(tracked).odom_from_left;
    if (i == kFrames - 1) began = ended;
    if (i < kFrames) continue;
    ASSERT_NEAR(tracked.disparity_offset_px, kOffset_px, 0.15)
        << "frame " << i;  // the true offset grows towards the sides
  }
  const Eigen::Isometry3d moved = began.inverse() * ended, expected = truth(kFrames - 1).inverse() * truth(0);
  EXPECT_LT((moved.translation() - expected.translation()).norm(), 0.015 * expected.translation().norm());
}

TEST(BinocularOdometry, BeginsAtTheOriginWithoutUncertainty) {
  BinocularOdometry odometry(SyntheticScene::stereo(), {});
  const OdometryEstimate first = odometry.step(drive()[0]);
  EXPECT_TRUE(first.quality.reliable);
  EXPECT_EQ(first.odom_from_left.matrix(), Eigen::Isometry3d::Identity().matrix());
  EXPECT_EQ(first.odom_from_left_covariance.norm(), 0.0);
}

TEST(BinocularOdometry, IsLessCertainTheFartherItGoes) {
  BinocularOdometry odometry(SyntheticScene::stereo(), {});
  double last = -1.0;
  for (int i = 0; i < 16; i += 5) {
    for (int k = std::max(0, i - 4); k < i; ++k) odometry.step(drive()[static_cast<size_t>(k)]);
    const double now = odometry.step(drive()[static_cast<size_t>(i)]).odom_from_left_covariance.trace();
    EXPECT_GT(now, last);
    last = now;
  }
}

TEST(BinocularOdometry, ItsErrorLiesWithinItsCovariance) {
  BinocularOdometry odometry(SyntheticScene::stereo(), {});
  double nees = 0.0;
  for (int i = 0; i < 16; ++i) {
    const OdometryEstimate estimate = odometry.step(drive()[static_cast<size_t>(i)]);
    if (i == 0) continue;
    const vision::Vector6d error =
        vision::pose_error(estimate.previous_from_current, truth(i - 1).inverse() * truth(i));
    nees += error.dot(estimate.previous_from_current_covariance.ldlt().solve(error)) / 15.0;
  }
  // 6 degrees of freedom. The covariance is tuned for camera noise (kitti_03: 3 to 12); these images are noise-free.
  EXPECT_GT(nees, 0.25);
  EXPECT_LT(nees, 1.5);
}

/// Adds sensor noise to a frame.
StereoFrame noisy(const StereoFrame& frame, double sigma, cv::RNG& random) {
  const auto with_noise = [&](const cv::Mat& image) {
    cv::Mat noise(image.size(), CV_16SC1), result;
    random.fill(noise, cv::RNG::NORMAL, 0.0, sigma);
    cv::add(image, noise, result, cv::noArray(), CV_8U);
    return result;
  };
  return {frame.stamp_ns, with_noise(frame.left), with_noise(frame.right)};
}

TEST(BinocularOdometry, ItsErrorLiesWithinItsCovarianceWhileItStands) {
  constexpr int kSeeds = 5, kFrames = 25;
  double nees = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    cv::RNG random(static_cast<std::uint64_t>(seed));
    BinocularOdometry odometry(SyntheticScene::stereo(), {});
    for (int i = 0; i < kFrames; ++i) {
      StereoFrame frame = noisy(drive()[0], 2.0, random);
      frame.stamp_ns += i * SyntheticScene::kInterval_ns;
      const OdometryEstimate estimate = odometry.step(frame);
      ASSERT_TRUE(estimate.quality.reliable) << estimate.quality.reason;
      if (i == 0) continue;
      const vision::Vector6d error = vision::pose_error(estimate.previous_from_current, Eigen::Isometry3d::Identity());
      nees += error.dot(estimate.previous_from_current_covariance.ldlt().solve(error)) / (kSeeds * (kFrames - 1));
      const vision::Vector6d of_pose = vision::pose_error(estimate.odom_from_left, Eigen::Isometry3d::Identity());
      EXPECT_LT(of_pose.dot(estimate.odom_from_left_covariance.ldlt().solve(of_pose)), 16.8) << "99 % lie below";
    }
  }
  EXPECT_GT(nees, 3.0);
  EXPECT_LT(nees, 12.0);
}

/// Without noise the residuals vanish, and with them the scale of the covariance.
TEST(BinocularOdometry, IsNeverSurerThanTheGreyLevelsAre) {
  BinocularOdometry odometry(SyntheticScene::stereo(), {});
  OdometryEstimate last;
  for (int i = 0; i < 20; ++i) {
    StereoFrame frame = drive()[0];
    frame.stamp_ns += i * SyntheticScene::kInterval_ns;
    frame.left = frame.left.clone();
    frame.right = frame.right.clone();
    frame.left.at<uchar>(0, i) = frame.right.at<uchar>(0, i) = 0;  // avoids the frozen-camera fault
    last = odometry.step(frame);
    ASSERT_TRUE(last.quality.reliable) << last.quality.reason;
  }
  EXPECT_GT(std::sqrt(last.previous_from_current_covariance.topLeftCorner<3, 3>().trace()), 2e-5);
}

TEST(BinocularOdometry, MotionsAddUpToThePose) {
  BinocularOdometry odometry(SyntheticScene::stereo(), {});
  Eigen::Isometry3d sum = Eigen::Isometry3d::Identity(), pose = sum;
  for (int i = 0; i < 8; ++i) {
    const OdometryEstimate estimate = odometry.step(drive()[static_cast<size_t>(i)]);
    sum = sum * estimate.previous_from_current;
    pose = estimate.odom_from_left;
  }
  EXPECT_TRUE(sum.isApprox(pose, 1e-9));
}

// Bounded queue between two threads, as in the runtime.
class Queue {
 public:
  void push(std::optional<TrackedFrame> frame) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return frames_.size() < 2; });
    frames_.push_back(std::move(frame));
    changed_.notify_all();
  }
  std::optional<TrackedFrame> pop() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !frames_.empty(); });
    auto frame = std::move(frames_.front());
    frames_.pop_front();
    changed_.notify_all();
    return frame;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::optional<TrackedFrame>> frames_;
};

TEST(BinocularOdometry, BothStagesInParallelGiveTheSameBitForBit) {
  BinocularOdometry in_turn(SyntheticScene::stereo(), {});
  std::vector<OdometryEstimate> expected;
  for (const auto& frame : drive()) expected.push_back(in_turn.step(frame));

  Queue queue;
  auto motion = std::async(std::launch::async, [&queue] {
    MotionStage stage(SyntheticScene::stereo(), {});
    std::vector<OdometryEstimate> estimates;
    while (const auto frame = queue.pop()) estimates.push_back(stage.estimate(*frame));
    return estimates;
  });
  TrackingStage tracking(SyntheticScene::stereo(), {});
  for (const auto& frame : drive()) queue.push(tracking.track(frame));
  queue.push(std::nullopt);

  const auto estimates = motion.get();
  ASSERT_EQ(estimates.size(), expected.size());
  for (size_t i = 0; i < estimates.size(); ++i) {
    EXPECT_EQ(estimates[i].odom_from_left.matrix(), expected[i].odom_from_left.matrix()) << i;
    EXPECT_EQ(estimates[i].odom_from_left_covariance, expected[i].odom_from_left_covariance) << i;
    EXPECT_EQ(estimates[i].quality.inliers, expected[i].quality.inliers) << i;
  }
}

TEST(BinocularOdometry, CarriesOnWhereTheSceneIsAnotherOne) {
  // A cut: nothing of the last frame is visible. One frame is predicted, then odometry continues from there.
  BinocularOdometry odometry(SyntheticScene::stereo(), {});
  for (int i = 0; i < 6; ++i) odometry.step(drive()[static_cast<size_t>(i)]);
  const auto elsewhere = [](int i) {
    Eigen::Isometry3d turned(vision::so3_exp({0.0, 1.4, 0.0}));
    turned.translation().z() = 4.0;
    return SyntheticScene::frame(i, turned * truth(i - 6));
  };
  const OdometryEstimate at_cut = odometry.step(elsewhere(6));
  EXPECT_FALSE(at_cut.quality.reliable);
  EXPECT_THAT(at_cut.quality.reason, HasSubstr("of 20 needed"));
  const OdometryEstimate after = odometry.step(elsewhere(7));
  EXPECT_TRUE(after.quality.reliable) << after.quality.reason;
  const Eigen::Isometry3d moved = truth(0).inverse() * truth(1);
  EXPECT_LT((after.previous_from_current.translation() - moved.translation()).norm(), 0.01);
}

TEST(BinocularOdometry, FollowsAJerkThatNothingForetold) {
  BinocularOdometry odometry(SyntheticScene::stereo(), {});
  for (int i = 0; i < 6; ++i) odometry.step(drive()[static_cast<size_t>(i)]);
  // 12 degrees to the left within one frame: 47 px, beyond the reach of any pyramid level.
  const Eigen::Isometry3d jerked = truth(6) * Eigen::Isometry3d(vision::so3_exp({0.02, -0.21, 0.0}));
  const OdometryEstimate estimate = odometry.step(SyntheticScene::frame(6, jerked));
  EXPECT_TRUE(estimate.quality.reliable) << estimate.quality.reason;
  EXPECT_LT((estimate.odom_from_left.translation() - jerked.translation()).norm(), 0.015);
  EXPECT_LT(vision::so3_log(estimate.odom_from_left.linear() * jerked.linear().transpose()).norm(), 0.003);
}

TEST(BinocularOdometry, HasOneInlierThresholdForBothStages) {
  Parameters parameters;
  parameters.motion.ransac_threshold_px = 1e-4;  // far below the noise of the tracks
  BinocularOdometry odometry(SyntheticScene::stereo(), parameters);
  odometry.step(drive()[0]);
  EXPECT_EQ(odometry.step(drive()[1]).quality.tracked, 0);
}

TEST(BinocularOdometry, GoesOnThroughAChangeOfLight) {
  BinocularOdometry odometry(SyntheticScene::stereo(), {});
  OdometryEstimate last;
  for (int i = 0; i < 10; ++i) {
    StereoFrame frame = drive()[static_cast<size_t>(i)];
    const double gain = i < 4 ? 1.0 : std::max(0.35, 1.0 - 0.25 * (i - 3));  // sudden cloud
    frame.left.convertTo(frame.left, CV_8U, gain, 5.0);
    frame.right.convertTo(frame.right, CV_8U, 0.95 * gain, 3.0);
    last = odometry.step(frame);
    EXPECT_TRUE(last.quality.reliable) << last.quality.reason;
  }
  EXPECT_LT((last.odom_from_left.translation() - truth(9).translation()).norm(), 0.012);
}

TEST(BinocularOdometry, RefusesACalibrationThatCannotBeUsed) {
  vision::RectifiedStereo stereo = SyntheticScene::stereo();
  stereo.baseline_m = 0.0;
  EXPECT_THROW(BinocularOdometry(stereo, {}), std::invalid_argument);
  EXPECT_THROW(BinocularOdometry(SyntheticScene::stereo(), with_front_end("surf")), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::binocular_odometry
