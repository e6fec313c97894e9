// SPDX-License-Identifier: Apache-2.0
// Effects of bad frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "panvo/binocular_odometry/binocular_odometry.hpp"
#include "synthetic_scene.hpp"

namespace panvo::binocular_odometry {
namespace {

using ::testing::HasSubstr;

const std::vector<StereoFrame>& seven_frames() {
  static const std::vector<StereoFrame> frames = SyntheticScene::drive(16);
  return frames;
}

Eigen::Isometry3d scene_truth(int frame) { return SyntheticScene::world_from_left(frame); }

// One bad frame among good ones: marked unreliable with the reason, predicted with the last motion, recovered by the
// next frame.
class BadFrame : public ::testing::Test {
 protected:
  void expect_fault(StereoFrame bad, const std::string& reason) {
    BinocularOdometry odometry(SyntheticScene::stereo(), {});
    OdometryEstimate before;
    for (int i = 0; i < 6; ++i) before = odometry.step(seven_frames()[static_cast<size_t>(i)]);
    const OdometryEstimate during = odometry.step(bad);
    EXPECT_FALSE(during.quality.reliable);
    EXPECT_THAT(during.quality.reason, HasSubstr(reason));
    EXPECT_TRUE(during.odom_from_left.matrix().allFinite());
    EXPECT_TRUE(during.odom_from_left_covariance.allFinite());
    EXPECT_GT(during.odom_from_left_covariance.trace(), before.odom_from_left_covariance.trace());
    EXPECT_FALSE(during.previous_from_current.isApprox(Eigen::Isometry3d::Identity(), 1e-3));
    EXPECT_LT((during.odom_from_left.translation() - scene_truth(6).translation()).norm(), 0.05);
    OdometryEstimate after;
    for (int i = 7; i < 10; ++i) {
      after = odometry.step(seven_frames()[static_cast<size_t>(i)]);
      EXPECT_TRUE(after.quality.reliable) << i << ": " << after.quality.reason;
    }
    EXPECT_LT((after.odom_from_left.translation() - scene_truth(9).translation()).norm(), 0.012);
  }

  StereoFrame frame_ = seven_frames()[6];
};

TEST_F(BadFrame, Empty) {
  frame_.right = cv::Mat();
  expect_fault(frame_, "right image is empty");
}

TEST_F(BadFrame, Black) {
  frame_.left = cv::Mat(240, 320, CV_8UC1, cv::Scalar(0));
  expect_fault(frame_, "left image is black");
}

TEST_F(BadFrame, Constant) {
  frame_.left = cv::Mat(240, 320, CV_8UC1, cv::Scalar(127));
  expect_fault(frame_, "left image is constant");
}

TEST_F(BadFrame, Saturated) {
  frame_.right = cv::Mat(240, 320, CV_8UC1, cv::Scalar(255));
  expect_fault(frame_, "right image is saturated");
}

TEST_F(BadFrame, OfAnotherSize) {
  cv::resize(frame_.left, frame_.left, {160, 120});
  expect_fault(frame_, "left image is 160 x 120 px, the calibration is for 320 x 240 px");
}

TEST_F(BadFrame, LeftAndRightExchanged) {
  std::swap(frame_.left, frame_.right);
  expect_fault(frame_, "swapped");
}

TEST_F(BadFrame, LeftCameraHangs) {
  frame_.left = seven_frames()[5].left;
  expect_fault(frame_, "left camera repeats its image (frozen)");
}

TEST_F(BadFrame, RightCameraHangs) {
  frame_.right = seven_frames()[5].right;
  expect_fault(frame_, "right camera repeats its image (frozen)");
}

TEST_F(BadFrame, BothCamerasHang) {
  frame_.left = seven_frames()[5].left;
  frame_.right = seven_frames()[5].right;
  expect_fault(frame_, "both cameras repeat their images (frozen)");
}

TEST_F(BadFrame, BothEyesAreOne) {
  frame_.right = frame_.left.clone();
  expect_fault(frame_, "left and right images are identical");
}

/// Stalled decoder whose images differ slightly.
TEST_F(BadFrame, RightEyeIsOfAnotherMoment) {
  frame_.right = seven_frames()[0].right;
  expect_fault(frame_, "left and right images do not match");
}

/// Frames of earlier times among good ones at 5 m/s: no effect on pose and motion of the next.
class LateFrames : public ::testing::Test {
 protected:
  static StereoFrame frame(int index) {
    StereoFrame frame = seven_frames()[static_cast<size_t>(index)];
    frame.stamp_ns = 1'000'000'000 + index * 24'000'000;  // 0.12 m each
    return frame;
  }

  void go_on_to(int last) {
    for (; next_ <= last; ++next_) {
      estimate_ = odometry_.step(frame(next_));
      ASSERT_TRUE(estimate_.quality.reliable) << next_ << ": " << estimate_.quality.reason;
      const Eigen::Isometry3d step = scene_truth(std::max(0, next_ - 1)).inverse() * scene_truth(next_);
      EXPECT_LE((estimate_.previous_from_current.translation() - step.translation()).norm(),
                0.05 * step.translation().norm())
          << next_;
      EXPECT_LT((estimate_.odom_from_left.translation() - scene_truth(next_).translation()).norm(), 0.012) << next_;
      EXPECT_LT(estimate_.previous_from_current_covariance.diagonal().head<3>().maxCoeff(), 0.01 * 0.01) << next_;
    }
  }

  void expect_no_effect_of(const StereoFrame& late) {
    const OdometryEstimate during = odometry_.step(late);
    EXPECT_FALSE(during.quality.reliable);
    EXPECT_THAT(during.quality.reason, HasSubstr("is not later than the previous stamp"));
    EXPECT_EQ(during.odom_from_left.matrix(), estimate_.odom_from_left.matrix()) << "no jump";
    EXPECT_EQ(during.odom_from_left_covariance, estimate_.odom_from_left_covariance);
  }

  BinocularOdometry odometry_{SyntheticScene::stereo(), {}};
  OdometryEstimate estimate_;
  int next_ = 0;
};

TEST_F(LateFrames, OneThatComesTwice) {
  go_on_to(6);
  expect_no_effect_of(frame(6));
  go_on_to(10);
}

TEST_F(LateFrames, OneThatIsOvertaken) {
  go_on_to(6);
  expect_no_effect_of(frame(5));
  go_on_to(10);
}

TEST_F(LateFrames, SeveralInARow) {
  go_on_to(6);
  for (int late = 4; late <= 6; ++late) expect_no_effect_of(frame(late));
  go_on_to(10);
}

/// One of the time before, as of a clock that was set back, among them.
TEST_F(LateFrames, AfterOneThatIsVeryLate) {
  go_on_to(6);
  StereoFrame very_late = frame(5);
  very_late.stamp_ns -= 900'000'000;
  expect_no_effect_of(very_late);
  expect_no_effect_of(frame(6));
  go_on_to(10);
}

TEST_F(LateFrames, BlackOnesAfterASetClockAreNoLateFrames) {
  go_on_to(6);
  const auto step_black = [&](int index, std::int64_t back_ns) {
    StereoFrame black = frame(index);
    black.left = cv::Mat(240, 320, CV_8UC1, cv::Scalar(0));
    black.stamp_ns -= back_ns;
    return odometry_.step(black);
  };
  step_black(7, 900'000'000);
  const auto first = step_black(8, 900'000'000), second = step_black(9, 900'000'000);
  EXPECT_THAT(second.quality.reason, HasSubstr("left image is black"));
  EXPECT_GT(first.odom_from_left_covariance.trace(), estimate_.odom_from_left_covariance.trace());
  EXPECT_GT(second.odom_from_left_covariance.trace(), first.odom_from_left_covariance.trace());
}

/// As of a recording that is played again from an earlier time.
TEST_F(LateFrames, OnesOfAnotherPlaceAfterASetClockTellThatTheVehicleMayHaveBeenMoved) {
  const auto sigma_m = [&] { return std::sqrt(estimate_.odom_from_left_covariance.diagonal().head<3>().maxCoeff()); };
  for (const bool is_elsewhere : {false, true}) {
    odometry_ = BinocularOdometry(SyntheticScene::stereo(), {});
    next_ = 0;
    go_on_to(5);
    for (int i = 6; i < 12; ++i) {
      StereoFrame set = frame(i);
      set.stamp_ns -= 900'000'000;
      if (is_elsewhere) {
        cv::Mat left, right;
        cv::flip(set.left, left, 0);
        cv::flip(set.right, right, 0);
        set.left = left;
        set.right = right;
      }
      estimate_ = odometry_.step(set);
    }
    EXPECT_TRUE(estimate_.quality.reliable) << "again";
    if (is_elsewhere) {
      EXPECT_GT(sigma_m(), 5.0);
    } else {
      EXPECT_LT(sigma_m(), 0.02) << "the images match";
    }
  }
}

/// Online calibration must not depend on the content of a bad frame.
TEST(BinocularOdometry, LearnsNothingFromABadFrame) {
  const auto learned_with = [](const StereoFrame& sixth) {
    TrackingStage tracking(SyntheticScene::stereo(), {});
    for (int i = 0; i < 6; ++i) tracking.track(seven_frames()[static_cast<size_t>(i)]);
    EXPECT_FALSE(tracking.track(sixth).fault.empty());
    return tracking.track(seven_frames()[7]);
  };
  StereoFrame black = seven_frames()[6], exchanged = black, apart = black;
  black.left = cv::Mat(black.left.size(), CV_8UC1, cv::Scalar(0));
  std::swap(exchanged.left, exchanged.right);
  apart.right = seven_frames()[0].right;
  const TrackedFrame expected = learned_with(black);
  for (const auto& bad : {exchanged, apart}) {
    const TrackedFrame after = learned_with(bad);
    EXPECT_EQ(after.disparity_offset_px, expected.disparity_offset_px);
    ASSERT_EQ(after.observations.size(), expected.observations.size());
    for (size_t i = 0; i < after.observations.size(); ++i) {
      EXPECT_EQ(after.observations[i].pixel, expected.observations[i].pixel);
    }
  }
}

/// The time since the last good frame must not depend on the stamp of a bad frame, even if the clock jumps back.
TEST(BinocularOdometry, ForgetsTheStampOfABadFrame) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const auto tracked_after = [](StereoFrame bad) {
    TrackingStage tracking(SyntheticScene::stereo(), {});
    for (int i = 0; i < 6; ++i) tracking.track(seven_frames()[static_cast<size_t>(i)]);
    bad.stamp_ns += 60 * kSecond_ns;
    EXPECT_FALSE(tracking.track(bad).fault.empty());
    std::vector<TrackedFrame> after;
    for (size_t i = 6; i < 10; ++i) {
      StereoFrame earlier = seven_frames()[i];
      earlier.stamp_ns -= kSecond_ns;
      after.push_back(tracking.track(earlier));
    }
    EXPECT_FALSE(after.front().fault.empty()) << "the first frame after the jump is lost";
    return after;
  };
  StereoFrame black = seven_frames()[6], exchanged = black;
  black.left = cv::Mat(black.left.size(), CV_8UC1, cv::Scalar(0));
  std::swap(exchanged.left, exchanged.right);
  const auto expected = tracked_after(black), found = tracked_after(exchanged);
  for (size_t k = 1; k < expected.size(); ++k) {
    EXPECT_EQ(found[k].tracked, expected[k].tracked) << k;
    ASSERT_EQ(found[k].observations.size(), expected[k].observations.size()) << k;
    for (size_t i = 0; i < expected[k].observations.size(); ++i) {
      EXPECT_EQ(found[k].observations[i].pixel, expected[k].observations[i].pixel) << k;
    }
  }
}

/// Counts how often a stage begins; by default, that of the motion search.
struct Attempts : vision::StageObserver {
  explicit Attempts(std::string_view counted_stage = "match_widely") : counted(counted_stage) {}
  void enter(std::string_view stage) override { count += stage == counted ? 1 : 0; }
  void leave() override {}
  std::string_view counted;
  int count = 0;
};

TEST(BinocularOdometry, ExpectsNoTurnThatItOnlyGuessed) {
  Attempts attempts;
  TrackingStage tracking(SyntheticScene::stereo(), {}, &attempts);
  for (int i = 0; i < 6; ++i) tracking.track(seven_frames()[static_cast<size_t>(i)]);
  const auto elsewhere = [](int i) {
    return SyntheticScene::frame(i, Eigen::Isometry3d(vision::so3_exp({0.0, 1.4, 0.0})) * scene_truth(i - 6));
  };
  attempts.count = 0;
  tracking.track(elsewhere(6));
  ASSERT_GT(attempts.count, 1) << "tracking should be lost and retry";
  attempts.count = 0;
  tracking.track(elsewhere(7));
  EXPECT_EQ(attempts.count, 1);
}

TEST(BinocularOdometry, SparesTheSlowMatchingWhileTheCamerasAreOutOfOrder) {
  Attempts descriptors("match_descriptors");
  TrackingStage tracking(SyntheticScene::stereo(), {}, &descriptors);
  for (int i = 0; i < 6; ++i) tracking.track(seven_frames()[static_cast<size_t>(i)]);
  const std::int64_t step_ns = 40'000'000, begin_ns = seven_frames()[5].stamp_ns;
  StereoFrame frame = SyntheticScene::frame(6, Eigen::Isometry3d(vision::so3_exp({0.0, 1.4, 0.0})));
  std::swap(frame.left, frame.right);
  for (int i = 1; i <= 50; ++i) {  // 2 s
    frame.stamp_ns = begin_ns + i * step_ns;
    for (cv::Mat* image : {&frame.left, &frame.right}) image->at<uchar>(0, 0) = static_cast<uchar>(i);  // not frozen
    EXPECT_FALSE(tracking.track(frame).fault.empty());
  }
  EXPECT_GE(descriptors.count, 5 + 3) << "it goes on trying";
  EXPECT_LE(descriptors.count, 5 + 4);
}

TEST(BinocularOdometry, SaysFromTheFirstFrameOnThatTheCamerasAreExchanged) {
  BinocularOdometry odometry(SyntheticScene::stereo(), {});
  for (int i = 0; i < 3; ++i) {
    StereoFrame frame = seven_frames()[static_cast<size_t>(i)];
    std::swap(frame.left, frame.right);
    const OdometryEstimate estimate = odometry.step(frame);
    EXPECT_FALSE(estimate.quality.reliable);
    EXPECT_THAT(estimate.quality.reason, HasSubstr("swapped"));
  }
}

}  // namespace
}  // namespace panvo::binocular_odometry
