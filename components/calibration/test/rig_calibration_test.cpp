// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/rig_calibration.hpp"

#include <gmock/gmock.h>

#include "panvo/calibration/calibration_error.hpp"
#include "panvo/calibration/epipolar_error.hpp"
#include "panvo/calibration/lens_parameters.hpp"
#include "panvo/calibration/rectified_pair.hpp"
#include "simulated_boards.hpp"

namespace panvo::calibration {
namespace {

using test::camera_at;
using test::kDegree;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using vision::LensModel;

constexpr double kNoise_px = 0.05;  // corner noise of a sharp image
const Board kRigBoard = parse_board("charuco:10x7:0.04:0.03");
const Board kChessboard = parse_board("chessboard:9x6:0.04");

RigOptions unknown_lenses(std::size_t count, LensModel model) {
  RigOptions options;
  options.models.assign(count, model);
  options.lenses.assign(count, std::nullopt);
  return options;
}

/// Radius around the principal point within which corners determine a lens, px: nine tenths of the farthest.
double reach_px(const Observations& observations, std::size_t camera, const vision::LensCamera& lens) {
  double farthest = 0.0;
  for (const auto& view : observations.views) {
    for (const auto& corner : view.seen[camera])
      farthest = std::max(farthest, (corner.pixel - Eigen::Vector2d(lens.pinhole.cx, lens.pinhole.cy)).norm());
  }
  return 0.9 * farthest;
}

/// Largest distance between the projections of the same directions by two lenses up to `reach_px` from the principal
/// point, px.
double max_difference_px(const vision::LensCamera& a, const vision::LensCamera& b, double reach_px) {
  const vision::CameraModel model_a(a), model_b(b);
  double largest = 0.0;
  for (int v = 20; v < a.pinhole.height - 20; v += 20) {
    for (int u = 20; u < a.pinhole.width - 20; u += 20) {
      if (std::hypot(u - a.pinhole.cx, v - a.pinhole.cy) > reach_px) continue;
      const auto direction = model_a.unproject({u, v});
      if (!direction) continue;
      const auto pixel = model_b.project(*direction);
      largest = std::max(largest, pixel ? (*pixel - Eigen::Vector2d(u, v)).norm() : 1e3);
    }
  }
  return largest;
}

/// Pixels per radian on the axis: the effective focal lengths of any lens model.
Eigen::Vector2d focal_lengths_px(const vision::LensCamera& lens) {
  constexpr double kStep = 1e-5;
  const Eigen::Vector2d centre(lens.pinhole.cx, lens.pinhole.cy);
  return (*vision::CameraModel(lens).project({kStep, kStep, 1.0}) - centre) / kStep;
}

void expect_same_lens(const RigCalibration& calibration, std::size_t camera, const vision::LensCamera& truth) {
  const auto& found = calibration.rig.cameras[camera].lens;
  const Eigen::Vector2d ratio = focal_lengths_px(found).cwiseQuotient(focal_lengths_px(truth));
  EXPECT_NEAR(ratio.x(), 1.0, 1e-3);
  EXPECT_NEAR(ratio.y(), 1.0, 1e-3);
  EXPECT_NEAR(found.pinhole.cx, truth.pinhole.cx, 1e-3 * truth.pinhole.width);
  EXPECT_NEAR(found.pinhole.cy, truth.pinhole.cy, 1e-3 * truth.pinhole.height);
  const double reach = reach_px(calibration.used, camera, found);
  EXPECT_GT(reach, 0.4 * truth.pinhole.height);
  EXPECT_LT(max_difference_px(truth, found, reach), 1e-3 * truth.pinhole.width);
}

void expect_same_pose(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth) {
  const Eigen::Isometry3d between = found.inverse() * truth;
  EXPECT_LT(between.translation().norm(), 1e-3);
  EXPECT_LT(vision::so3_log(between.linear()).norm(), 0.05 * kDegree);
}

std::string refusal(const Observations& observations, const RigOptions& options) {
  try {
    calibrate(observations, options);
  } catch (const CalibrationError& error) {
    return error.what();
  }
  return "calibrated";
}

struct Case {
  const char* name;
  vision::LensCamera lens;
  double widest_off_deg;
  double nearest_m;
};

class StereoCalibrationOf : public ::testing::TestWithParam<Case> {};

TEST_P(StereoCalibrationOf, GivesBackLensesAndPosesAtKnownNoise) {
  const auto& lens = GetParam().lens;
  const auto truth = test::stereo_pair(lens);
  const auto boards = test::hold_boards(kRigBoard, truth, 40, GetParam().widest_off_deg, GetParam().nearest_m, 7);
  const auto observations = test::observe(kRigBoard, truth, boards, kNoise_px, 8);
  const auto found = calibrate(observations, unknown_lenses(2, lens.model));
  for (std::size_t i = 0; i < 2; ++i) {
    expect_same_lens(found, i, truth[i].lens);
    expect_same_pose(found.rig.cameras[i].camera_from_reference, truth[i].camera_from_reference);
  }
  EXPECT_NEAR(rms_px(found.residuals), std::sqrt(2.0) * kNoise_px, 0.1 * kNoise_px);
  EXPECT_THAT(found.rejections, SizeIs(0));
  const auto& [left, right] = std::tie(found.rig.cameras[0], found.rig.cameras[1]);
  const auto errors = summarise(epipolar_errors(found.used, left.lens, right.lens, rectify(left, right)));
  EXPECT_GT(errors.corners, 500U);
  EXPECT_LT(errors.rms_px, 0.2);
}

TEST_P(StereoCalibrationOf, KnowsHowFarItMayBeOff) {
  const auto truth = test::stereo_pair(GetParam().lens);
  const auto boards = test::hold_boards(kRigBoard, truth, 30, GetParam().widest_off_deg, GetParam().nearest_m, 17);
  const auto found =
      calibrate(test::observe(kRigBoard, truth, boards, kNoise_px, 18), unknown_lenses(2, GetParam().lens.model));
  ASSERT_TRUE(found.sigmas);
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::VectorXd off = lens_parameters(found.rig.cameras[i].lens) - lens_parameters(truth[i].lens);
    Eigen::VectorXd in_sigmas = off.cwiseAbs().cwiseQuotient((*found.sigmas)[i].lens);
    // numerator and denominator of the rational model compensate each other, so their sigmas are not meaningful
    if (GetParam().lens.model == LensModel::kRational) in_sigmas.conservativeResize(4);
    EXPECT_LT(in_sigmas.maxCoeff(), 4.5) << in_sigmas.transpose();
    EXPECT_GT(in_sigmas.maxCoeff(), 0.2) << in_sigmas.transpose();
  }
  EXPECT_EQ((*found.sigmas)[0].position_m.norm(), 0.0);
  const Eigen::Vector3d off =
      found.rig.cameras[1].camera_from_reference.translation() - truth[1].camera_from_reference.translation();
  EXPECT_LT(off.cwiseAbs().cwiseQuotient((*found.sigmas)[1].position_m).maxCoeff(), 4.5);
}

INSTANTIATE_TEST_SUITE_P(
    EachLens, StereoCalibrationOf,
    ::testing::Values(
        Case{"plumb_bob", test::plumb_bob(), 38.0, 0.5},
        Case{"rational", test::lens(LensModel::kRational, 420.0, {0.6, -0.1, 0.0004, -0.0003, 0.01, 0.9, -0.02, 0.002}),
             38.0, 0.5},
        Case{"equidistant", test::fisheye(), 75.0, 0.35},
        Case{"mei", test::lens(LensModel::kMei, 420.0, {-0.1, 0.03, 0.0005, -0.0004, 0.9}), 75.0, 0.35}),
    [](const auto& tested) { return tested.param.name; });

TEST(RigCalibration, FindsSixFisheyesOfWhichOnlyNeighboursShareBoards) {
  std::vector<RigCamera> truth;
  auto lens = test::lens(LensModel::kEquidistant, 200.0, {-0.01, 0.004, -0.001, 0.0001}, 616, 808);
  for (int i = 0; i < 5; ++i) {
    const double yaw = 72.0 * i;
    truth.push_back({lens, camera_at({0.04 * std::sin(kDegree * yaw), 0.001 * i, 0.04 * std::cos(kDegree * yaw)},
                                     {0.0, yaw, 0.0})});
  }
  truth.push_back({lens, camera_at({0.0, -0.04, 0.0}, {90.0, 0.0, 0.0})});
  const auto boards = test::hold_boards(kRigBoard, truth, 72, 75.0, 0.35, 3);
  const auto found =
      calibrate(test::observe(kRigBoard, truth, boards, kNoise_px, 4), unknown_lenses(6, LensModel::kEquidistant));
  for (std::size_t i = 0; i < truth.size(); ++i) {
    expect_same_lens(found, i, truth[i].lens);
    expect_same_pose(found.rig.cameras[i].camera_from_reference,
                     truth[i].camera_from_reference * truth[0].camera_from_reference.inverse());
  }
}

TEST(RigCalibration, FindsPosesOfLensesOfDifferentKindsThatAreHeld) {
  const std::vector<RigCamera> truth{{test::plumb_bob()},
                                     {test::fisheye(), camera_at({-0.1, -0.5, 0.2}, {20.0, 15.0, 178.0})},
                                     {test::plumb_bob(), camera_at({0.12, 0.0, 0.0}, {0.0, 1.0, 0.0})}};
  const auto boards = test::hold_boards(kRigBoard, truth, 30, 30.0, 0.6, 5);
  RigOptions options;
  options.are_lenses_held = true;
  for (const auto& camera : truth) {
    options.models.push_back(camera.lens.model);
    options.lenses.emplace_back(camera.lens);
  }
  const auto found = calibrate(test::observe(kRigBoard, truth, boards, kNoise_px, 6), options);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_EQ(lens_parameters(found.rig.cameras[i].lens), lens_parameters(truth[i].lens));
    expect_same_pose(found.rig.cameras[i].camera_from_reference, truth[i].camera_from_reference);
  }
}

TEST(RigCalibration, TellsPosesInTheFrameOfTheReference) {
  const auto truth = test::stereo_pair(test::plumb_bob());
  const auto boards = test::hold_boards(kChessboard, truth, 20, 25.0, 0.5, 5);
  auto options = unknown_lenses(2, LensModel::kPlumbBob);
  options.reference = 1;
  const auto found = calibrate(test::observe(kChessboard, truth, boards, kNoise_px, 6), options);
  EXPECT_TRUE(found.rig.cameras[1].camera_from_reference.isApprox(Eigen::Isometry3d::Identity()));
  expect_same_pose(found.rig.cameras[0].camera_from_reference, truth[1].camera_from_reference.inverse());
}

TEST(RigCalibration, LeavesOutABoardThatMovedBetweenTheCamerasAndSingleStrays) {
  const auto truth = test::stereo_pair(test::plumb_bob());
  const auto boards = test::hold_boards(kChessboard, truth, 30, 25.0, 0.5, 5);
  auto observations = test::observe(kChessboard, truth, boards, kNoise_px, 6);
  std::vector<std::size_t> both;
  for (std::size_t view = 0; view < observations.views.size(); ++view) {
    const auto& seen = observations.views[view].seen;
    if (!seen[0].empty() && !seen[1].empty()) both.push_back(view);
  }
  ASSERT_GT(both.size(), 10U);
  for (auto& corner : observations.views[both[3]].seen[1]) corner.pixel.x() += 12.0;
  observations.views[both[5]].seen[0][20].pixel += Eigen::Vector2d(6.0, -3.0);
  const auto found = calibrate(observations, unknown_lenses(2, LensModel::kPlumbBob));
  expect_same_pose(found.rig.cameras[1].camera_from_reference, truth[1].camera_from_reference);
  ASSERT_THAT(found.rejections, SizeIs(::testing::Ge(1U)));
  for (const auto& rejection : found.rejections) {
    EXPECT_EQ(rejection.view, both[3]);
    EXPECT_THAT(rejection.reason, AllOf(HasSubstr("px off"), HasSubstr("moved")));
  }
  EXPECT_EQ(found.stray_corners[0], 1U);
  EXPECT_EQ(found.used.views[both[5]].seen[0].size(), static_cast<std::size_t>(kChessboard.corners()) - 1);
}

TEST(RigCalibration, NamesTheCameraWithTooFewViews) {
  const auto truth = test::stereo_pair(test::plumb_bob());
  auto observations =
      test::observe(kChessboard, truth, test::hold_boards(kChessboard, truth, 6, 10.0, 0.6, 5), kNoise_px, 6);
  for (std::size_t view = 3; view < 6; ++view) observations.views[view].seen[1].clear();
  EXPECT_THAT(
      refusal(observations, unknown_lenses(2, LensModel::kPlumbBob)),
      AllOf(HasSubstr("camera_1"), HasSubstr("3 of 6 images"), HasSubstr("at least 5"), HasSubstr("take more")));
  for (auto& view : observations.views) view.seen[1].clear();
  EXPECT_THAT(refusal(observations, unknown_lenses(2, LensModel::kPlumbBob)),
              AllOf(HasSubstr("0 of 6"), HasSubstr("--board")));
}

TEST(RigCalibration, NamesTheCameraThatSharesNoView) {
  std::vector<RigCamera> truth = test::stereo_pair(test::plumb_bob());
  truth.push_back({test::plumb_bob(), camera_at({0.0, 0.0, -0.1}, {0.0, 180.0, 0.0})});
  const auto boards = test::hold_boards(kChessboard, truth, 30, 20.0, 0.5, 5);
  EXPECT_THAT(refusal(test::observe(kChessboard, truth, boards, kNoise_px, 6), unknown_lenses(3, LensModel::kPlumbBob)),
              AllOf(HasSubstr("camera_2"), HasSubstr("'camera_0'"), HasSubstr("two cameras see it at once")));
}

}  // namespace
}  // namespace panvo::calibration
