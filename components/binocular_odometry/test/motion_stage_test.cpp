// SPDX-License-Identifier: Apache-2.0
#include "panvo/binocular_odometry/motion_stage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/stereo_geometry.hpp"

namespace panvo::binocular_odometry {
namespace {

const vision::RectifiedStereo kStereo{{400.0, 400.0, 320.0, 240.0, 640, 480}, 0.12};
constexpr std::int64_t kInterval_ns = 40'000'000;

/// A drive behind a car: few points of the road and the houses near by, more far away, and most on the car, which keeps its distance.
class DriveBehindACar {
 public:
  static constexpr int kAlone = 30, kFrames = 120;  // the car comes in between

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
      const Eigen::Vector3d pixel = vision::observe(kStereo, in_left);
      if (pixel.x() < 5.0 || pixel.x() > 635.0 || pixel.y() < 5.0 || pixel.y() > 475.0) return false;
      Observation seen;
      seen.track_id = id;
      seen.pixel = pixel + 0.1 * Eigen::Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
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
    // On the car each point is found anew after three frames: it moves otherwise than what stands still, and is lost.
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

 private:
  struct Point {
    std::int64_t id = 0;
    Eigen::Vector3d in_world{0.0, 0.0, -1.0};
  };

  double uniform(double from, double to) { return from + (to - from) * static_cast<double>(random_() % 100000) / 1e5; }

  void renew(Point& point, int index, bool is_far) {
    const double z = is_far ? uniform(50.0, 90.0) : uniform(5.0, 15.0);
    point.id = ++last_id_;
    point.in_world = world_from_left(index) * Eigen::Vector3d(uniform(-0.7, 0.7) * z, uniform(-0.5, 0.5) * z, z);
  }

  std::mt19937 random_{5};
  std::int64_t last_id_ = 0;
  std::vector<Point> near_{25}, far_{40}, car_ = [this] {
    std::vector<Point> car(60);
    for (auto& point : car) point.in_world = {uniform(-2.5, -0.5), uniform(-0.5, 1.0), uniform(6.0, 7.0)};
    return car;
  }();
};

TEST(MotionStage, IsNotTakenAlongByACarThatMostOfThePointsAreOn) {
  DriveBehindACar drive;
  MotionStage stage(kStereo, {}, nullptr);
  for (int i = 0; i < DriveBehindACar::kFrames; ++i) {
    const auto estimate = stage.estimate(drive.frame(i));
    ASSERT_TRUE(i == 0 || estimate.quality.reliable) << i << ": " << estimate.quality.reason;
    const Eigen::Isometry3d error = DriveBehindACar::world_from_left(i).inverse() * estimate.odom_from_left;
    ASSERT_LT(error.translation().norm(), 0.05 + 0.02 * 0.12 * i) << "frame " << i;
  }
}

}  // namespace
}  // namespace panvo::binocular_odometry
