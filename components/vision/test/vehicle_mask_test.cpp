// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/vehicle_mask.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "panvo/vision/angle.hpp"
#include "panvo/vision/seconds.hpp"

namespace panvo::vision {
namespace {

constexpr int kColumns = 1080, kRows = 540;

cv::Mat clutter(std::uint64_t seed) {
  cv::Mat coarse(kRows / 6, kColumns / 6, CV_8UC1), fine;
  cv::RNG(seed).fill(coarse, cv::RNG::UNIFORM, 20, 235);
  cv::resize(coarse, fine, {kColumns, kRows}, 0.0, 0.0, cv::INTER_CUBIC);
  return fine;
}

/// Surroundings turned by the heading, and a mast of 20 degrees.
cv::Mat view(double yaw_rad, bool has_mast, const cv::Mat& around = clutter(1)) {
  static const cv::Mat mast = clutter(2);
  const int shift = static_cast<int>(std::lround(yaw_rad / kDegree * kColumns / 360.0)) % kColumns;
  cv::Mat twice;
  cv::hconcat(around, around, twice);
  cv::Mat turned = twice.colRange(kColumns - shift, 2 * kColumns - shift).clone();
  if (has_mast) mast.colRange(300, 360).copyTo(turned.colRange(300, 360));
  cv::Mat noise(turned.size(), CV_8UC1);
  cv::RNG(static_cast<std::uint64_t>(1000 + shift)).fill(noise, cv::RNG::UNIFORM, 0, 6);
  return turned + noise;
}

/// Turns by 10 degrees a second, with panoramas at 4 Hz.
class Turning {
 public:
  void turn(double by_deg, const std::function<cv::Mat(double)>& view_at) {
    for (const double end_deg = yaw_deg_ + by_deg; yaw_deg_ < end_deg; yaw_deg_ += 2.5) {
      const double yaw_rad = yaw_deg_ * kDegree;
      if (mask.wants(stamp_ns_, yaw_rad)) mask.add(stamp_ns_, view_at(yaw_rad), yaw_rad);
      stamp_ns_ += kSecond_ns / 4;
    }
  }

  VehicleMask mask;

 private:
  double yaw_deg_ = 0.0;
  std::int64_t stamp_ns_ = 1'700'000'000 * kSecond_ns;
};

int covered(const VehicleMask& mask, int first_column, int last_column) {
  const cv::Mat part = mask.seen().colRange(first_column, last_column).rowRange(10, 44);
  return static_cast<int>(part.total()) - cv::countNonZero(part);
}

TEST(VehicleMask, LearnsWhatStaysWhileTheVehicleTurns) {
  Turning vehicle;
  EXPECT_EQ(cv::countNonZero(vehicle.mask.seen()), VehicleMask::kColumns * VehicleMask::kRows);
  vehicle.turn(30.0, [](double yaw) { return view(yaw, true); });
  EXPECT_GT(covered(vehicle.mask, 30, 36), 34 * 6 * 95 / 100) << "the mast";
  EXPECT_LT(covered(vehicle.mask, 0, 28), 34 * 28 / 100);
  EXPECT_LT(covered(vehicle.mask, 38, 108), 34 * 70 / 100);
}

TEST(VehicleMask, LearnsNothingFromSurroundingsAlone) {
  Turning vehicle;
  vehicle.turn(720.0, [](double yaw) { return view(yaw, false); });
  EXPECT_LT(covered(vehicle.mask, 0, 108), 34 * 108 / 200);
}

TEST(VehicleMask, LearnsNothingFromWhatRepeatsAtTheStepsOfTheTurn) {
  cv::Mat windows(kRows, kColumns, CV_8UC1);  // every 2.5 degrees
  for (int column = 0; column < kColumns; ++column) windows.col(column).setTo(column * 10 / 75 % 2 == 0 ? 60 : 180);
  Turning vehicle;
  vehicle.turn(90.0, [&](double yaw) { return view(yaw, false, windows); });
  EXPECT_EQ(covered(vehicle.mask, 0, 108), 0);
}

TEST(VehicleMask, LearnsNothingWhileTheVehicleDoesNotTurn) {
  Turning vehicle;  // whose odometry believes to turn, while the picture stays
  vehicle.turn(360.0, [](double) { return view(0.0, true); });
  EXPECT_EQ(covered(vehicle.mask, 0, 108), 0);
}

TEST(VehicleMask, WantsPanoramasOfTurnsThatAreNotDrift) {
  VehicleMask mask;
  EXPECT_TRUE(mask.wants(0, 0.0));
  mask.add(0, view(0.0, true), 0.0);
  EXPECT_FALSE(mask.wants(kSecond_ns, 1.0 * kDegree));
  EXPECT_TRUE(mask.wants(kSecond_ns, -2.0 * kDegree));
  EXPECT_TRUE(mask.wants(4 * kSecond_ns, 0.0)) << "a younger one to compare with";
  for (int i = 1; i < 20; ++i) mask.add(4 * i * kSecond_ns, view(0.1 * i, true), 2.0 * i * kDegree);
  EXPECT_EQ(covered(mask, 0, 108), 0);
}

TEST(VehicleMask, ForgetsWhatIsTakenOffTheVehicle) {
  Turning vehicle;
  vehicle.turn(60.0, [](double yaw) { return view(yaw, true); });
  EXPECT_GT(covered(vehicle.mask, 30, 36), 0);
  vehicle.turn(60.0, [](double yaw) { return view(yaw, false); });
  EXPECT_EQ(covered(vehicle.mask, 30, 36), 0);
}

TEST(VehicleMask, ForgetsNothingWhereThereIsNothingToSee) {
  Turning vehicle;
  vehicle.turn(60.0, [](double yaw) { return view(yaw, true); });
  const cv::Mat learned = vehicle.mask.seen().clone();
  const cv::Mat fog(kRows, kColumns, CV_8UC1, cv::Scalar(180));
  vehicle.turn(200.0, [&](double yaw) { return view(yaw, false, fog); });
  EXPECT_EQ(cv::countNonZero(vehicle.mask.seen() != learned), 0);
}

TEST(VehicleMask, IsTakenFromAPicture) {
  cv::Mat picture(500, 1000, CV_8UC1, cv::Scalar(255));
  picture.colRange(0, 100).setTo(0);
  const cv::Mat cells = to_cells(picture);
  EXPECT_EQ(cells.size(), cv::Size(VehicleMask::kColumns, VehicleMask::kRows));
  EXPECT_EQ(cv::countNonZero(cells.colRange(0, 11)), 0) << "the eleventh column is in part";
  EXPECT_EQ(cv::countNonZero(cells.colRange(11, 108)), 97 * 54);
}

}  // namespace
}  // namespace panvo::vision
