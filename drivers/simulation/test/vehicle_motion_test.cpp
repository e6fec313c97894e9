// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/vehicle_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace panvo::simulation {

using simulated_world::Terrain;

namespace {

DrivenPath turning_path() {
  return drive(simulated_world::campus_roads(1), {"test", {"gymnasium", "laboratory", "dormitory"}, ""});
}

double heading_of(const Eigen::Isometry3d& pose) { return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)); }

TEST(VehicleMotion, TwistIsTheDerivativeOfThePose) {
  const VehicleMotion motion(turning_path(), Terrain(1, 1.0), {}, 1);
  for (double t = 0.5; t < motion.duration_s() - 0.5; t += 0.317) {
    constexpr double kApart_s = 1e-3;
    const Eigen::Isometry3d before = motion.world_from_base(t - kApart_s), after = motion.world_from_base(t + kApart_s);
    const Eigen::Matrix3d base_from_world = motion.world_from_base(t).linear().transpose();
    const Eigen::Vector3d velocity = base_from_world * (after.translation() - before.translation()) / (2.0 * kApart_s);
    const Eigen::Vector3d rate = vision::so3_log(before.linear().transpose() * after.linear()) / (2.0 * kApart_s);
    const vision::Vector6d twist = motion.twist(t);
    EXPECT_LT((twist.head<3>() - velocity).norm(), 1e-4) << t;
    EXPECT_LT((twist.tail<3>() - rate).norm(), 1e-4) << t;
  }
}

TEST(VehicleMotion, IsTwiceDifferentiable) {
  MotionParameters parameters;
  parameters.vibration = 0.0;  // its jerk would mask that of the path
  const VehicleMotion motion(turning_path(), Terrain(1, 1.0), parameters, 1);
  const auto acceleration = [&](double t) -> Eigen::Vector3d {
    constexpr double kApart_s = 2e-3;
    return (motion.world_from_base(t + kApart_s).translation() - 2.0 * motion.world_from_base(t).translation() +
            motion.world_from_base(t - kApart_s).translation()) /
           (kApart_s * kApart_s);
  };
  for (double t = 0.5; t < motion.duration_s() - 0.5; t += 0.01) {
    ASSERT_LT((acceleration(t + 0.01) - acceleration(t)).norm(), 0.15) << t;
  }
}

TEST(VehicleMotion, KeepsToItsLimits) {
  const MotionParameters parameters;
  const DrivenPath path = turning_path();
  const VehicleMotion motion(path, Terrain(1, 0.0), parameters, 1);
  double fastest = 0.0, slowest_in_turn = 1e9;
  for (double t = 0.0; t + 0.01 < motion.duration_s(); t += 0.01) {
    const double speed = motion.speed_m_per_s(t);
    ASSERT_LT(std::abs(motion.speed_m_per_s(t + 0.01) - speed) / 0.01, 1.02 * parameters.acceleration_m_per_s2) << t;
    fastest = std::max(fastest, speed);
    const auto i = static_cast<std::size_t>(motion.travelled_m(t) / path.along_m.back() *
                                            static_cast<double>(path.points.size() - 1));
    if (std::abs(path.curvature_per_m[i]) > 0.11) {
      slowest_in_turn = std::min(slowest_in_turn, speed);
      EXPECT_LT(speed * speed * std::abs(path.curvature_per_m[i]), 1.3 * parameters.turn_acceleration_m_per_s2) << t;
    }
  }
  EXPECT_NEAR(fastest, parameters.cruise_speed_m_per_s, 1e-3);
  EXPECT_GT(slowest_in_turn, parameters.min_speed_m_per_s - 0.01);
  EXPECT_LT(slowest_in_turn, 3.6);
}

TEST(VehicleMotion, StandsFirstAndStopsAtTheEndOfItsPath) {
  const DrivenPath path = turning_path();
  const VehicleMotion motion(path, Terrain(1, 0.5), {}, 1);
  EXPECT_TRUE(motion.world_from_base(0.0).isApprox(motion.world_from_base(0.95), 1e-12));
  EXPECT_LT((motion.world_from_base(0.0).translation().head<2>() - path.points.front()).norm(), 1e-6);
  const Eigen::Vector2d end = motion.world_from_base(motion.duration_s()).translation().head<2>();
  EXPECT_LT((end - path.points.back()).norm(), 1e-3);
  EXPECT_NEAR(motion.travelled_m(motion.duration_s()), path.along_m.back(), 1e-6);
  EXPECT_LT(motion.twist(0.5).norm(), 1e-9);
  EXPECT_LT(motion.twist(motion.duration_s()).norm(), 1e-6);
  EXPECT_TRUE(motion.world_from_base(-5.0).isApprox(motion.world_from_base(0.0)));
}

TEST(VehicleMotion, FollowsItsPathAndTheLand) {
  const DrivenPath path = turning_path();
  const Terrain terrain(3, 1.0);
  MotionParameters parameters;
  parameters.vibration = 0.0;
  const VehicleMotion motion(path, terrain, parameters, 1);
  for (double t = 0.0; t < motion.duration_s(); t += 0.5) {
    const Eigen::Isometry3d pose = motion.world_from_base(t);
    const auto i = static_cast<std::size_t>(motion.travelled_m(t) / path.along_m.back() *
                                            static_cast<double>(path.points.size() - 1));
    EXPECT_LT((pose.translation().head<2>() - path.points[i]).norm(), 0.11);
    EXPECT_NEAR(pose.translation().z(), terrain.height_m(pose.translation().head<2>()), 0.01);
    EXPECT_GT(pose.linear().col(2).dot(terrain.normal(pose.translation().head<2>())), std::cos(0.005));
    const vision::Vector6d twist = motion.twist(t);
    EXPECT_NEAR(twist[0], motion.speed_m_per_s(t), 0.01);  // forward only, except for the terrain's curvature
    EXPECT_NEAR(twist[1], 0.0, 0.02);
  }
}

TEST(VehicleMotion, VibratesAsMuchAsAskedForAndNotAtAllAtRest) {
  DrivenPath path;
  for (int i = 0; i <= 5000; ++i) {
    path.points.emplace_back(0.1 * i, 0.0);
    path.along_m.push_back(0.1 * i);
    path.curvature_per_m.push_back(0.0);
  }
  const MotionParameters parameters;
  const VehicleMotion motion(path, Terrain(1, 0.0), parameters, 5);
  double height = 0.0, pitch = 0.0, roll = 0.0;
  int count = 0;
  for (double t = 20.0; t < 80.0; t += 0.013, ++count) {
    const Eigen::Isometry3d pose = motion.world_from_base(t);
    EXPECT_NEAR(heading_of(pose), 0.0, 1e-9);
    height += std::pow(pose.translation().z(), 2);
    pitch += std::pow(std::asin(pose.linear()(2, 0)), 2);
    roll += std::pow(std::asin(pose.linear()(2, 1)), 2);
  }
  EXPECT_NEAR(std::sqrt(height / count), parameters.height_rms_m, 0.1 * parameters.height_rms_m);
  EXPECT_NEAR(std::sqrt(pitch / count), parameters.pitch_rms_rad, 0.1 * parameters.pitch_rms_rad);
  EXPECT_NEAR(std::sqrt(roll / count), parameters.roll_rms_rad, 0.1 * parameters.roll_rms_rad);
  EXPECT_EQ(motion.world_from_base(0.5).translation().z(), 0.0);
}

TEST(VehicleMotion, TurnsInPlaceAtItsRateAndDrivesOnlyForward) {
  const DrivenPath path = drive(simulated_world::campus_roads(1),
                                {"test", {"gymnasium", "laboratory", "dormitory"}, ""}, 0.0, Steering::kDifferential);
  ASSERT_FALSE(path.turns_in_place.empty());
  MotionParameters parameters;
  parameters.vibration = 0.0;
  const VehicleMotion motion(path, Terrain(1, 0.0), parameters, 1);
  double turned_standing = 0.0, turned_driving = 0.0, fastest = 0.0;
  constexpr double kStep_s = 0.01;
  for (double t = kStep_s; t + kStep_s < motion.duration_s(); t += kStep_s) {
    const Eigen::Isometry3d moved = motion.world_from_base(t - kStep_s).inverse() * motion.world_from_base(t);
    const double turned = heading_of(moved), speed = moved.translation().norm() / kStep_s;
    EXPECT_NEAR(moved.translation().x(), moved.translation().norm(), 1e-6);
    fastest = std::max(fastest, std::abs(turned) / kStep_s);
    (speed < 1e-9 ? turned_standing : turned_driving) += turned;
  }
  const auto way = [&](std::size_t from) -> Eigen::Vector2d { return path.points[from + 1] - path.points[from]; };
  double expected = 0.0;
  for (const std::size_t i : path.turns_in_place) {
    const Eigen::Vector2d in = way(i - 1), out = way(i);
    expected += std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
  }
  EXPECT_GT(std::abs(expected), 1.0);
  EXPECT_NEAR(turned_standing, expected, 0.01);
  EXPECT_LT(std::abs(turned_driving), 0.3);  // the roads are curved
  EXPECT_NEAR(fastest, parameters.turn_rate_rad_per_s, 0.02);
  const Eigen::Vector2d end = motion.world_from_base(motion.duration_s()).translation().head<2>();
  EXPECT_LT((end - path.points.back()).norm(), 1e-3);
}

TEST(VehicleMotion, RefusesWhatMakesNoSense) {
  MotionParameters slow;
  slow.cruise_speed_m_per_s = 2.0;
  EXPECT_THROW(VehicleMotion(turning_path(), Terrain(1, 0.0), slow, 1), std::invalid_argument);
  EXPECT_THROW(VehicleMotion(DrivenPath{}, Terrain(1, 0.0), {}, 1), std::invalid_argument);
  DrivenPath uneven = turning_path();
  uneven.along_m[5] += 1.0;
  EXPECT_THROW(VehicleMotion(uneven, Terrain(1, 0.0), {}, 1), std::invalid_argument);
  DrivenPath outside = turning_path();
  outside.turns_in_place = {outside.points.size()};
  EXPECT_THROW(VehicleMotion(outside, Terrain(1, 0.0), {}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::simulation
