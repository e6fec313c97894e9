// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/view_choice.hpp"

#include <gmock/gmock.h>

#include "simulated_boards.hpp"

namespace panvo::calibration {
namespace {

using test::kDegree;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

const Board kViewBoard = parse_board("chessboard:9x6:0.04");
const cv::Size kImage(640, 480);

/// Corners of the board in a camera without distortion; board centre at `middle_m`, rotated by a rotation vector.
std::vector<Corner> seen_at(const Eigen::Vector3d& middle_m,
                            const Eigen::Vector3d& turn_deg = Eigen::Vector3d::Zero()) {
  constexpr double kFocal_px = 400.0;
  const Eigen::Matrix3d turn = vision::so3_exp(kDegree * turn_deg);
  const Eigen::Vector3d middle = 0.5 * (kViewBoard.point(0) + kViewBoard.point(kViewBoard.corners() - 1));
  std::vector<Corner> corners;
  for (int id = 0; id < kViewBoard.corners(); ++id) {
    const Eigen::Vector3d at = turn * (kViewBoard.point(id) - middle) + middle_m;
    corners.push_back({id, kFocal_px * at.head<2>() / at.z() + Eigen::Vector2d(320, 240)});
  }
  return corners;
}

BoardLook look_at(const Eigen::Vector3d& middle_m, const Eigen::Vector3d& turn_deg = Eigen::Vector3d::Zero()) {
  return look_of(seen_at(middle_m, turn_deg), kViewBoard, kImage).value();
}

TEST(BoardLook, IsWhereAndHowLargeTheBoardIs) {
  const auto look = look_at({0.2, -0.1, 1.0});
  EXPECT_TRUE(look.middle.isApprox(Eigen::Vector2d(400.0 / 640, 200.0 / 480), 1e-9));
  EXPECT_NEAR(look.size, std::sqrt(400.0 * 400.0 * 0.40 * 0.28 / (640 * 480)), 1e-9);
  EXPECT_NEAR(look.slant.norm(), 0.0, 1e-9);
}

TEST(BoardLook, TellsWhichWayTheBoardIsTiltedHoweverItIsTurnedInTheImage) {
  const double tilted = std::pow(std::sin(30.0 * kDegree), 2) / (1.0 + std::pow(std::cos(30.0 * kDegree), 2));
  const Eigen::Vector3d far(0.0, 0.0, 20.0);  // so far away that perspective is negligible
  EXPECT_LT((look_at(far, {30.0, 0.0, 0.0}).slant - Eigen::Vector2d(tilted, 0.0)).norm(), 1e-3);
  EXPECT_LT((look_at(far, {0.0, 30.0, 0.0}).slant - Eigen::Vector2d(-tilted, 0.0)).norm(), 1e-3);
  EXPECT_NEAR(std::abs(look_at(far, {21.2132, 21.2132, 0.0}).slant.y()), tilted, 1e-2);
  EXPECT_NEAR(look_at(far, {0.0, 0.0, 77.0}).slant.norm(), 0.0, 1e-6);
}

TEST(BoardLook, IsNoneOfCornersOnALine) {
  auto corners = seen_at({0.0, 0.0, 1.0});
  corners.resize(9);
  EXPECT_FALSE(look_of(corners, kViewBoard, kImage));
  EXPECT_FALSE(look_of({corners[0], corners[1]}, kViewBoard, kImage));
  EXPECT_FALSE(look_of({}, kViewBoard, kImage));
}

ViewChoice choice_of(std::size_t cameras, const ViewGoals& goals = {}) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < cameras; ++i) names.push_back("camera_" + std::to_string(i));
  return {names, std::vector<cv::Size>(cameras, kImage), kViewBoard, goals};
}

TEST(ViewChoice, KeepsWhatDiffersInPlaceSizeOrSlantAndNothingElse) {
  auto choice = choice_of(1);
  EXPECT_TRUE(choice.offer({seen_at({0.0, 0.0, 1.0})}));
  EXPECT_FALSE(choice.offer({seen_at({0.0, 0.0, 1.0})}));
  EXPECT_FALSE(choice.offer({seen_at({0.02, 0.01, 1.02}, {3.0, 4.0, 0.0})}));
  EXPECT_TRUE(choice.offer({seen_at({0.3, 0.0, 1.0})}));
  EXPECT_TRUE(choice.offer({seen_at({0.0, 0.0, 1.8})}));
  EXPECT_TRUE(choice.offer({seen_at({0.0, 0.0, 1.0}, {0.0, 40.0, 0.0})}));
  EXPECT_FALSE(choice.offer({{}}));
  EXPECT_EQ(choice.kept(), 4U);
}

TEST(ViewChoice, KeepsAViewThatAnotherCameraSharesAlthoughOneHadItAlone) {
  auto choice = choice_of(2);
  const auto left = seen_at({0.0, 0.0, 1.0}), right = seen_at({-0.1, 0.0, 1.0});
  EXPECT_TRUE(choice.offer({left, {}}));
  EXPECT_FALSE(choice.offer({left, {}}));
  EXPECT_TRUE(choice.offer({left, right}));
  EXPECT_FALSE(choice.offer({left, right}));
  EXPECT_FALSE(choice.offer({{}, right}));
}

TEST(ViewChoice, KeepsALikeViewThatReachesWhereNoCornerWas) {
  auto choice = choice_of(1);
  EXPECT_TRUE(choice.offer({seen_at({0.0, 0.01, 0.5})}));
  const auto before = choice.covered(0);
  EXPECT_FALSE(choice.offer({seen_at({0.03, 0.01, 0.5})}));
  EXPECT_TRUE(
      choice.offer({seen_at({0.08, 0.01, 0.5})}));  // shifted by a tenth of the image, into another column of cells
  EXPECT_NEAR(choice.covered(0) - before, 3.0 / 48.0, 1e-9);
  EXPECT_FALSE(choice.offer({seen_at({0.08, 0.01, 0.5})}));
}

TEST(ViewChoice, SaysWhatIsLackingUntilNothingIs) {
  auto choice = choice_of(1, {.views = 12, .shared = 0});
  EXPECT_THAT(choice.lacks(0),
              ElementsAre("the left side", "the right side", "the top", "the bottom", "more tilt forwards or back",
                          "more tilt to the left or right", "12 more views"));
  for (const double x : {-0.5, 0.0, 0.5}) {
    for (const double y : {-0.38, 0.0, 0.38}) choice.offer({seen_at({x, y, 1.0})});
  }
  EXPECT_THAT(choice.lacks(0), ElementsAre("more tilt forwards or back", "more tilt to the left or right",
                                           "a nearer or farther board", "3 more views"));
  choice.offer({seen_at({0.0, 0.0, 1.6})});
  for (const double x : {-0.4, -0.1, 0.2}) {
    EXPECT_FALSE(choice.is_enough());
    choice.offer({seen_at({x, 0.1, 1.0}, {40.0, 0.0, 0.0})});
    EXPECT_FALSE(choice.is_enough());
    choice.offer({seen_at({x, -0.1, 1.0}, {0.0, 40.0, 0.0})});
  }
  EXPECT_THAT(choice.lacks(0), IsEmpty());
  EXPECT_TRUE(choice.is_enough());
}

TEST(ViewChoice, AsksForMoreOfTheImageWhereTheSidesAreReached) {
  auto choice = choice_of(1, {.covered = 0.6, .along_sides = 0.25});
  for (const double x : {-0.5, 0.5}) choice.offer({seen_at({x, 0.0, 1.0})});
  EXPECT_THAT(choice.lacks(0), AllOf(Contains("the top"), Not(Contains("more of the image"))));
  for (const double y : {-0.38, 0.38}) choice.offer({seen_at({0.0, y, 1.0})});
  EXPECT_THAT(choice.lacks(0), AllOf(Not(Contains("the top")), Contains("more of the image")));
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.38, 0.38}) choice.offer({seen_at({x, y, 1.0})});
  }
  EXPECT_THAT(choice.lacks(0), Not(Contains("more of the image")));
}

TEST(ViewChoice, AsksForViewsThatCamerasShare) {
  auto choice = choice_of(2, ViewGoals::of_poses());
  for (int i = 0; i < 10; ++i) {
    const auto left = seen_at({0.15 * i - 0.6, 0.1 * (i % 2), 1.0});
    choice.offer({left, i < 4 ? left : std::vector<Corner>()});
  }
  EXPECT_THAT(choice.lacks(0), ElementsAre("6 more views shared with another camera"));
  EXPECT_THAT(choice.lacks(1), ElementsAre("6 more views", "6 more views shared with another camera"));
}

}  // namespace
}  // namespace panvo::calibration
