// SPDX-License-Identifier: Apache-2.0
#include "panvo/binocular_odometry/motion_stage.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/stereo_geometry.hpp"

namespace panvo::binocular_odometry {
namespace {

const vision::RectifiedStereo kStageStereo{{400.0, 400.0, 320.0, 240.0, 640, 480}, 0.12};
constexpr std::int64_t kInterval_ns = 40'000'000;

/// A drive behind a car at constant distance: few near points on road and houses, more far away, and most on the car.
class DriveBehindACar {
 public:
  static constexpr int kAlone = 30, kFrames = 120;  // the car appears after kAlone frames

  static Eigen::Isometry3d world_from_left(int frame) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    const vision::Vector6d twist = (vision::Vector6d() << 0.0, 0.0, 0.12, 0.0, 0.008, 0.0).finished();
    for (int i = 0; i < frame; ++i) pose = pose * vision::se3_exp(twist);
    return pose;
  }

  TrackedFrame frame(int index) {
    const Eigen::Isometry3d left_from_world = world_from_left(index).inverse();
    TrackedFrame tracked;
    tracked.stamp_ns = 1'000'000'000 + index * kInterval_ns;
    const auto see = [&](std::int64_t id, const Eigen::Vector3d& in_left) {
      if (in_left.z() < 2.0) return false;
      const Eigen::Vector3d pixel = vision::observe(kStageStereo, in_left);
      if (pixel.x() < 5.0 || pixel.x() > 635.0 || pixel.y() < 5.0 || pixel.y() > 475.0) return false;
      Observation seen;
      seen.track_id = id;
      seen.pixel = pixel + 0.1 * Eigen::Vector3d{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      seen.sigma_px = seen.sigma_disparity_px = 0.1;
      seen.has_disparity = true;
      tracked.observations.push_back(seen);
      return true;
    };
    for (auto* points : {&near_, &far_}) {
      for (auto& point : *points) {
        while (!see(point.id, left_from_world * point.in_world)) renew(point, index, points == &far_);
      }
    }
    // Each point on the car is lost and redetected after three frames, because it moves differently from the static
    // scene.
    if (index >= kAlone) {
      for (std::size_t i = 0; i < car_.size(); ++i) {
        if ((index + static_cast<int>(i)) % 3 == 0 || index == kAlone) car_[i].id = ++last_id_;
        see(car_[i].id, car_[i].in_world + Eigen::Vector3d(0.0, 0.0, 0.01 * (index - kAlone)));
      }
    }
    std::ranges::sort(tracked.observations, {}, &Observation::track_id);
    tracked.detected = tracked.matched = static_cast<int>(tracked.observations.size());
    tracked.tracked = tracked.detected;
    return tracked;
  }

  /// nullopt: not a point of the static scene.
  std::optional<Eigen::Vector3d> in_world(std::int64_t id) const {
    for (const auto* points : {&near_, &far_}) {
      const auto found = std::ranges::find(*points, id, &Point::id);
      if (found != points->end()) return found->in_world;
    }
    return std::nullopt;
  }

 private:
  struct Point {
    std::int64_t id = 0;
    Eigen::Vector3d in_world{0.0, 0.0, -1.0};
  };

  double uniform(double from, double to) { return from + (to - from) * static_cast<double>(random_() % 100000) / 1e5; }

  void renew(Point& point, int index, bool is_far) {
    const double z = is_far ? uniform(50.0, 90.0) : uniform(5.0, 15.0);
    point.id = ++last_id_;
    point.in_world = world_from_left(index) * Eigen::Vector3d{uniform(-0.7, 0.7) * z, uniform(-0.5, 0.5) * z, z};
  }

  std::mt19937 random_{5};
  std::int64_t last_id_ = 0;
  std::vector<Point> near_{25}, far_{40}, car_ = [this] {
    std::vector<Point> car(60);
    for (auto& point : car) point.in_world = {uniform(-2.5, -0.5), uniform(-0.5, 1.0), uniform(6.0, 7.0)};
    return car;
  }();
};

/// A drive among points on all sides with car-like changes of speed and heading, of which four seconds are lost.
class BlindDrive {
 public:
  enum class Loss { kFaults, kGap };
  static constexpr int kSeen = 40, kBlind = 100;  // frames at 25 Hz

  explicit BlindDrive(unsigned seed) : random_(seed) {
    double speed = uniform(1.0, 9.0), turning = uniform(-0.1, 0.1), target_speed = speed, target_turning = turning;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 2 * kSeen + kBlind; ++i) {
      world_from_left_.push_back(pose);
      if (i % 40 == 39) {  // new target every 1.6 s
        target_speed = uniform(0.0, 10.0);
        target_turning = uniform(0.0, 1.0) < 0.3 ? uniform(-0.5, 0.5) : uniform(-0.05, 0.05);
      }
      speed += std::clamp(target_speed - speed, -3.0 * kSecond, 2.0 * kSecond);
      turning += std::clamp(target_turning - turning, -0.5 * kSecond, 0.5 * kSecond);
      pose = pose * vision::se3_exp((vision::Vector6d() << 0.0, 0.0, speed, 0.0, turning, 0.0).finished() * kSecond);
    }
  }

  /// The estimates of all frames that are passed to the stage.
  std::vector<OdometryEstimate> run(Loss loss) {
    MotionStage stage(kStageStereo, {}, nullptr);
    std::vector<OdometryEstimate> estimates;
    for (int i = 0; i < 2 * kSeen + kBlind; ++i) {
      const bool is_blind = i >= kSeen && i < kSeen + kBlind;
      if (is_blind && loss == Loss::kGap) continue;
      TrackedFrame frame;
      if (is_blind) {
        frame.stamp_ns = stamp_ns(i);
        frame.fault = "left image is black";
      } else {
        frame = seen(i);
      }
      estimates.push_back(stage.estimate(frame));
    }
    return estimates;
  }

  static std::int64_t stamp_ns(int index) { return 1'000'000'000 + index * kInterval_ns; }
  const Eigen::Isometry3d& world_from_left(std::int64_t at_ns) const {
    return world_from_left_[static_cast<std::size_t>((at_ns - stamp_ns(0)) / kInterval_ns)];
  }

 private:
  static constexpr double kSecond = 1e-9 * kInterval_ns;  // per frame
  static constexpr int kPoints = 80;

  double uniform(double from, double to) { return from + (to - from) * static_cast<double>(random_() % 100000) / 1e5; }

  TrackedFrame seen(int index) {
    if (index == kSeen + kBlind) points_.clear();  // tracks end with the loss
    TrackedFrame frame;
    frame.stamp_ns = stamp_ns(index);
    const auto& pose = world_from_left_[static_cast<std::size_t>(index)];
    std::erase_if(points_, [&](const auto& point) { return !is_in_view(pose.inverse() * point.second); });
    while (points_.size() < kPoints) {
      const double z = uniform(4.0, 40.0);
      points_[++last_id_] = pose * Eigen::Vector3d{uniform(-0.7, 0.7) * z, uniform(-0.5, 0.5) * z, z};
    }
    for (const auto& [id, in_world] : points_) {
      Observation observation;
      observation.track_id = id;
      observation.pixel = vision::observe(kStageStereo, pose.inverse() * in_world) +
                          0.2 * Eigen::Vector3d{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      observation.sigma_px = observation.sigma_disparity_px = 0.12;
      observation.has_disparity = true;
      frame.observations.push_back(observation);
    }
    frame.detected = frame.matched = frame.tracked = kPoints;
    return frame;
  }

  static bool is_in_view(const Eigen::Vector3d& in_left) {
    return in_left.z() > 2.0 && std::abs(in_left.x()) < 0.78 * in_left.z() &&
           std::abs(in_left.y()) < 0.58 * in_left.z();
  }

  std::mt19937 random_;
  std::vector<Eigen::Isometry3d> world_from_left_;
  std::map<std::int64_t, Eigen::Vector3d> points_;
  std::int64_t last_id_ = 0;
};

double sigma_m(const OdometryEstimate& estimate) {
  return std::sqrt(estimate.odom_from_left_covariance.topLeftCorner<3, 3>().trace());
}

TEST(MotionStage, IsAsUncertainAfterFramesThatShowNothingAsAfterAGap) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    BlindDrive drive(seed);
    const auto faults = drive.run(BlindDrive::Loss::kFaults), gap = BlindDrive(seed).run(BlindDrive::Loss::kGap);
    EXPECT_NEAR(sigma_m(faults.back()), sigma_m(gap.back()), 0.1 * sigma_m(gap.back()));
    EXPECT_GT(sigma_m(faults.back()), 5.0);
    EXPECT_LT(sigma_m(faults.back()), 50.0);
  }
}

TEST(MotionStage, StaysUncertainWhenItSeesAgain) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    BlindDrive drive(seed);
    double last_m = 0.0;
    for (const auto& estimate : drive.run(BlindDrive::Loss::kFaults)) {
      // further observations refine the last keyframes slightly
      EXPECT_GT(sigma_m(estimate), last_m - 0.01) << "seed " << seed << ", " << estimate.stamp_ns;
      last_m = sigma_m(estimate);
    }
  }
}

TEST(MotionStage, ItsErrorLiesWithinItsCovarianceAfterFourSecondsThatShowNothing) {
  constexpr int kSeeds = 40;
  Eigen::Matrix<double, 2, 6> level = Eigen::Matrix<double, 2, 6>::Zero();  // sideways and forward
  level(0, 0) = level(1, 2) = 1.0;
  for (const auto loss : {BlindDrive::Loss::kFaults, BlindDrive::Loss::kGap}) {
    double nees = 0.0, worst = 0.0;
    for (unsigned seed = 1; seed <= kSeeds; ++seed) {
      BlindDrive drive(seed);
      double of_drive = 0.0;
      const auto estimates = drive.run(loss);
      for (const auto& estimate : estimates) {
        if (estimate.stamp_ns < BlindDrive::stamp_ns(BlindDrive::kSeen)) continue;
        const vision::Vector6d error =
            vision::pose_error(drive.world_from_left(BlindDrive::stamp_ns(0)).inverse() * estimate.odom_from_left,
                               drive.world_from_left(estimate.stamp_ns));
        const Eigen::Vector2d position = level * error;
        of_drive =
            position.dot((level * estimate.odom_from_left_covariance * level.transpose()).ldlt().solve(position));
        worst = std::max(worst, std::sqrt(of_drive));
      }
      EXPECT_TRUE(estimates.back().quality.reliable) << estimates.back().quality.reason;
      nees += of_drive / kSeeds;
    }
    EXPECT_LT(worst, 3.0);
    EXPECT_GT(nees, 0.1);  // expected 2; most drives change less than the model allows
    EXPECT_LT(nees, 4.0);
  }
}

TEST(MotionStage, IsNotTakenAlongByACarThatMostOfThePointsAreOn) {
  DriveBehindACar drive;
  MotionStage stage(kStageStereo, {}, nullptr);
  for (int i = 0; i < DriveBehindACar::kFrames; ++i) {
    const auto estimate = stage.estimate(drive.frame(i));
    ASSERT_TRUE(i == 0 || estimate.quality.reliable) << i << ": " << estimate.quality.reason;
    const Eigen::Isometry3d error = DriveBehindACar::world_from_left(i).inverse() * estimate.odom_from_left;
    ASSERT_LT(error.translation().norm(), 0.05 + 0.02 * 0.12 * i) << "frame " << i;
  }
}

TEST(MotionStage, KnowsThePointsOfTheStaticSceneAndWhereTheyAre) {
  DriveBehindACar drive;
  MotionStage stage(kStageStereo, {}, nullptr);
  EXPECT_TRUE(stage.points().empty());
  int inliers = 0;
  for (int i = 0; i < DriveBehindACar::kFrames; ++i) {
    const TrackedFrame frame = drive.frame(i);
    const auto estimate = stage.estimate(frame);
    const auto points = stage.points();
    ASSERT_EQ(points.size(), frame.observations.size());
    for (std::size_t at = 0; at < points.size(); ++at) {
      EXPECT_EQ(points[at].track_id, frame.observations[at].track_id);
      EXPECT_EQ(points[at].pixel, frame.observations[at].pixel.head<2>());
      const auto truth = drive.in_world(points[at].track_id);
      if (points[at].state == ScenePoint::State::kOutlier) {
        EXPECT_FALSE(truth) << "only the car contradicts the motion";
      }
      if (points[at].state != ScenePoint::State::kInlier) continue;
      ++inliers;
      ASSERT_TRUE(truth) << "a point on the car is labelled as an inlier";
      ASSERT_TRUE(points[at].in_odom);
      const Eigen::Isometry3d left_from_world = DriveBehindACar::world_from_left(i).inverse();
      const double depth_m = (left_from_world * *truth).z();
      const double sigma_m =
          0.1 * depth_m * depth_m / (kStageStereo.camera.fx * kStageStereo.baseline_m);  // 0.1 px of disparity
      const Eigen::Vector3d error = left_from_world * *truth - estimate.odom_from_left.inverse() * *points[at].in_odom;
      EXPECT_LT(error.norm(), 0.1 + 4.0 * sigma_m) << "frame " << i << ", depth " << depth_m;
    }
  }
  EXPECT_GT(inliers, 60 * 100) << "most of the 65 points, in most of the 120 frames";
}

TEST(MotionStage, StatesALargerLeanForASmallerRig) {
  const auto stated = [](double focal_length_px, double baseline_m) {
    vision::RectifiedStereo stereo = kStageStereo;
    stereo.camera.fx = stereo.camera.fy = focal_length_px;
    stereo.baseline_m = baseline_m;
    return MotionStage(stereo, {}).estimate(TrackedFrame{}).quality.lean_sigma_rad_per_m;
  };
  const double error_px = MotionParameters{}.rectification_error_px;
  EXPECT_NEAR(stated(400.0, 0.12), error_px / 48.0, 1e-12);
  EXPECT_NEAR(stated(250.0, 0.06), error_px / 15.0, 1e-12);
}

TEST(MotionStage, StatesALargerLeanWhereMorePointsContradictTheMotion) {
  DriveBehindACar drive;
  const MotionParameters parameters;
  MotionStage stage(kStageStereo, parameters, nullptr);
  const double of_calibration = parameters.rectification_error_px / 48.0;
  double outliers = 0.0;
  for (int i = 0; i < DriveBehindACar::kFrames; ++i) {
    const auto quality = stage.estimate(drive.frame(i)).quality;
    if (i > 0) outliers += 1.0 - quality.inlier_ratio;
    const double by_outliers = parameters.outlier_lean_rad_per_m * outliers / std::max(i, 1);  // each step is as long
    EXPECT_NEAR(quality.lean_sigma_rad_per_m, std::hypot(of_calibration, by_outliers), 0.02 * by_outliers + 1e-12) << i;
    if (i < DriveBehindACar::kAlone) {
      EXPECT_LT(quality.lean_sigma_rad_per_m, 1.2 * of_calibration) << i;
    }
  }
  const auto beside_the_car = stage.estimate(drive.frame(DriveBehindACar::kFrames)).quality;
  EXPECT_GT(beside_the_car.lean_sigma_rad_per_m, 10.0 * of_calibration);
}

// Begun with just as many points as it needs, it loses the second image, and does not know the vehicle's speed in between.
TEST(MotionStage, BeginsWithMorePointsThanItNeeds) {
  constexpr double kSmall_m2 = 0.05 * 0.05;
  const MotionParameters parameters;
  DriveBehindACar drive;
  MotionStage stage(kStageStereo, parameters, nullptr);
  TrackedFrame poor = drive.frame(0);
  poor.observations.resize(static_cast<std::size_t>(parameters.min_inliers));
  poor.matched = parameters.min_inliers;
  EXPECT_FALSE(stage.estimate(poor).quality.reliable);
  TrackedFrame second = drive.frame(1);
  second.observations.erase(second.observations.begin());
  stage.estimate(second);
  const auto third = stage.estimate(drive.frame(2));
  EXPECT_TRUE(third.quality.reliable) << third.quality.reason;
  EXPECT_LT(third.odom_from_left_covariance.diagonal().head<3>().maxCoeff(), kSmall_m2);
}

TEST(MotionStage, HasNoPointsWithoutAMotion) {
  DriveBehindACar drive;
  MotionStage stage(kStageStereo, {}, nullptr);
  stage.estimate(drive.frame(0));
  TrackedFrame black;
  black.stamp_ns = drive.frame(1).stamp_ns;
  black.fault = "black";
  stage.estimate(black);
  EXPECT_TRUE(stage.points().empty());
}

}  // namespace
}  // namespace panvo::binocular_odometry
