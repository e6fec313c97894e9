// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/board_detector.hpp"

#include <gmock/gmock.h>

#include "panvo/calibration/calibration_error.hpp"
#include "rendered_board.hpp"
#include "simulated_boards.hpp"

namespace panvo::calibration {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Root mean square error of the detected corners, px.
double off_px(const std::vector<Corner>& corners, const vision::LensCamera& lens, const Board& board,
              const Eigen::Isometry3d& camera_from_board) {
  const vision::CameraModel model(lens);
  double sum = 0.0;
  for (const auto& corner : corners)
    sum += (corner.pixel - *model.project(camera_from_board * board.point(corner.id))).squaredNorm();
  return std::sqrt(sum / static_cast<double>(corners.size()));
}

Eigen::Isometry3d held(const Board& board, double off_deg, double distance_m, double tilt_deg) {
  std::mt19937 random(5);
  return test::hold_board(board, Eigen::Isometry3d::Identity(), off_deg, 30.0, distance_m, tilt_deg, random);
}

TEST(BoardDetector, FindsEveryCornerOfAChessboardWhereItIs) {
  const Board board = parse_board("chessboard:9x6:0.04");
  const test::BoardRenderer renderer(board, test::plumb_bob());
  const BoardDetector detector(board);
  for (const double tilt_deg : {0.0, 25.0, 45.0}) {
    const auto pose = held(board, 8.0, 0.6, tilt_deg);
    const auto sighting = detector.detect(renderer.render(pose, 1));
    ASSERT_THAT(sighting.corners, SizeIs(54)) << sighting.missing;
    EXPECT_LT(off_px(sighting.corners, test::plumb_bob(), board, pose), 0.1);
  }
}

TEST(BoardDetector, CountsCornersFromTheSameEndHoweverTheCameraIsHeld) {
  const Board board = parse_board("chessboard:9x6:0.04");
  const test::BoardRenderer renderer(board, test::plumb_bob());
  for (const double roll_deg : {0.0, 90.0, 180.0, 270.0}) {
    const Eigen::Isometry3d pose =
        Eigen::Isometry3d(Eigen::AngleAxisd(roll_deg * test::kDegree, Eigen::Vector3d::UnitZ())) *
        held(board, 5.0, 0.7, 20.0);
    const auto sighting = BoardDetector(board).detect(renderer.render(pose, 2));
    ASSERT_THAT(sighting.corners, SizeIs(54)) << roll_deg;
    EXPECT_LT(off_px(sighting.corners, test::plumb_bob(), board, pose), 0.1) << roll_deg;
  }
}

TEST(BoardDetector, FindsThePartOfACharucoBoardThatIsSeen) {
  const Board board = parse_board("charuco:7x5:0.06:0.045:DICT_4X4_50");
  const test::BoardRenderer renderer(board, test::fisheye());
  const auto pose = held(board, 80.0, 0.3, 20.0);
  const auto sighting = BoardDetector(board).detect(renderer.render(pose, 3));
  ASSERT_GT(sighting.corners.size(), 8U) << sighting.missing;
  EXPECT_LT(sighting.corners.size(), 24U);
  EXPECT_LT(off_px(sighting.corners, test::fisheye(), board, pose), 0.1);
}

TEST(BoardDetector, SaysWhyThereIsNone) {
  const cv::Mat empty(480, 640, CV_8U, cv::Scalar(120));
  EXPECT_THAT(BoardDetector(parse_board("chessboard:9x6:0.04")).detect(empty).missing, HasSubstr("9 x 6 corners"));
  EXPECT_THAT(BoardDetector(parse_board("charuco:10x7:0.04:0.03")).detect(empty).missing, HasSubstr("DICT_5X5_100"));
  const Board board = parse_board("chessboard:9x6:0.04");
  const auto picture = test::BoardRenderer(board, test::plumb_bob()).render(held(board, 5.0, 0.6, 20.0), 4);
  EXPECT_THAT(BoardDetector(parse_board("chessboard:10x7:0.04")).detect(picture).corners, IsEmpty());
}

TEST(BoardDetector, RefusesDictionariesThatDoNotDo) {
  const auto refusal = [](const std::string& text) {
    try {
      BoardDetector detector(parse_board(text));
    } catch (const CalibrationError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal("charuco:10x7:0.04:0.03:DICT_9X9_1"), AllOf(HasSubstr("'DICT_9X9_1'"), HasSubstr("DICT_4X4_50")));
  EXPECT_THAT(refusal("charuco:20x20:0.04:0.03:DICT_4X4_50"), AllOf(HasSubstr("200 markers"), HasSubstr("only 50")));
}

TEST(Board, IsReadAsItIsWritten) {
  for (const char* text : {"chessboard:9x6:0.025", "charuco:8x6:0.03:0.022:DICT_6X6_250"})
    EXPECT_EQ(to_string(parse_board(text)), text);
  EXPECT_EQ(parse_board("charuco:8x6:0.03:0.022").dictionary, "DICT_5X5_100");
  EXPECT_EQ(parse_board("charuco:8x6:0.03:0.022").corners(), 35);
  EXPECT_TRUE(parse_board("chessboard:8x6:0.1").is_symmetric());
  EXPECT_FALSE(parse_board("chessboard:9x6:0.1").is_symmetric());
}

TEST(Board, RefusesWhatIsNone) {
  for (const char* text :
       {"", "chess:9x6:0.025", "chessboard:9x6", "chessboard:9:0.025", "chessboard:9x2:0.025", "chessboard:9x6:0",
        "chessboard:9x6:25mm", "chessboard:9x6:25", "charuco:8x6:0.03", "charuco:8x6:0.03:0.03"}) {
    try {
      parse_board(text);
      ADD_FAILURE() << text;
    } catch (const CalibrationError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("'" + std::string(text) + "'"), HasSubstr("chessboard:9x6:0.025")))
          << text;
    }
  }
}

TEST(Board, IsDrawnInItsTrueSize) {
  const auto chessboard = draw_board(parse_board("chessboard:9x6:0.025"));
  EXPECT_THAT(chessboard, AllOf(HasSubstr("width=\"300.000mm\""), HasSubstr("height=\"225.000mm\""),
                                HasSubstr("chessboard:9x6:0.025")));
  EXPECT_THAT(draw_board(parse_board("charuco:5x4:0.03:0.02")), HasSubstr("width=\"210.000mm\""));
}

}  // namespace
}  // namespace panvo::calibration
