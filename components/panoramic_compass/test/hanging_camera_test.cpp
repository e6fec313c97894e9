// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "painted_panorama.hpp"
#include "panvo/panoramic_compass/panoramic_compass.hpp"

/// A camera that hangs upside down, as below a drone or an overhanging roof.
namespace panvo::panoramic_compass {
namespace {

/// Half a turn about the direction of view: left and right, sky and ground change places. Row 0 is the zenith itself.
cv::Mat as_seen_hanging(const cv::Mat& upright) {
  cv::Mat hanging(upright.size(), upright.type());
  for (int row = 0; row < kRows; ++row) {
    const int from_row = std::min(kRows - row, kRows - 1);
    for (int column = 0; column < kColumns; ++column) {
      hanging.at<uchar>(row, column) = upright.at<uchar>(from_row, (kColumns - column) % kColumns);
    }
  }
  return hanging;
}

PanoramicCompass hanging_compass(const std::string& method) {
  CompassParameters parameters;
  parameters.method = method;
  const Eigen::AngleAxisd rolled(std::numbers::pi, Eigen::Vector3d::UnitZ());
  return PanoramicCompass(parameters, 1, upright_base_from_panorama() * rolled.toRotationMatrix());
}

class HangingCamera : public testing::TestWithParam<std::string> {};

TEST_P(HangingCamera, TurnsAsTheVehicleDoes) {
  const cv::Mat street = paint_panorama();
  const double tolerance_rad = (GetParam() == "all_round" ? 0.05 : 0.4) * kColumn_rad;
  for (const double columns : {30.0, -55.0}) {
    PanoramicCompass compass = hanging_compass(GetParam());
    EXPECT_FALSE(compass.track(1'000, as_seen_hanging(street)));
    const auto turn = compass.track(2'000, as_seen_hanging(turned_left(street, columns)));
    ASSERT_TRUE(turn && turn->valid) << turn->reason;
    EXPECT_NEAR(turn->change_rad, columns * kColumn_rad, tolerance_rad);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, HangingCamera, testing::Values("all_round", "two_patches"),
                         [](const auto& method) { return method.param; });

TEST(HangingCameraAllRound, TellsTheDirectionOfMotionAndWhatIsAbeam) {
  const cv::Mat street = paint_panorama();
  PanoramicCompass compass = hanging_compass("all_round");
  EXPECT_FALSE(compass.track(1'000, as_seen_hanging(street)));
  const auto turn = compass.track(2'000, as_seen_hanging(driven(street, 0.1, 0.05)));
  ASSERT_TRUE(turn && turn->valid) << turn->reason;
  EXPECT_NEAR(turn->change_rad, 0.05, 0.1 * kColumn_rad);
  EXPECT_NEAR(turn->motion_azimuth_rad, -0.05, 0.005);  // it turned left after driving
  EXPECT_NEAR(turn->side_parallax_rad, 0.1, 0.03);
}

// The mask is of the picture as it is, and coarse.
TEST(HangingCameraAllRound, LeavesOutTheVehicle) {
  const cv::Mat street = paint_panorama();
  cv::Mat seen(18, 36, CV_8UC1, cv::Scalar(255));
  seen.colRange(0, 9).setTo(0);  // left in the picture of the hanging camera: behind, to the right
  PanoramicCompass compass = hanging_compass("all_round");
  compass.set_seen(seen);
  compass.track(1'000, as_seen_hanging(street));
  compass.track(2'000, as_seen_hanging(turned_left(street, 10.0)));
  ASSERT_NE(compass.points(), nullptr);
  ASSERT_GT(compass.points()->tracks.front().pairs.size(), 20U);
  for (const BearingPair& pair : compass.points()->tracks.front().pairs) {
    EXPECT_FALSE(pair.then.x() < -0.05 && pair.then.y() < -0.05) << pair.then.transpose();
  }
}

}  // namespace
}  // namespace panvo::panoramic_compass
