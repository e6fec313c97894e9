// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_group/mounting.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

#include "panvo/conversions/pose.hpp"

namespace panvo::camera_group {
namespace {

using camera_stream::Layout;
using camera_stream::roles_of;
using ::testing::SizeIs;

TEST(Mounting, PlacesTheLeftEyeAndTheRightOneByTheCalibration) {
  std::vector<std::string> problems;
  const auto images = images_of(roles_of(Layout::kStereo, 2), PANVO_RIGS "/example", problems);
  ASSERT_THAT(problems, SizeIs(0));
  const auto message = mounting({1.0, 0.06, 1.5, 0, 0, 90}, images, 7);
  ASSERT_THAT(message.transforms(), SizeIs(2));
  const auto left = *conversions::to_isometry(message.transforms()[0].transform());
  const auto right = *conversions::to_isometry(message.transforms()[1].transform());
  EXPECT_EQ(message.transforms()[1].child_frame_id(), "stereo_right_optical");
  // Turned left by 90 degrees, the camera looks along +y and its right is +x: the right eye is 0.12 m away along +x.
  EXPECT_TRUE((left.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitY(), 1e-9));
  EXPECT_TRUE((left.linear() * Eigen::Vector3d::UnitY()).isApprox(-Eigen::Vector3d::UnitZ(), 1e-9));
  EXPECT_TRUE((right.translation() - left.translation()).isApprox(Eigen::Vector3d(0.12, 0, 0), 1e-9));
}

TEST(Mounting, TakesSixNumbersForEachImage) {
  std::vector<std::string> problems;
  const auto images = images_of(roles_of(Layout::kRig, 3), "", problems);
  EXPECT_THAT(mounting({}, images, 0).transforms(), SizeIs(0));
  EXPECT_THAT(mounting(std::vector<double>(18, 0.0), images, 0).transforms(), SizeIs(3));
  EXPECT_THROW(mounting(std::vector<double>(12, 0.0), images, 0), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::camera_group
