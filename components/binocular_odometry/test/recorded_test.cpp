// SPDX-License-Identifier: Apache-2.0
// Accuracy on real recordings, with each pose as published at its time.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "panvo/binocular_odometry/binocular_odometry.hpp"
#include "panvo/test/recorded_data.hpp"
#include "panvo/vision/absolute_orientation.hpp"
#include "panvo/vision/rectification.hpp"
#include "panvo/vision/stereo_calibration.hpp"

namespace panvo::binocular_odometry {
namespace {

namespace fs = std::filesystem;
using panvo::test::recorded_data;

// Estimated and true poses of the left camera.
struct Drive {
  std::vector<Eigen::Isometry3d> estimated, truth;
  int unreliable = 0;
  double nees = 0.0;  // mean over frame-to-frame motions

  void add(const OdometryEstimate& estimate, const Eigen::Isometry3d& world_from_left) {
    if (!truth.empty()) {
      const vision::Vector6d error =
          vision::pose_error(estimate.previous_from_current, truth.back().inverse() * world_from_left);
      nees_sum_ += error.dot(estimate.previous_from_current_covariance.ldlt().solve(error));
      nees = nees_sum_ / static_cast<double>(truth.size());
    }
    estimated.push_back(estimate.odom_from_left);
    truth.push_back(world_from_left);
    unreliable += estimate.quality.reliable ? 0 : 1;
  }

  double absolute_trajectory_error_m() const {
    std::vector<Eigen::Vector3d> in_world, in_odom;
    for (size_t i = 0; i < truth.size(); ++i) {
      in_world.push_back(truth[i].translation());
      in_odom.push_back(estimated[i].translation());
    }
    const auto world_from_odom = vision::absolute_orientation(in_world, in_odom);
    if (!world_from_odom) return std::numeric_limits<double>::infinity();
    double sum = 0.0;
    for (size_t i = 0; i < truth.size(); ++i) sum += (in_world[i] - *world_from_odom * in_odom[i]).squaredNorm();
    return std::sqrt(sum / static_cast<double>(truth.size()));
  }

  double path_length_m() const {
    double length = 0.0;
    for (size_t i = 1; i < truth.size(); ++i) length += (truth[i].translation() - truth[i - 1].translation()).norm();
    return length;
  }

  double end_error() const {  // per path length
    const Eigen::Isometry3d moved = truth.front().inverse() * truth.back();
    return (moved.translation() - estimated.back().translation()).norm() / path_length_m();
  }

 private:
  double nees_sum_ = 0.0;
};

cv::Mat grey(const fs::path& file) { return cv::imread(file.string(), cv::IMREAD_GRAYSCALE); }

/// Modifies a pair before the odometry processes it; returns false if the pair is lost.
using Disturbance = std::function<bool(int frame, cv::Mat& left, cv::Mat& right)>;

/// Calls `take` with each estimate and the true pose.
template <class Take>
void step_through_kitti_03(const Parameters& parameters, const Disturbance& disturb, const Take& take) {
  const fs::path folder = recorded_data("kitti_03");
  BinocularOdometry odometry({{721.5377, 721.5377, 609.5593, 172.854, 1242, 375}, 387.5744 / 721.5377}, parameters);
  std::ifstream poses(folder / "poses.txt");
  int frame = 0;
  for (std::string line; std::getline(poses, line); ++frame) {
    std::istringstream numbers(line);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) numbers >> pose.matrix()(row, column);
    }
    char name[16];
    std::snprintf(name, sizeof name, "%06d.png", frame);
    cv::Mat left = grey(folder / "image_0" / name), right = grey(folder / "image_1" / name);
    if (disturb(frame, left, right)) take(odometry.step({1 + frame * 100'000'000LL, left, right}), pose);
  }
}

Drive drive_kitti_03(const Parameters& parameters) {
  Drive run;
  const auto leave = [](int, cv::Mat&, cv::Mat&) { return true; };
  step_through_kitti_03(parameters, leave, [&](const auto& estimate, const auto& pose) { run.add(estimate, pose); });
  return run;
}

TEST(RecordedKitti03, KeepsToTheTruePathWithAnHonestCovariance) {
  PANVO_NEEDS_RECORDING(recorded_data("kitti_03"));
  const Drive run = drive_kitti_03({});
  EXPECT_EQ(run.unreliable, 0);
  EXPECT_LT(run.absolute_trajectory_error_m(), 0.09);
  EXPECT_GT(run.nees, 3.0);
  EXPECT_LT(run.nees, 12.0);  // expected 6; the ground truth itself is uncertain by a centimetre per frame
}

TEST(RecordedKitti03, IsFollowedAtLowRates) {
  PANVO_NEEDS_RECORDING(recorded_data("kitti_03"));
  for (const int every : {3, 5, 8, 12}) {  // at 12, up to 8 m between frames
    Drive run;
    step_through_kitti_03(
        {}, [&](int frame, cv::Mat&, cv::Mat&) { return frame % every == 0; },
        [&](const auto& estimate, const auto& pose) { run.add(estimate, pose); });
    EXPECT_EQ(run.unreliable, 0) << every;
    EXPECT_LT(run.absolute_trajectory_error_m(), every <= 8 ? 0.10 : 0.20) << every;
  }
}

TEST(RecordedKitti03, SiftKeepsToItAsWell) {
  PANVO_NEEDS_RECORDING(recorded_data("kitti_03"));
  Parameters parameters;
  parameters.tracking.front_end = "sift";
  const Drive run = drive_kitti_03(parameters);
  EXPECT_EQ(run.unreliable, 0);
  EXPECT_LT(run.absolute_trajectory_error_m(), 0.10);
}

/// Four seconds with black images, a gap, frozen cameras, or one that is late by an image.
TEST(RecordedKitti03, ItsErrorLiesWithinItsCovarianceWhenCamerasLie) {
  PANVO_NEEDS_RECORDING(recorded_data("kitti_03"));
  cv::Mat last_left, last_right, image_before;
  const auto lie_with = [](const Disturbance& disturb) {
    return [disturb](int frame, cv::Mat& left, cv::Mat& right) {
      return frame < 30 || frame >= 70 || disturb(frame, left, right);
    };
  };
  const auto remember = [&](int frame, const cv::Mat& left, const cv::Mat& right) {
    if (frame != 30) return;
    last_left = left.clone();
    last_right = right.clone();
  };
  const std::map<std::string, Disturbance> lies{
      {"black", [](int, cv::Mat& left, cv::Mat&) { return left.setTo(0), true; }},
      {"gap", [](int, cv::Mat&, cv::Mat&) { return false; }},
      {"left is late",
       [&](int, cv::Mat& left, cv::Mat&) {
         const cv::Mat now = left.clone();
         if (!image_before.empty()) left = image_before;
         image_before = now;
         return true;
       }},
      {"left hangs",
       [&](int frame, cv::Mat& left, cv::Mat& right) {
         remember(frame, left, right);
         left = last_left.clone();
         return true;
       }},
      {"right hangs",
       [&](int frame, cv::Mat& left, cv::Mat& right) {
         remember(frame, left, right);
         right = last_right.clone();
         return true;
       }},
      {"both hang", [&](int frame, cv::Mat& left, cv::Mat& right) {
         remember(frame, left, right);
         left = last_left.clone();
         right = last_right.clone();
         return true;
       }}};
  for (const auto& [name, lie] : lies) {
    int frames = 0, unreliable = 0;
    double sigma_m = 0.0;
    Eigen::Isometry3d first = Eigen::Isometry3d::Identity();
    step_through_kitti_03(
        {}, lie_with(lie), [&, &lie_name = name](const OdometryEstimate& estimate, const Eigen::Isometry3d& truth) {
          if (frames++ == 0) first = truth;
          unreliable += estimate.quality.reliable ? 0 : 1;
          if (frames < 10) return;
          const vision::Vector6d error = vision::pose_error(estimate.odom_from_left, first.inverse() * truth);
          const auto& covariance = estimate.odom_from_left_covariance;
          sigma_m = std::sqrt(covariance(0, 0) + covariance(2, 2));
          EXPECT_LT(std::hypot(error.x(), error.z()), 3.0 * sigma_m) << lie_name << ", " << estimate.stamp_ns;
        });
    EXPECT_GE(unreliable, name == "gap" ? 1 : 39) << name;
    EXPECT_LE(unreliable, 41) << name;
    EXPECT_GT(sigma_m, 15.0) << name;
    EXPECT_LT(sigma_m, 35.0) << name;
  }
}

/// Of the recording, 25 Hz, only every n-th frame.
Drive drive_campus_clip(int every = 1) {
  const fs::path folder = recorded_data("campus_clip/mav0");
  Eigen::Isometry3d body_from_left = Eigen::Isometry3d::Identity();  // T_BS of cam0/sensor.yaml
  body_from_left.matrix().topRows<3>() << 0.0107295935294, -0.213094586795, 0.976972657192, 2.18, -0.99991917156,
      0.00437821030042, 0.011936566599, 0.11, -0.0068210094781, -0.977021764524, -0.213030386275, 1.28;
  body_from_left.linear() = vision::nearest_rotation(body_from_left.linear());
  BinocularOdometry odometry({{402.4, 402.4, 318.6, 241.7, 640, 480}, 0.12}, {});
  Drive run;
  int frame = 0;
  std::ifstream poses(folder / "state_groundtruth_estimate0" / "data.csv");
  for (std::string line; std::getline(poses, line);) {
    if (line.starts_with('#')) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    std::int64_t stamp_ns = 0;
    double x = 0, y = 0, z = 0, qw = 1, qx = 0, qy = 0, qz = 0;
    numbers >> stamp_ns >> x >> y >> z >> qw >> qx >> qy >> qz;
    const std::string name = std::to_string(stamp_ns) + ".jpg";
    if (!fs::exists(folder / "cam0" / "data" / name) || frame++ % every != 0) continue;
    Eigen::Isometry3d world_from_body(Eigen::Quaterniond(qw, qx, qy, qz).normalized());
    world_from_body.translation() << x, y, z;
    run.add(odometry.step({stamp_ns, grey(folder / "cam0" / "data" / name), grey(folder / "cam1" / "data" / name)}),
            world_from_body * body_from_left);
  }
  return run;
}

TEST(RecordedCampusClip, KeepsToTheTruePath) {
  PANVO_NEEDS_RECORDING(recorded_data("campus_clip/mav0"));
  const Drive run = drive_campus_clip();
  ASSERT_EQ(run.truth.size(), 600u);
  EXPECT_EQ(run.unreliable, 0);
  EXPECT_LT(run.absolute_trajectory_error_m(), 0.03);
  EXPECT_LT(run.end_error(), 0.001);
  EXPECT_GT(run.nees, 0.4);  // expected 6; rendered without noise, while the covariance is tuned for real cameras
  EXPECT_LT(run.nees, 2.0);
}

/// 2.5 Hz in the turns of a junction: between two frames the heading changes by up to 10 degrees.
TEST(RecordedCampusClip, IsFollowedAtALowRateThroughTurns) {
  PANVO_NEEDS_RECORDING(recorded_data("campus_clip/mav0"));
  const Drive run = drive_campus_clip(10);
  EXPECT_EQ(run.unreliable, 0);
  EXPECT_LT(run.absolute_trajectory_error_m(), 0.06);
}

class RecordedBoofCv : public ::testing::TestWithParam<std::string> {};

TEST_P(RecordedBoofCv, IsFollowedWithoutLosingAFrame) {
  const fs::path folder = recorded_data("boofcv_stereo/" + GetParam());
  PANVO_NEEDS_RECORDING(folder);
  vision::StereoCalibration calibration;  // stereo_params.xml
  calibration.left = {{262.3070778, 263.4601134, 156.2254286, 123.7008161, 320, 240},
                      vision::LensModel::kPlumbBob,
                      {-0.3625365821, 0.1753275439, 0, 0, 0}};
  calibration.right = {{263.2186548, 264.3262398, 159.2020283, 122.9675210, 320, 240},
                       vision::LensModel::kPlumbBob,
                       {-0.3529996949, 0.1629746673, 0, 0, 0}};
  Eigen::Isometry3d left_from_right = Eigen::Isometry3d::Identity();
  left_from_right.matrix().topRows<3>() << 0.9999694757, -0.0021676589, 0.0075065916, 0.1200437426, 0.0021447608,
      0.9999930270, 0.0030571062, 0.0008974418, -0.0075131658, -0.0030409130, 0.9999671521, -0.0009149583;
  left_from_right.linear() = vision::nearest_rotation(left_from_right.linear());
  calibration.right_from_left = left_from_right.inverse();
  const vision::RectifiedStereo stereo = vision::rectify(calibration);
  const vision::RectificationMap left_map(calibration.left, stereo.rectified_left_from_left, stereo.camera);
  const vision::RectificationMap right_map(calibration.right, stereo.rectified_right_from_right, stereo.camera);
  BinocularOdometry odometry(stereo, {});
  int frames = 0;
  for (int i = 0; frames == 0 ? i < 2 : fs::exists(folder / "left" / ("left" + std::to_string(i) + ".jpg")); ++i) {
    const std::string number = std::to_string(i) + ".jpg";
    if (!fs::exists(folder / "left" / ("left" + number))) continue;  // numbered from 0 or from 1
    cv::Mat left, right;
    left_map.apply(grey(folder / "left" / ("left" + number)), left);
    right_map.apply(grey(folder / "right" / ("right" + number)), right);
    const OdometryEstimate estimate = odometry.step({1 + i * 66'666'667LL, left, right});
    EXPECT_TRUE(estimate.quality.reliable) << "pair " << i << ": " << estimate.quality.reason;
    ++frames;
  }
  EXPECT_GT(frames, 150);
}

INSTANTIATE_TEST_SUITE_P(Both, RecordedBoofCv, ::testing::Values("backyard", "library"));

}  // namespace
}  // namespace panvo::binocular_odometry
