// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <opencv2/calib3d.hpp>

#include "camera_tree.hpp"
#include "lens_projection.hpp"
#include "panvo/calibration/calibration_error.hpp"
#include "panvo/calibration/coverage.hpp"
#include "panvo/calibration/epipolar_error.hpp"
#include "panvo/calibration/lens_parameters.hpp"
#include "panvo/calibration/planar_pose.hpp"
#include "panvo/calibration/rectified_pair.hpp"
#include "panvo/calibration/rig_calibration.hpp"
#include "simulated_boards.hpp"

namespace panvo::calibration {
namespace {

using ::testing::HasSubstr;
using vision::LensModel;

const Board kBoard = parse_board("chessboard:9x6:0.04");

/// A lens of any model, with an initial value and a little distortion in each coefficient.
vision::LensCamera distorted_lens(LensModel model) {
  std::vector<double> coefficients;
  for (const auto& coefficient : vision::lens_coefficients(model))
    coefficients.push_back(coefficient.start + (coefficients.size() % 2 == 0 ? -0.01 : 0.004));
  return test::lens(model, 420.0, coefficients);
}

class ProjectionForCeres : public ::testing::TestWithParam<LensModel> {
 protected:
  vision::LensCamera lens = distorted_lens(GetParam());
  Eigen::VectorXd parameters = lens_parameters(lens);
  std::vector<Eigen::Vector3d> points{{0.0, 0.0, 1.3}, {0.4, -0.3, 1.7}, {-0.6, 0.2, 1.1}, {1e-8, 0.0, 2.0}};
};

TEST_P(ProjectionForCeres, HasTheBitsOfTheCameraModel) {
  const vision::CameraModel model(lens);
  EXPECT_EQ(lens_parameter_names(GetParam()).size(), static_cast<std::size_t>(parameters.size()));
  for (const auto& point : points) {
    vision::visit_lens(GetParam(), [&]<vision::LensFormula Formula>(const Formula& /*formula*/) {
      ASSERT_EQ(parameters.size(), kLensSize<Formula>);
      Eigen::Vector2d pixel;
      ASSERT_TRUE(project_point<Formula>(parameters.data(), point.data(), pixel.data()));
      EXPECT_EQ(pixel, *model.project(point)) << point.transpose();
    });
  }
}

/// Of the pixel, by each parameter of the lens and each coordinate of the point, on the axis too.
template <vision::LensFormula Formula>
void expect_derivatives(const Eigen::VectorXd& parameters, const Eigen::Vector3d& point) {
  constexpr int kSize = kLensSize<Formula> + 3;
  constexpr double kStep = 1e-6;
  using Jet = ceres::Jet<double, kSize>;
  std::array<Jet, kSize> values;
  for (int i = 0; i < kSize; ++i)
    values.at(static_cast<std::size_t>(i)) = Jet(i < kSize - 3 ? parameters[i] : point[i - kSize + 3], i);
  std::array<Jet, 2> pixel;
  ASSERT_TRUE(project_point<Formula>(values.data(), values.data() + kSize - 3, pixel.data()));
  for (int i = 0; i < kSize; ++i) {
    const auto moved = [&](double step) {
      Eigen::Matrix<double, kSize, 1> all;
      all << parameters, point;
      all[i] += step;
      Eigen::Vector2d at;
      EXPECT_TRUE(project_point<Formula>(all.data(), all.data() + kSize - 3, at.data()));
      return at;
    };
    const Eigen::Vector2d difference = (moved(kStep) - moved(-kStep)) / (2.0 * kStep);
    EXPECT_NEAR(pixel[0].v[i], difference.x(), 1e-6 * (10.0 + difference.norm())) << i << ": " << point.transpose();
    EXPECT_NEAR(pixel[1].v[i], difference.y(), 1e-6 * (10.0 + difference.norm())) << i << ": " << point.transpose();
  }
}

TEST_P(ProjectionForCeres, HasTheDerivativesOfItsDifferences) {
  for (const auto& point : points) {
    vision::visit_lens(GetParam(), [&]<vision::LensFormula Formula>(const Formula& /*formula*/) {
      expect_derivatives<Formula>(parameters, point);
    });
  }
}

TEST_P(ProjectionForCeres, EndsBehindALensWithoutAView) {
  vision::visit_lens(GetParam(), [&]<vision::LensFormula Formula>(const Formula& /*formula*/) {
    Eigen::Vector2d pixel;
    const auto is_seen = [&](const Eigen::Vector3d& point) {
      return project_point<Formula>(parameters.data(), point.data(), pixel.data());
    };
    EXPECT_FALSE(is_seen({0.0, 0.0, -1.0}));
    EXPECT_FALSE(is_seen({0.0, 0.0, 0.0}));
    if (Formula::kIsPerspective) {
      EXPECT_FALSE(is_seen({0.3, 0.1, -1.0}));
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Registered, ProjectionForCeres, ::testing::ValuesIn(vision::kLensModels),
                         [](const auto& tested) { return std::string(vision::ros_name(tested.param)); });

TEST(PlanarPose, IsExactBeyondNinetyDegreesOffTheAxisToo) {
  const vision::CameraModel model(test::lens(LensModel::kEquidistant, 150.0, {-0.01, 0.002, 0, 0}));
  std::mt19937 random(3);
  for (const double off_deg : {0.0, 45.0, 95.0}) {
    const auto pose = test::hold_board(kBoard, Eigen::Isometry3d::Identity(), off_deg, 40.0, 0.5, 30.0, random);
    std::vector<Corner> corners;
    for (int id = 0; id < kBoard.corners(); ++id) corners.push_back({id, *model.project(pose * kBoard.point(id))});
    const auto found =
        planar_pose(corners, kBoard.points(), [&](const Eigen::Vector2d& pixel) { return model.unproject(pixel); });
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->isApprox(pose, 1e-6)) << off_deg;
  }
}

TEST(PlanarPose, IsNotThereFromALineOfCorners) {
  const vision::CameraModel model(test::plumb_bob());
  std::mt19937 random(3);
  const auto pose = test::hold_board(kBoard, Eigen::Isometry3d::Identity(), 5.0, 40.0, 0.5, 30.0, random);
  std::vector<Corner> corners;
  const auto see = [&](int id) { return Corner{id, *model.project(pose * kBoard.point(id))}; };
  for (int id = 0; id < kBoard.columns; ++id) corners.push_back(see(id));
  const auto unproject = [&](const Eigen::Vector2d& pixel) { return model.unproject(pixel); };
  EXPECT_FALSE(planar_pose(corners, kBoard.points(), unproject));
  for (const std::ptrdiff_t at : {0, 1, 2, 3}) {  // one corner beside the line, which may come first
    auto with_one = corners;
    with_one.insert(with_one.begin() + at, see(kBoard.columns));
    EXPECT_FALSE(planar_pose(with_one, kBoard.points(), unproject)) << at;
    with_one.push_back(see(kBoard.columns + 3));
    const auto found = planar_pose(with_one, kBoard.points(), unproject);
    ASSERT_TRUE(found) << at;
    EXPECT_TRUE(found->isApprox(pose, 1e-6)) << at;
  }
  corners.resize(3);
  EXPECT_FALSE(planar_pose(corners, kBoard.points(), unproject));
}

TEST(CameraTree, JoinsCamerasThroughOthersAndIsNotMisledByOneWrongView) {
  const Eigen::Isometry3d b_from_a = test::camera_at({0.1, 0.0, 0.0}, {0.0, 60.0, 0.0});
  const Eigen::Isometry3d c_from_a = test::camera_at({0.2, 0.0, 0.1}, {0.0, 120.0, 0.0});
  BoardPoses poses(3, std::vector<std::optional<Eigen::Isometry3d>>(6));
  std::mt19937 random(9);
  for (std::size_t view = 0; view < 6; ++view) {
    const auto a_from_board = test::hold_board(kBoard, Eigen::Isometry3d::Identity(), 30.0, 0.0, 1.0, 20.0, random);
    if (view < 3) poses[0][view] = a_from_board;
    poses[1][view] = b_from_a * a_from_board;
    if (view >= 3) poses[2][view] = c_from_a * a_from_board;
  }
  poses[2][3]->translation().x() += 0.5;
  const auto joined = join_cameras(poses, 0, {"a", "b", "c"});
  EXPECT_TRUE(joined[1].isApprox(b_from_a, 1e-9));
  EXPECT_TRUE(joined[2].isApprox(c_from_a, 1e-9));
}

class RectifiedPairOf : public ::testing::TestWithParam<vision::LensCamera> {};

TEST_P(RectifiedPairOf, ShowsPointsOnOneRowAndPixelsThatBothSee) {
  const auto rig = test::stereo_pair(GetParam());
  const auto pair = rectify(rig[0], rig[1]);
  EXPECT_NEAR(pair.baseline_m, (rig[1].camera_from_reference.inverse().translation()).norm(), 1e-12);
  EXPECT_TRUE(vision::validate(pair).empty());
  const Eigen::Isometry3d& right_from_left = rig[1].camera_from_reference;
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(0.3, 0.2, 2.0), Eigen::Vector3d(-0.5, -0.3, 1.2), Eigen::Vector3d(0.1, 0.6, 9.0)}) {
    const Eigen::Vector2d left = pair.camera.project(pair.rectified_left_from_left * point);
    const Eigen::Vector2d right = pair.camera.project(pair.rectified_right_from_right * (right_from_left * point));
    EXPECT_NEAR(left.y(), right.y(), 1e-9);
    const double depth = (pair.rectified_left_from_left * point).z();
    EXPECT_NEAR(left.x() - right.x(), pair.camera.fx * pair.baseline_m / depth, 1e-9);
  }
  const vision::CameraModel left_model(rig[0].lens), right_model(rig[1].lens);
  int at_border = 0;
  for (int v = 0; v < pair.camera.height; v += 16) {
    for (int u = 0; u < pair.camera.width; u += 16) {
      const Eigen::Vector3d ray = pair.camera.unproject({u, v});
      const auto left = left_model.project(pair.rectified_left_from_left.transpose() * ray);
      const auto right = right_model.project(pair.rectified_right_from_right.transpose() * ray);
      ASSERT_TRUE(left && right && rig[0].lens.pinhole.contains(*left) && rig[1].lens.pinhole.contains(*right))
          << u << " " << v;
      at_border += rig[0].lens.pinhole.contains(*left, 24.0) && rig[1].lens.pinhole.contains(*right, 24.0) ? 0 : 1;
    }
  }
  const bool is_as_wide_as_allowed = 2.0 * std::atan(0.5 * pair.camera.width / pair.camera.fx) > 1.85;
  EXPECT_TRUE(at_border > 0 || is_as_wide_as_allowed);
}

INSTANTIATE_TEST_SUITE_P(Lenses, RectifiedPairOf, ::testing::Values(test::plumb_bob(), test::fisheye()));

TEST(RectifiedPair, RefusesCamerasThatAreNoPair) {
  const auto refusal = [](const RigCamera& left, const RigCamera& right) {
    try {
      rectify(left, right);
    } catch (const CalibrationError& error) {
      return std::string(error.what());
    }
    return std::string("rectified");
  };
  const auto rig = test::stereo_pair(test::plumb_bob());
  EXPECT_THAT(refusal(rig[1], rig[0]), HasSubstr("left and right swapped"));
  EXPECT_THAT(refusal(rig[0], {test::lens(LensModel::kPlumbBob, 300.0, {}, 320, 240), rig[1].camera_from_reference}),
              HasSubstr("320 x 240"));
  EXPECT_THAT(refusal(rig[0], {rig[0].lens, test::camera_at({0.0, 0.3, 0.0}, {0, 0, 0})}), HasSubstr("side by side"));
}

TEST(EpipolarErrors, AreTheRowsByWhichTheRightImageIsLower) {
  const auto rig = test::stereo_pair(test::plumb_bob());
  const auto boards = test::hold_boards(kBoard, rig, 8, 8.0, 0.7, 3);
  auto observations = test::observe(kBoard, rig, boards, 0.0, 3);
  const auto pair = rectify(rig[0], rig[1]);
  const auto good = summarise(epipolar_errors(observations, rig[0].lens, rig[1].lens, pair));
  ASSERT_GT(good.corners, 200U);
  EXPECT_LT(good.max_px, 1e-6);
  auto lower = rig[1].lens;
  lower.pinhole.cy -= 1.0;  // places its corners one pixel too low
  const auto bad = summarise(epipolar_errors(observations, rig[0].lens, lower, pair));
  EXPECT_NEAR(bad.mean_px, 1.0, 0.2);
  EXPECT_NEAR(bad.rms_px, bad.mean_px, 0.05);
  EXPECT_EQ(summarise({}).corners, 0U);
}

TEST(Coverage, CountsCellsThatHoldCorners) {
  Observations observations{
      {"camera"}, {{800, 600}}, {}, {{"view", {{{0, {50.0, 50.0}}, {1, {60.0, 60.0}}, {2, {799.0, 599.0}}}}}}};
  const auto found = coverage(observations, 0);
  EXPECT_EQ(found.corners[0], 2);
  EXPECT_EQ(found.corners.back(), 1);
  EXPECT_NEAR(found.share, 2.0 / 48.0, 1e-12);
}

/// Points and pixels in the format of OpenCV's calibration.
struct ForOpenCv {
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;

  explicit ForOpenCv(const Observations& observations) {
    for (const auto& view : observations.views) {
      if (view.seen[0].empty()) continue;
      points.emplace_back();
      pixels.emplace_back();
      for (const auto& corner : view.seen[0]) {
        const auto& point = observations.board_points[static_cast<std::size_t>(corner.id)];
        points.back().emplace_back(point.x(), point.y(), 0.0);
        pixels.back().emplace_back(corner.pixel.x(), corner.pixel.y());
      }
    }
  }
};

RigCalibration calibrate_alone(const Observations& observations, LensModel model) {
  return calibrate(observations, {{model}, {std::nullopt}});
}

TEST(OpenCv, FindsTheSamePerspectiveLens) {
  const std::vector<RigCamera> camera{{test::plumb_bob()}};
  const auto observations = test::observe(kBoard, camera, test::hold_boards(kBoard, camera, 20, 22.0, 0.5, 3), 0.1, 4);
  const auto found = calibrate_alone(observations, LensModel::kPlumbBob);
  const ForOpenCv data(observations);
  cv::Mat matrix, distortion;
  std::vector<cv::Mat> turns, places;
  const double rms = cv::calibrateCamera(data.points, data.pixels, {640, 480}, matrix, distortion, turns, places);
  EXPECT_NEAR(rms_px(found.residuals), rms, 1e-4);
  const auto& lens = found.rig.cameras[0].lens;
  EXPECT_NEAR(lens.pinhole.fx, matrix.at<double>(0, 0), 0.01);
  EXPECT_NEAR(lens.pinhole.fy, matrix.at<double>(1, 1), 0.01);
  EXPECT_NEAR(lens.pinhole.cx, matrix.at<double>(0, 2), 0.01);
  EXPECT_NEAR(lens.pinhole.cy, matrix.at<double>(1, 2), 0.01);
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(lens.distortion.at(static_cast<std::size_t>(i)), distortion.at<double>(i), 1e-3) << i;
}

TEST(OpenCv, FindsTheSameFisheye) {
  const std::vector<RigCamera> camera{{test::fisheye()}};
  const auto observations = test::observe(kBoard, camera, test::hold_boards(kBoard, camera, 20, 40.0, 0.4, 3), 0.1, 4);
  const auto found = calibrate_alone(observations, LensModel::kEquidistant);
  const ForOpenCv data(observations);
  // From its own first guess, OpenCV 4.10 ends with an error.
  const double about = 1.1 * camera[0].lens.pinhole.fx;
  cv::Mat matrix = (cv::Mat_<double>(3, 3) << about, 0.0, 320.0, 0.0, about, 240.0, 0.0, 0.0, 1.0);
  cv::Mat distortion = cv::Mat::zeros(4, 1, CV_64F);
  std::vector<cv::Mat> turns, places;
  cv::fisheye::calibrate(
      data.points, data.pixels, {640, 480}, matrix, distortion, turns, places,
      cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW | cv::fisheye::CALIB_USE_INTRINSIC_GUESS,
      {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-10});
  const auto& lens = found.rig.cameras[0].lens;
  EXPECT_NEAR(lens.pinhole.fx, matrix.at<double>(0, 0), 0.01);
  EXPECT_NEAR(lens.pinhole.cy, matrix.at<double>(1, 2), 0.01);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(lens.distortion.at(static_cast<std::size_t>(i)), distortion.at<double>(i), 1e-3) << i;
}

}  // namespace
}  // namespace panvo::calibration
