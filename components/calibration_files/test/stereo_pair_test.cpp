// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration_files/stereo_pair.hpp"

#include <gmock/gmock.h>

#include "panvo/test/temporary_folder.hpp"
#include "refused.hpp"

namespace panvo::calibration_files {
namespace {

using test::refusal;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Cameras of 64 x 48 px, both rotated by the same rectification about the vertical axis, 0.12 m apart.
class StereoPair : public ::testing::Test {
 protected:
  StereoPair() {
    const vision::LensCamera lens{{50, 50, 32, 24, 64, 48}};
    vision::RectifiedStereo rectified{{40, 40, 30, 20, 64, 48}, 0.12};
    rectified.rectified_left_from_left << 0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8;
    rectified.rectified_right_from_right = rectified.rectified_left_from_left;
    std::tie(left_, right_) = stereo_camera_infos(lens, lens, rectified);
  }

  CameraInfo left_, right_;
};

TEST_F(StereoPair, IsWhatWasWritten) {
  const panvo::test::TemporaryFolder folder;
  write_camera_info(folder / "left.yaml", left_);
  write_camera_info(folder / "right.yaml", right_);
  const auto stereo = stereo_pair(read_camera_info(folder / "left.yaml"), read_camera_info(folder / "right.yaml"));
  EXPECT_DOUBLE_EQ(stereo.rectified.baseline_m, 0.12);
  EXPECT_EQ(stereo.rectified.camera.fx, 40.0);
  EXPECT_EQ(stereo.rectified.camera.cy, 20.0);
  EXPECT_EQ(stereo.rectified.rectified_left_from_left(0, 2), 0.6);
  EXPECT_EQ(stereo.calibration.left.pinhole.fx, 50.0);
  EXPECT_EQ(stereo.calibration.right.pinhole.cx, 32.0);
  // Both cameras have the same rotation, so the right one is displaced along the rectified X axis in the left frame.
  const Eigen::Isometry3d& right_from_left = stereo.calibration.right_from_left;
  EXPECT_TRUE(right_from_left.linear().isIdentity(1e-12));
  EXPECT_TRUE(right_from_left.translation().isApprox(-0.12 * Eigen::Vector3d(0.8, 0, 0.6), 1e-12));
}

TEST_F(StereoPair, HasTheRotationBetweenTheRawCameras) {
  left_.rectification_matrix.setIdentity();
  // A point straight ahead of the left camera, whose raw and rectified frames are equal, in the raw frame of the right
  // camera, which is displaced by 12 cm and rotated.
  const Eigen::Vector3d point_in_right =
      stereo_pair(left_, right_).calibration.right_from_left * Eigen::Vector3d(0, 0, 1);
  EXPECT_TRUE(point_in_right.isApprox(Eigen::Vector3d(-0.12 * 0.8 - 0.6, 0, -0.12 * 0.6 + 0.8), 1e-12))
      << point_in_right;
}

TEST_F(StereoPair, OfTheExampleRigHasItsBaseline) {
  const std::filesystem::path folder = PANVO_RIGS "/example";
  const auto pair = stereo_pair(read_camera_info(folder / "left.yaml"), read_camera_info(folder / "right.yaml"));
  EXPECT_DOUBLE_EQ(pair.rectified.baseline_m, 0.12);
  EXPECT_EQ(pair.rectified.camera.fx, 500.0);
}

TEST_F(StereoPair, IsRefusedIfTheCamerasWereCalibratedAlone) {
  right_.projection_matrix(0, 3) = 0.0;
  right_.file = "rig/right.yaml";
  EXPECT_THAT(refusal([&] { stereo_pair(left_, right_); }),
              AllOf(HasSubstr("rig/right.yaml: baseline is 0"),
                    HasSubstr("; calibrate it together with left: panvo calibrate stereo")));
}

TEST_F(StereoPair, IsRefusedIfTheProjectionsDiffer) {
  left_.projection_matrix(0, 0) += 0.01;
  EXPECT_THAT(refusal([&] { stereo_pair(left_, right_); }),
              HasSubstr("right: projection_matrix differs from that of the left camera in more than the last column"));
}

TEST_F(StereoPair, IsRefusedIfALensIsUnknown) {
  left_.distortion_model = "division";
  left_.distortion_coefficients = {0.1};
  EXPECT_THAT(refusal([&] { stereo_pair(left_, right_); }),
              HasSubstr("left cannot be used: the camera has distortion model 'division'"));
}

}  // namespace
}  // namespace panvo::calibration_files
