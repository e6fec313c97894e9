// SPDX-License-Identifier: Apache-2.0
// Places of real recordings: found again in other frames of their own recording, never in another one.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "panvo/stereo_places/stereo_places.hpp"
#include "panvo/test/recorded_data.hpp"

namespace panvo::stereo_places {
namespace {

namespace fs = std::filesystem;
using panvo::test::recorded_data;

/// The camera's axes: X right, Y down, Z ahead; the base's: X ahead, Y left, Z up.
Eigen::Isometry3d base_from_left() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return pose;
}

/// KITTI odometry sequence 03, frames 0 to 98, with its true poses.
class Kitti {
 public:
  Kitti() : folder_(recorded_data("kitti_03")) {
    std::ifstream file(folder_ / "poses.txt");
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      Eigen::Matrix<double, 3, 4, Eigen::RowMajor> numbers;
      for (int i = 0; i < 12; ++i) words >> numbers.data()[i];
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.linear() = vision::nearest_rotation(numbers.leftCols<3>());
      pose.translation() = numbers.col(3);
      poses_.push_back(base_from_left() * pose * base_from_left().inverse());
    }
  }

  static vision::RectifiedStereo stereo(cv::Size size) {
    return {{721.5377, 721.5377, 609.5593, 172.854, size.width, size.height}, 0.53716};
  }

  cv::Mat image(const char* camera, int frame) const {
    std::ostringstream name;
    name << std::setfill('0') << std::setw(6) << frame << ".png";
    return cv::imread((folder_ / camera / name.str()).string(), cv::IMREAD_GRAYSCALE);
  }

  const Eigen::Isometry3d& truth(int frame) const { return poses_.at(static_cast<std::size_t>(frame)); }

 private:
  fs::path folder_;
  std::vector<Eigen::Isometry3d> poses_;
};

class RecordedPlaces : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(recorded_data("kitti_03"))) GTEST_SKIP() << "no recording kitti_03";
  }

  StereoPlaces made(const vision::RectifiedStereo& stereo) const {
    return {parameters, stereo, base_from_left(), std::make_shared<position_corrector::SpilledLandmarks>("")};
  }

  /// A view of the second journey, whose odometry begins elsewhere and whose position is unknown.
  static StereoView unlocated(const cv::Mat& left, const cv::Mat& right, std::int64_t stamp_ns,
                              const Eigen::Isometry3d& odom_from_base, double way_m) {
    StereoView view{stamp_ns, left, right, odom_from_base, way_m, {}};
    view.pose.map_from_base = odom_from_base;
    view.pose.covariance = 1e8 * vision::Matrix6d::Identity();
    view.pose.is_located = false;
    return view;
  }

  /// The map of KITTI's even frames.
  std::vector<landmarks::PanoramicLandmark> map_of(const Kitti& kitti) const {
    auto places = made(Kitti::stereo(kitti.image("image_0", 0).size()));
    std::vector<landmarks::PanoramicLandmark> map;
    double way_m = 0.0;
    for (int frame = 0; frame < 99; frame += 2) {
      if (frame > 0) way_m += (kitti.truth(frame).translation() - kitti.truth(frame - 2).translation()).norm();
      StereoView view{1'000'000'000 + frame * 100'000'000LL,
                      kitti.image("image_0", frame),
                      kitti.image("image_1", frame),
                      kitti.truth(frame),
                      way_m,
                      {}};
      view.pose = {kitti.truth(frame), 1e-4 * vision::Matrix6d::Identity(), true};
      if (!places.is_due(view.stamp_ns, view.odom_from_base, view.way_m)) continue;
      if (const auto result = places.step(view); result.built) map.push_back(*result.built);
    }
    return map;
  }

  Parameters parameters;
};

TEST_F(RecordedPlaces, AreFoundAgainInOtherFramesOfTheSameDrive) {
  const Kitti kitti;
  const auto map = map_of(kitti);
  ASSERT_GE(map.size(), 5U);
  ASSERT_LE(map.size(), 20U);
  auto places = made(Kitti::stereo(kitti.image("image_0", 0).size()));
  for (const auto& landmark : map) places.add(landmark);
  const Eigen::Isometry3d elsewhere(Eigen::Translation3d(70.0, -20.0, 1.0) *
                                    Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()));
  double way_m = 0.0;
  int views = 0, corrections = 0;
  for (int frame = 11; frame < 99; frame += 2) {
    way_m += (kitti.truth(frame).translation() - kitti.truth(frame - 2).translation()).norm();
    const std::int64_t stamp_ns = 3600'000'000'000 + frame * 100'000'000LL;
    const Eigen::Isometry3d odom_from_base = elsewhere * kitti.truth(frame);
    if (!places.is_due(stamp_ns, odom_from_base, way_m)) continue;
    ++views;
    const auto result = places.step(
        unlocated(kitti.image("image_0", frame), kitti.image("image_1", frame), stamp_ns, odom_from_base, way_m));
    if (!result.correction) continue;
    ++corrections;
    const auto& landmark = map.at(result.correction->landmark_id - 1);
    const Eigen::Isometry3d found = landmark.map_from_base * result.correction->pose.landmark_from_base;
    EXPECT_LT((found.translation() - kitti.truth(frame).translation()).norm(), 0.25) << "frame " << frame;
    EXPECT_LT((kitti.truth(frame).translation() - landmark.map_from_base.translation()).norm(), 15.0);
  }
  RecordProperty("views", views);
  RecordProperty("corrections", corrections);
  EXPECT_GE(corrections, views / 2);
}

TEST_F(RecordedPlaces, AreNotFoundInOtherRecordings) {
  const Kitti kitti;
  const auto map = map_of(kitti);
  int views = 0;
  for (const char* recording : {"euroc_v101", "campus_clip"}) {
    const auto left_folder = recorded_data(recording) / "mav0" / "cam0" / "data";
    if (!fs::exists(left_folder)) continue;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(left_folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::optional<StereoPlaces> places;
    for (std::size_t i = 0; i < files.size(); i += std::max<std::size_t>(1, files.size() / 25)) {
      const cv::Mat left = cv::imread(files[i].string(), cv::IMREAD_GRAYSCALE);
      if (!places) {
        const vision::PinholeCamera camera{460.0, 460.0, 0.5 * left.cols, 0.5 * left.rows, left.cols, left.rows};
        places.emplace(made({camera, 0.11}));
        for (const auto& landmark : map) places->add(landmark);
      }
      ++views;
      // each view is judged alone: the map's poses and a fixed odometry would let any run agree with itself
      const auto result = places->step(unlocated(left, left, 3600'000'000'000 + views * 1'000'000'000LL,
                                                 Eigen::Isometry3d::Identity(), 2.0 * views));
      EXPECT_EQ(result.match.state, position_corrector::MatchState::kRejected);
      EXPECT_EQ(result.match.reason.find("waiting"), std::string::npos) << files[i] << ": " << result.match.reason;
    }
  }
  EXPECT_GT(views, 0) << "no other recording";
}

}  // namespace
}  // namespace panvo::stereo_places
