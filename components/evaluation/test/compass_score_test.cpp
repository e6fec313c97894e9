// SPDX-License-Identifier: Apache-2.0
// On painted panoramas with known errors.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "panvo/evaluation/compass_score.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::evaluation {
namespace {

/// Panoramas that never turn, while the ground truth turns on by `kTurn_deg` with each: this is the error of each step.
class StandingCompass : public ::testing::Test {
 protected:
  static constexpr double kTurn_deg = 0.1;

  /// Adds `count` panoramas of a scene of its own.
  void see_scene(int scene, int count) {
    cv::RNG random(static_cast<std::uint64_t>(scene));
    cv::Mat image(540, 1080, CV_8UC1, cv::Scalar(128));
    for (int i = 0; i < 6000; ++i) {
      const int x = random.uniform(0, image.cols), y = random.uniform(0, image.rows);
      const int width = random.uniform(4, 24), height = random.uniform(4, 24);
      cv::rectangle(image, cv::Rect(x, y, width, height), cv::Scalar(random.uniform(20, 235)), cv::FILLED);
    }
    cv::GaussianBlur(image, image, {5, 5}, 1.0);
    see(image, count);
  }

  void see_darkness(int count) { see(cv::Mat(540, 1080, CV_8UC1, cv::Scalar(0)), count); }

  void see(const cv::Mat& image, int count) {
    const auto file = folder / (std::to_string(panoramas.size()) + ".png");
    cv::imwrite(file.string(), image);
    for (int i = 0; i < count; ++i) {
      const auto now = static_cast<std::int64_t>(panoramas.size());
      RecordedPanorama panorama{.stamp_ns = 100'000'000 * (now + 1), .file = file};
      const double yaw_rad = static_cast<double>(now) * kTurn_deg * vision::kDegree;
      panorama.world_from_base.rotate(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
      panoramas.push_back(panorama);
    }
  }

  CompassScore score() const { return score_compass(panoramic_compass::upright_base_from_panorama(), panoramas, {}); }

  const panvo::test::TemporaryFolder folder;
  std::vector<RecordedPanorama> panoramas;
};

TEST_F(StandingCompass, DriftsByTheErrorOfFiftySteps) {
  see_scene(1, 60);
  const auto all = score();
  EXPECT_EQ(all.valid, 59);
  ASSERT_TRUE(all.drift_rms_deg);
  EXPECT_NEAR(*all.drift_rms_deg, 50 * kTurn_deg, 0.01);
  EXPECT_NEAR(all.step_rms_deg, kTurn_deg, 0.01);
}

TEST_F(StandingCompass, HasNoDriftAcrossThreeFailures) {
  see_scene(1, 60);
  see_scene(2, 60);  // like none before: the third is the new reference
  const auto all = score();
  EXPECT_EQ(all.changes - all.valid, 3);
  ASSERT_TRUE(all.drift_rms_deg);
  EXPECT_NEAR(*all.drift_rms_deg, 50 * kTurn_deg, 0.01);
}

TEST_F(StandingCompass, HasNoDriftIfThereAreNoFiftyStepsWithoutAGap) {
  see_scene(1, 40);
  see_scene(2, 40);
  const auto all = score();
  EXPECT_EQ(all.changes - all.valid, 3);
  EXPECT_FALSE(all.drift_rms_deg);
}

TEST_F(StandingCompass, GoesOnAfterAFailureThatKeepsTheReference) {
  see_scene(1, 40);
  see_darkness(1);
  see_scene(1, 20);
  const auto all = score();
  EXPECT_EQ(all.changes - all.valid, 1);
  ASSERT_TRUE(all.drift_rms_deg);
  EXPECT_NEAR(*all.drift_rms_deg, 51 * kTurn_deg, 0.01);  // over one panorama more
}

}  // namespace
}  // namespace panvo::evaluation
