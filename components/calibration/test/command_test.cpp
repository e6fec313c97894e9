// SPDX-License-Identifier: Apache-2.0
// panvo_calibrate as a person calls it: pictures in, files out.
#include <gmock/gmock.h>

#include <regex>

#include "panvo/calibration/camera_info_file.hpp"
#include "panvo/calibration/rig_file.hpp"
#include "written_images.hpp"

namespace panvo::calibration {
namespace {

using test::camera_at;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class StereoCommand : public test::CommandTest {
 protected:
  void expect_calibrated(const std::string& folder, const std::vector<RigCamera>& truth) const {
    const auto left = read_camera_info(folder_ / folder / "left.yaml");
    const auto right = read_camera_info(folder_ / folder / "right.yaml");
    test::expect_same_focal_lengths(left.lens, truth[0].lens);
    test::expect_same_focal_lengths(right.lens, truth[1].lens);
    const auto pair = rectified_pair(left, right, folder);
    Eigen::Isometry3d right_from_left(pair.rectified_right_from_right.transpose() * pair.rectified_left_from_left);
    right_from_left.translation() = -pair.baseline_m * pair.rectified_right_from_right.transpose().col(0);
    test::expect_same_pose(right_from_left, truth[1].camera_from_reference);
  }

  static double epipolar_rms_px(const std::string& text) {
    std::smatch found;
    return std::regex_search(text, found, std::regex("epipolar residual: rms ([0-9.]+) px")) ? std::stod(found[1])
                                                                                             : 1e9;
  }
};

TEST_F(StereoCommand, GivesBackAPairSeenWithAChessboardAndNoticesWhenItHasMoved) {
  const Board board = parse_board("chessboard:9x6:0.04");
  const auto truth = test::stereo_pair(test::plumb_bob());
  photograph("images", board, {"left", "right"}, truth, test::hold_boards(board, truth, 36, 22.0, 0.5, 11));
  const auto outcome = call("stereo images --board chessboard:9x6:0.04 --out rig");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  std::cout << outcome.out;
  expect_calibrated("rig", truth);
  EXPECT_LT(epipolar_rms_px(outcome.out), 0.2);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("std. deviation"), HasSubstr("reprojection rms"),
                                 HasSubstr("rig: left.yaml, right.yaml")));
  EXPECT_THAT(text_of("rig/report.html"),
              AllOf(HasSubstr("<svg"), HasSubstr("epipolar residual"), HasSubstr("residuals of right")));
  EXPECT_THAT(text_of("rig/coverage_left.svg"), HasSubstr("<circle"));
  EXPECT_THAT(text_of("rig/residuals_right.svg"), HasSubstr("<circle"));

  const auto holds = call("check images --calibration rig --board chessboard:9x6:0.04");
  EXPECT_EQ(holds.status, 0) << holds.err;
  EXPECT_LT(epipolar_rms_px(holds.out), 0.2);

  auto moved = read_camera_info(folder_ / "rig/right.yaml");
  moved.rectified_from_raw = vision::so3_exp({0.2 * test::kDegree, 0.0, 0.0}) * moved.rectified_from_raw;
  write_camera_info(folder_ / "rig/right.yaml", moved);
  const auto stale = call("check images --calibration rig --board chessboard:9x6:0.04");
  EXPECT_EQ(stale.status, 3);
  EXPECT_NEAR(epipolar_rms_px(stale.out), 0.2 * test::kDegree * moved.projection(1, 1), 0.3);
  EXPECT_THAT(stale.err, AllOf(HasSubstr("rig"), HasSubstr("stale"), HasSubstr("calibrate again")));
}

TEST_F(StereoCommand, GivesBackTwoFisheyesSeenWithACharucoBoardFromAnEarlierStart) {
  const Board board = parse_board("charuco:7x5:0.06:0.042:DICT_4X4_50");
  const auto truth = test::stereo_pair(test::fisheye());
  photograph("images", board, {"cam0", "cam1"}, truth, test::hold_boards(board, truth, 40, 65.0, 0.28, 21));
  const std::string arguments = "stereo images --board charuco:7x5:0.06:0.042:DICT_4X4_50 --model equidistant ";
  const auto outcome = call(arguments + "--out rig");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::cout << outcome.out;
  expect_calibrated("rig", truth);
  EXPECT_LT(epipolar_rms_px(outcome.out), 0.2);
  EXPECT_THAT(text_of("rig/left.yaml"), HasSubstr("distortion_model: equidistant"));
  const auto again = call(arguments + "--start rig --out again");
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NEAR(epipolar_rms_px(again.out), epipolar_rms_px(outcome.out), 2e-3);
}

class RigCommand : public test::CommandTest {};

TEST_F(RigCommand, GivesBackFourFisheyesAllRoundAndTheirPosesAlone) {
  const Board board = parse_board("charuco:7x5:0.06:0.042:DICT_4X4_50");
  const auto lens = test::lens(vision::LensModel::kEquidistant, 200.0, {-0.01, 0.004, -0.001, 0.0001}, 640, 640);
  std::vector<RigCamera> truth;
  for (int i = 0; i < 4; ++i)
    truth.push_back({lens, camera_at({0.03 * std::sin(90.0 * i * test::kDegree), 0.002 * i,
                                      0.03 * std::cos(90.0 * i * test::kDegree) - 0.03},
                                     {0.0, 90.0 * i, 0.0})});
  const std::vector<std::string> names{"head_0", "head_1", "head_2", "head_3"};
  photograph("images", board, names, truth, test::hold_boards(board, truth, 80, 65.0, 0.28, 31));
  const auto outcome = call(
      "rig images --board charuco:7x5:0.06:0.042:DICT_4X4_50 --model equidistant --out rig --mount 0.1,0,1.2,0,0,0");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::cout << outcome.out;
  const auto found = read_extrinsics(folder_ / "rig/extrinsics.yaml");
  ASSERT_THAT(found, SizeIs(4));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(found[i].name, names[i]);
    test::expect_same_focal_lengths(found[i].camera.lens, lens);
    test::expect_same_pose(found[i].camera.camera_from_reference, truth[i].camera_from_reference);
  }
  EXPECT_THAT(text_of("rig/extrinsics.yaml"), HasSubstr("mount: [0.10000, 0.00000, 1.20000, 0.0000, 0.0000, 0.0000]"));
  EXPECT_THAT(text_of("rig/panorama.yaml"),
              AllOf(HasSubstr("panorama_from_head"), HasSubstr("camera_info: head_3.yaml")));

  const auto alone = call(
      "extrinsics images --calibration rig --cameras head_1,head_0 --board charuco:7x5:0.06:0.042:DICT_4X4_50 --out "
      "poses");
  ASSERT_EQ(alone.status, 0) << alone.err;
  EXPECT_THAT(alone.out, HasSubstr("held"));
  const auto poses = read_extrinsics(folder_ / "poses/extrinsics.yaml");
  ASSERT_THAT(poses, SizeIs(2));
  test::expect_same_pose(poses[1].camera.camera_from_reference, truth[1].camera_from_reference.inverse());
}

}  // namespace
}  // namespace panvo::calibration
