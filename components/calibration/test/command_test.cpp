// SPDX-License-Identifier: Apache-2.0
// Runs panvo_calibrate as a process on rendered images.
#include <gmock/gmock.h>

#include <regex>

#include "panvo/calibration/camchain_file.hpp"
#include "panvo/calibration/rig_file.hpp"
#include "panvo/calibration_files/stereo_pair.hpp"
#include "written_images.hpp"

namespace panvo::calibration {
namespace {

using calibration_files::read_camera_info;
using calibration_files::single_camera_info;
using calibration_files::write_camera_info;
using test::camera_at;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class StereoCommand : public test::CommandTest {
 protected:
  void expect_calibrated(const std::string& folder, const std::vector<RigCamera>& truth) const {
    const auto left = read_camera_info(folder_ / folder / "left.yaml");
    const auto right = read_camera_info(folder_ / folder / "right.yaml");
    test::expect_same_focal_lengths(left.lens(), truth[0].lens);
    test::expect_same_focal_lengths(right.lens(), truth[1].lens);
    test::expect_same_pose(calibration_files::stereo_pair(left, right).calibration.right_from_left,
                           truth[1].camera_from_reference);
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
  photograph("images", board, {"left", "right"}, truth, test::hold_boards(board, truth, 26, 22.0, 0.5, 11));
  photograph("later", board, {"left", "right"}, truth, test::hold_boards(board, truth, 4, 10.0, 0.6, 12));
  const auto outcome = call("stereo images --board chessboard:9x6:0.04 --out rig");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  expect_calibrated("rig", truth);
  EXPECT_LT(epipolar_rms_px(outcome.out), 0.2);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("std. deviation"), HasSubstr("reprojection rms"),
                                 HasSubstr("rig: left.yaml, right.yaml")));
  EXPECT_THAT(folder_.read("rig/report.html"),
              AllOf(HasSubstr("<svg"), HasSubstr("epipolar residual"), HasSubstr("residuals of right")));
  EXPECT_THAT(folder_.read("rig/coverage_left.svg"), HasSubstr("<circle"));
  EXPECT_THAT(folder_.read("rig/residuals_right.svg"), HasSubstr("<circle"));

  const auto holds = call("check later --calibration rig --board chessboard:9x6:0.04");
  EXPECT_EQ(holds.status, 0) << holds.err;
  EXPECT_LT(epipolar_rms_px(holds.out), 0.2);

  auto moved = read_camera_info(folder_ / "rig/right.yaml");
  moved.rectification_matrix = vision::so3_exp({0.2 * test::kDegree, 0.0, 0.0}) * moved.rectification_matrix;
  write_camera_info(folder_ / "rig/right.yaml", moved);
  const auto stale = call("check later --calibration rig --board chessboard:9x6:0.04");
  EXPECT_EQ(stale.status, 3);
  EXPECT_NEAR(epipolar_rms_px(stale.out), 0.2 * test::kDegree * moved.projection_matrix(1, 1), 0.3);
  EXPECT_THAT(stale.err, AllOf(HasSubstr("rig"), HasSubstr("stale"), HasSubstr("recalibrate")));
}

TEST_F(StereoCommand, GivesBackTwoFisheyesSeenWithACharucoBoardFromAnEarlierStart) {
  const Board board = parse_board("charuco:7x5:0.06:0.042:DICT_4X4_50");
  const auto truth = test::stereo_pair(test::fisheye());
  photograph("images", board, {"cam0", "cam1"}, truth, test::hold_boards(board, truth, 36, 65.0, 0.28, 21));
  const std::string arguments = "stereo images --board charuco:7x5:0.06:0.042:DICT_4X4_50 --model equidistant ";
  const auto outcome = call(arguments + "--out rig");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expect_calibrated("rig", truth);
  EXPECT_LT(epipolar_rms_px(outcome.out), 0.2);
  EXPECT_THAT(folder_.read("rig/left.yaml"), HasSubstr("distortion_model: equidistant"));
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
  photograph("images", board, names, truth, test::hold_boards(board, truth, 52, 65.0, 0.28, 31));
  const auto outcome = call(
      "rig images --board charuco:7x5:0.06:0.042:DICT_4X4_50 --model equidistant --out rig --mount 0.1,0,1.2,0,0,0");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto found = read_extrinsics(folder_ / "rig/extrinsics.yaml");
  ASSERT_THAT(found, SizeIs(4));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(found[i].name, names[i]);
    test::expect_same_focal_lengths(found[i].camera.lens, lens);
    test::expect_same_pose(found[i].camera.camera_from_reference, truth[i].camera_from_reference);
  }
  EXPECT_THAT(folder_.read("rig/extrinsics.yaml"),
              HasSubstr("mount: [0.10000, 0.00000, 1.20000, 0.0000, 0.0000, 0.0000]"));
  EXPECT_THAT(folder_.read("rig/panorama.yaml"),
              AllOf(HasSubstr("panorama_from_head"), HasSubstr("camera_info: head_3.yaml")));

  const auto alone = call(
      "extrinsics images --calibration rig --cameras head_1,head_0 --board charuco:7x5:0.06:0.042:DICT_4X4_50 --out "
      "poses");
  ASSERT_EQ(alone.status, 0) << alone.err;
  EXPECT_THAT(alone.out, HasSubstr("fixed"));
  const auto poses = read_extrinsics(folder_ / "poses/extrinsics.yaml");
  ASSERT_THAT(poses, SizeIs(2));
  test::expect_same_pose(poses[1].camera.camera_from_reference, truth[1].camera_from_reference.inverse());
}

class CalibrateRefuses : public test::CommandTest {
 protected:
  /// Pairs with too few images of the board, and a calibration of the left camera.
  void few_pairs() const {
    const Board board = parse_board("chessboard:9x6:0.04");
    const auto truth = test::stereo_pair(test::plumb_bob());
    photograph("images", board, {"left", "right"}, truth, test::hold_boards(board, truth, 4, 8.0, 0.7, 41));
    std::filesystem::create_directories(folder_ / "rig");
    write_camera_info(folder_ / "rig/left.yaml", single_camera_info("left", truth[0].lens));
  }

  void expect_refusal(const std::string& arguments, const ::testing::Matcher<std::string>& words) const {
    const auto outcome = call(arguments);
    EXPECT_EQ(outcome.status, 1) << arguments;
    EXPECT_THAT(outcome.err, AllOf(::testing::StartsWith("panvo calibrate: "), words)) << arguments;
    EXPECT_THAT(outcome.out, IsEmpty()) << arguments;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out")) << arguments;
  }
};

TEST_F(CalibrateRefuses, FoldersWithoutPairs) {
  const std::string rest = " --board chessboard:9x6:0.04 --out out";
  expect_refusal("stereo nowhere" + rest,
                 AllOf(HasSubstr("nowhere: is not a folder"), HasSubstr("specify the folder")));
  folder_.write("empty/readme.txt", "nothing");
  expect_refusal("stereo empty" + rest, AllOf(HasSubstr("0 left and 0 right"), HasSubstr("left*.png")));
  folder_.write("unpaired/left/1.png", "x");
  folder_.write("unpaired/right/001.png", "x");
  expect_refusal("stereo unpaired" + rest,
                 AllOf(HasSubstr("'1.png' and '001.png'"), HasSubstr("give simultaneous images")));
  expect_refusal("rig unpaired --cameras left,middle" + rest,
                 AllOf(HasSubstr("unpaired/middle"), HasSubstr("a folder for each camera")));
  expect_refusal("rig empty" + rest, AllOf(HasSubstr("found 0 image folders"), HasSubstr("two or more")));
  folder_.write("broken/left/1.png", "x");
  folder_.write("broken/right/1.png", "x");
  expect_refusal("stereo broken" + rest,
                 AllOf(HasSubstr("left: none of its files can be read"), HasSubstr("complete")));
}

TEST_F(CalibrateRefuses, TooFewImagesAndBoardsThatAreNotSeen) {
  few_pairs();
  expect_refusal("stereo images --board chessboard:9x6:0.04 --out out",
                 AllOf(HasSubstr("used in 4 of 4 images"), HasSubstr("at least 5"), HasSubstr("take more")));
  expect_refusal("stereo images --board chessboard:7x5:0.04 --out out",
                 AllOf(HasSubstr("used in 0 of 4 images"), HasSubstr("counts")));
  expect_refusal("stereo images --board charuco:9x6:0.04:0.03 --out out",
                 AllOf(HasSubstr("used in 0 of 4 images"), HasSubstr("dictionary")));
}

TEST_F(CalibrateRefuses, ImagesOfDifferentSizesAndCalibrationsForOthers) {
  few_pairs();
  std::filesystem::create_directories(folder_ / "small");
  write_camera_info(
      folder_ / "small/left.yaml",
      single_camera_info("left", test::lens(vision::LensModel::kPlumbBob, 215.0, {0, 0, 0, 0, 0}, 320, 240)));
  std::filesystem::copy(folder_ / "small/left.yaml", folder_ / "small/right.yaml");
  const std::string rest = " --board chessboard:9x6:0.04";
  expect_refusal("check images --calibration small" + rest,
                 AllOf(HasSubstr("small/left.yaml: image_width"), HasSubstr("320 x 240"), HasSubstr("640 x 480"),
                       HasSubstr("calibrate at the size")));
  cv::imwrite((folder_ / "images/left/900.png").string(), cv::Mat(240, 320, CV_8U, cv::Scalar(0)));
  expect_refusal("stereo images --out out" + rest, AllOf(HasSubstr("left/900.png"), HasSubstr("320 x 240"),
                                                         HasSubstr("left/000.png"), HasSubstr("one size")));
}

TEST_F(CalibrateRefuses, CalibrationsThatAreNone) {
  few_pairs();
  const std::string check = "check images --board chessboard:9x6:0.04 --calibration ";
  expect_refusal(check + "rig",
                 AllOf(HasSubstr("rig/right.yaml: cannot be opened"), HasSubstr("check that it exists")));
  std::filesystem::copy(folder_ / "rig/left.yaml", folder_ / "rig/right.yaml");
  expect_refusal(check + "rig", AllOf(HasSubstr("rig/right.yaml: baseline is"), HasSubstr("panvo calibrate stereo")));
  folder_.write("rig/left.yaml", "- 1\n- 2\n");
  expect_refusal(check + "rig",
                 AllOf(HasSubstr("rig/left.yaml: contains no `key: value` lines"), HasSubstr("camera_info")));
  folder_.write("rig/left.yaml", "image_width: [\n");
  expect_refusal(check + "rig", AllOf(HasSubstr("rig/left.yaml:"), HasSubstr("is not YAML")));
  expect_refusal("convert rig/right.yaml --out out",
                 AllOf(HasSubstr("rig/right.yaml:1: cam0 is missing"), HasSubstr("camchain")));
}

TEST_F(CalibrateRefuses, WhatCannotBeAskedFor) {
  few_pairs();
  expect_refusal("rig images --board chessboard:8x6:0.04 --out out",
                 AllOf(HasSubstr("chessboard:8x6:0.04"), HasSubstr("upside down"), HasSubstr("9x6")));
  expect_refusal("rig images --reference up --board chessboard:9x6:0.04 --out out",
                 AllOf(HasSubstr("--reference up"), HasSubstr("'left'")));
  expect_refusal("stereo images --board chessboard:9x6 --out out", HasSubstr("'chessboard:9x6'"));
  EXPECT_EQ(call("stereo images --board chessboard:9x6:0.04").status, 2);
  EXPECT_EQ(call("stereo images --board chessboard:9x6:0.04 --out out --model pinhole").status, 2);
  EXPECT_EQ(call("").status, 2);
  const auto help = call("--help");
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("stereo"), HasSubstr("extrinsics"), HasSubstr("convert")));
}

class OtherCommands : public test::CommandTest {};

TEST_F(OtherCommands, DrawABoard) {
  EXPECT_EQ(call("board --board charuco:7x5:0.04:0.03 --out board.svg").status, 0);
  EXPECT_THAT(folder_.read("board.svg"), AllOf(HasSubstr("<svg"), HasSubstr("360.000mm")));
  EXPECT_EQ(call("board --board charuco:7x5:0.04:0.03 --out nowhere/board.svg").status, 1);
}

TEST_F(OtherCommands, TakeKalibrsCamchainAndGiveItBack) {
  const auto truth = test::stereo_pair(test::fisheye());
  folder_.write("camchain.yaml", camchain_text({{"left", truth[0]}, {"right", truth[1]}}));
  const auto taken = call("convert camchain.yaml --out rig");
  ASSERT_EQ(taken.status, 0) << taken.err;
  EXPECT_THAT(taken.out, HasSubstr("left.yaml (cam0)"));
  const auto left = read_camera_info(folder_ / "rig/left.yaml");
  test::expect_same_focal_lengths(left.lens(), truth[0].lens);
  std::filesystem::remove(folder_ / "rig/extrinsics.yaml");  // from R and P alone
  ASSERT_EQ(call("convert rig --out back.yaml").status, 0);
  const auto back = read_camchain(folder_ / "back.yaml");
  ASSERT_THAT(back, SizeIs(2));
  EXPECT_TRUE(back[1].camera.camera_from_reference.isApprox(truth[1].camera_from_reference, 1e-8));
  EXPECT_NEAR(back[1].camera.lens.distortion[1], truth[1].lens.distortion[1], 1e-10);
}

}  // namespace
}  // namespace panvo::calibration
