// SPDX-License-Identifier: Apache-2.0
// A stereo odometry that is restarted with another origin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "panvo/odometry_fusion/odometry_fusion.hpp"

namespace panvo::odometry_fusion {
namespace {

constexpr std::int64_t kFrame_ns = 40'000'000;
constexpr double kFrame_m = 0.2;  // 5 m/s
constexpr double kFrame_variance = 1e-4;

/// Straight ahead at 5 m/s.
class Restarted {
 public:
  explicit Restarted(bool grows = true) : grows_(grows) { say(); }

  void go(double way_m) {
    for (int i = 0; i < std::lround(way_m / kFrame_m); ++i) go_on();
  }

  void go_on() {
    move();
    EXPECT_TRUE(fusion_.add(stereo_));
    collect();
  }

  void pause(double time_s) { stereo_.stamp_ns += std::llround(1e9 * time_s); }

  void restart(double gap_s) {
    stereo_.odom_from_base.setIdentity();
    stereo_.covariance.setZero();
    move(gap_s);
    stereo_.odom_from_base.setIdentity();
    EXPECT_TRUE(fusion_.add(stereo_));
    const bool is_measured = fused_.is_reliable;
    collect();
    is_told_ = is_measured && !fused_.is_reliable;
  }

  void jump(double by_m) {
    stereo_.odom_from_base.translation().x() += by_m;
    go_on();
  }

  void set_clock_back(bool is_restarted_too = false) {
    stereo_.stamp_ns -= 10'000'000'000;
    if (is_restarted_too) stereo_.odom_from_base.setIdentity();
    constexpr int kRefused = 5;
    for (int i = 0; i < kRefused; ++i) move();
    EXPECT_TRUE(fusion_.begin_again(stereo_, kRefused));
    collect();
  }

  void say_an_empty_pose() {
    const StereoPose right = stereo_;
    move();
    stereo_.odom_from_base.setIdentity();
    stereo_.covariance.setZero();
    EXPECT_TRUE(fusion_.add(stereo_));
    collect();
    const std::int64_t stamp_ns = stereo_.stamp_ns;
    stereo_ = right;
    stereo_.stamp_ns = stamp_ns;
    stereo_.odom_from_base.translation().x() += kFrame_m;
  }

  double error_m() const { return (fused_.odom_from_base.translation() - Eigen::Vector3d(driven_m_, 0.0, 0.0)).norm(); }
  double sigma_m() const { return std::sqrt(fused_.covariance(0, 0)); }
  bool is_told() const { return is_told_; }

 private:
  void move(double gap_s = 0.0) {
    const double way_m = kFrame_m + 5.0 * gap_s;
    driven_m_ += way_m;
    stereo_.stamp_ns += kFrame_ns + std::llround(1e9 * gap_s);
    stereo_.odom_from_base.translation().x() += way_m;
    say();
  }

  void say() {
    if (grows_) {
      stereo_.covariance += kFrame_variance * vision::Matrix6d::Identity();
    } else {
      stereo_.covariance = 0.01 * vision::Matrix6d::Identity();
    }
  }

  void collect() {
    while (const auto fused = fusion_.next()) fused_ = *fused;
  }

  const bool grows_;
  OdometryFusion fusion_{{}};
  StereoPose stereo_{.stamp_ns = 1'000'000'000'000};
  FusedPose fused_;
  double driven_m_ = 0.0;
  bool is_told_ = false;
};

/// The way, after which the stereo odometry is restarted, and the pause.
void expect_no_jump(double way_m, double gap_s, bool grows, bool has_set_clock) {
  const std::string which = std::to_string(way_m) + " m from the origin, after " + std::to_string(gap_s) + " s" +
                            (grows ? "" : ", constant covariance") + (has_set_clock ? ", after a set clock" : "");
  Restarted drive(grows);
  if (has_set_clock) {
    drive.go(20.0);
    drive.set_clock_back();
    way_m -= 21.0;
  }
  drive.go(way_m);
  const double error_m = drive.error_m();
  drive.restart(gap_s);
  EXPECT_TRUE(drive.is_told()) << which;
  EXPECT_LT(std::abs(drive.error_m() - error_m), 0.1) << which;
  drive.go(4.0);
  EXPECT_LT(std::abs(drive.error_m() - error_m), 0.1) << which;
  EXPECT_GT(drive.sigma_m(), 0.1 * gap_s) << which << ": the pause was not measured";
}

TEST(RestartedStereoOdometry, IsNotTakenForMotion) {
  for (const double gap_s : {0.1, 1.0, 3.0}) {
    for (const double way_m : {6.0, 12.0, 25.0, 100.0, 1000.0}) expect_no_jump(way_m, gap_s, true, false);
    for (const double way_m : {27.0, 100.0, 1000.0}) expect_no_jump(way_m, gap_s, true, true);
  }
}

TEST(RestartedStereoOdometry, IsNotTakenForMotionIfItIsOutOfReachWhateverItsCovariance) {
  for (const bool has_set_clock : {false, true}) {
    expect_no_jump(27.0, 0.1, false, has_set_clock);
    for (const double gap_s : {0.1, 1.0, 3.0}) expect_no_jump(1000.0, gap_s, false, has_set_clock);
  }
}

TEST(RestartedStereoOdometry, IsNotTakenForMotionOfAClockThatIsSetAfterAPause) {
  Restarted drive(false);
  drive.go(1000.0);
  drive.pause(3600.0);
  drive.go(8.0);
  ASSERT_LT(drive.error_m(), 0.1);
  drive.set_clock_back(true);
  EXPECT_LT(drive.error_m(), 6 * kFrame_m + 0.1) << "it stays where it was";
}

TEST(JumpingStereoOdometry, IsNotTakenForMotionOfWhichNoVehicleIsCapable) {
  Restarted odometry;
  odometry.go(20.0);
  odometry.jump(4.0);  // 105 m/s
  EXPECT_LT(odometry.error_m(), 0.5);
  odometry.go(20.0);
  EXPECT_LT(odometry.error_m(), 0.5);
}

TEST(RestartedStereoOdometry, IsNoSingleWrongPose) {
  for (const double way_m : {2.0, 5.0, 12.0, 100.0}) {
    Restarted drive;
    drive.go(way_m);
    drive.say_an_empty_pose();
    EXPECT_LT(drive.error_m(), 0.1) << way_m;
    drive.go(4.0);
    EXPECT_LT(drive.error_m(), 0.1) << way_m;
  }
}

/// Driven 30 m away from the origin and back, twice, the fused path is that of the stereo odometry.
template <class Covariance>
double deviation_m(const Covariance& covariance, double gap_s) {
  OdometryFusion fusion({});
  double time_s = 0.0, largest_m = 0.0;
  for (int i = 0; i < 800; ++i) {
    time_s += 0.04 + (i % 75 == 60 ? gap_s : 0.0);
    const double share = 0.5 - 0.5 * std::cos(2.0 * M_PI * time_s / 16.0);
    StereoPose stereo{.stamp_ns = later(0, time_s)};
    stereo.odom_from_base.translation().x() = 30.0 * share;
    stereo.odom_from_base.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 2.0 * share));
    stereo.covariance = covariance(i) * vision::Matrix6d::Identity();
    EXPECT_TRUE(fusion.add(stereo));
    const auto fused = fusion.next();
    EXPECT_TRUE(fused && fused->is_reliable) << i;
    if (!fused) return 1e9;
    const Eigen::Vector3d off = fused->odom_from_base.translation() - stereo.odom_from_base.translation();
    largest_m = std::max(largest_m, off.norm());
  }
  return largest_m;
}

TEST(RestartedStereoOdometry, IsNoneOfAnySortOfCovariance) {
  for (const double gap_s : {0.0, 3.0}) {
    EXPECT_LT(deviation_m([](int i) { return 1e-4 * (i + 1); }, gap_s), 0.05) << "grows";
    EXPECT_LT(deviation_m([](int) { return 1e-2; }, gap_s), 0.05) << "is constant";
    EXPECT_LT(deviation_m([](int i) { return 1e-4 * (i % 40 + 1); }, gap_s), 0.05) << "shrinks as loops are closed";
    EXPECT_LT(deviation_m([](int i) { return i % 2 == 0 ? 1e-5 : 1e-2; }, gap_s), 0.05) << "is of each step";
  }
}

}  // namespace
}  // namespace panvo::odometry_fusion
