// SPDX-License-Identifier: Apache-2.0
// A run and its recording with known results: 50 m along a street and back, 1 m/s.
#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "panvo/test/temporary_folder.hpp"
#include "trajectories.hpp"

namespace panvo::evaluation {

/// The estimates drift to the left by 2 cm and turn by 0.5 mrad per metre. Place 7 is passed after 10 m and, on the way
/// back, after 90 m, where the enhanced pose is corrected to an error of 0.25 m without heading error. Its landmark has
/// an error of 0.2 m.
class MadeJourney : public ::testing::Test {
 protected:
  static constexpr int kSeconds = 100;
  static constexpr double kDrift = 0.02, kTurn = 0.0005;

  static std::int64_t stamp(int second) { return 1'700'000'000'000'000'000 + 1'000'000'000LL * second; }
  static Eigen::Isometry3d map_from_base(int second) {
    return make_pose(second <= 50 ? second : 100 - second, 0.0, 0.0, second < 50 ? 0.0 : std::numbers::pi);
  }
  static Eigen::Isometry3d world_from_map() { return make_pose(100.0, 200.0, 0.0, std::numbers::pi / 2.0); }
  static Eigen::Isometry3d off(int second, double left_m, double turn_rad) {
    return make_pose(0.0, left_m, 0.0) * map_from_base(second) * make_pose(0.0, 0.0, 0.0, turn_rad);
  }
  static Eigen::Isometry3d binocular(int second) { return off(second, kDrift * second, kTurn * second); }
  static Eigen::Isometry3d enhanced(int second) { return second < 90 ? binocular(second) : off(second, 0.25, 0.0); }

  static std::string numbers_of(const Eigen::Isometry3d& pose, const char* separator) {
    const Eigen::Quaterniond turn(pose.linear());
    std::string text;
    for (const double number : {pose.translation().x(), pose.translation().y(), pose.translation().z(), turn.x(),
                                turn.y(), turn.z(), turn.w()}) {
      text += fmt::format("{}{:.12f}", separator, number);
    }
    return text;
  }
  static std::string pose_columns(const std::string& prefix) {
    std::string text;
    for (const char* name : {"x", "y", "z", "qx", "qy", "qz", "qw"}) text += "," + prefix + name;
    return text;
  }

  void SetUp() override {
    write_recording("recording");
    write_run();
  }

  /// `left_m`: lateral offset of the drive to the left of the street.
  void write_recording(const std::string& name, double left_m = 0.0) const {
    std::string truth = "#timestamp, x, y, z, qw, qx, qy, qz\n";
    for (int s = 0; s <= kSeconds; ++s) {
      const auto pose = world_from_map() * make_pose(0.0, left_m, 0.0) * map_from_base(s);
      const Eigen::Quaterniond turn(pose.linear());
      truth += fmt::format("{},{:.12f},{:.12f},0,{:.12f},{:.12f},{:.12f},{:.12f}\n", stamp(s), pose.translation().x(),
                           pose.translation().y(), turn.w(), turn.x(), turn.y(), turn.z());
    }
    folder_.write(name + "/mav0/state_groundtruth_estimate0/data.csv", truth);
    folder_.write(name + "/mav0/cam2/sensor.yaml",
                  "%YAML:1.0\nT_BS:\n  data: [0, 0, 1, 0.5, -1, 0, 0, 0, 0, -1, 0, 2, 0, 0, 0, 1]\n"
                  "resolution: [1080, 540]\ncamera_model: equirectangular\n");
    folder_.write(name + "/mav0/cam2/data.csv", fmt::format("{0},{0}.png\n{1},{1}.png\n", stamp(10), stamp(90)));
    folder_.write(
        name + "/sequence.yaml",
        fmt::format(
            "%YAML:1.0\nroute: street\nseed: 4\neffects: [movers]\njunctions:\n  - {{id: 7, name: corner <7>, x: "
            "100, y: 210}}\nvisits:\n"
            "  - {{visit: 0, id: 7, t_ns: {}, t_in_ns: {}, t_out_ns: {}, heading_in: 90}}\n"
            "  - {{visit: 1, id: 7, t_ns: {}, t_in_ns: {}, t_out_ns: {}, heading_in: -90}}\n"
            "movers:\n  - {{from_ns: {}, to_ns: {}, kind: oncoming}}\n  - {{from_ns: {}, to_ns: {}, kind: "
            "pedestrian}}\n",
            stamp(10), stamp(8), stamp(12), stamp(90), stamp(88), stamp(92), stamp(20), stamp(28), stamp(25),
            stamp(30)));
    for (const int second : {10, 90}) {
      cv::Mat noise(540, 1080, CV_8UC3);
      cv::RNG(17).fill(noise, cv::RNG::UNIFORM, 0, 255);
      const auto folder = folder_ / name / "mav0/cam2/data";
      std::filesystem::create_directories(folder);
      cv::imwrite((folder / (std::to_string(stamp(second)) + ".png")).string(), noise);
    }
  }

  void write_run() const {
    std::string poses, enhanced_poses, covariances = "stamp_ns", azimuths, qualities;
    for (const char part : {'p', 't'}) {
      for (int i = 0; i < 36; ++i) covariances += fmt::format(",{}{}{}", part, i / 6, i % 6);
    }
    covariances += ",vx,vy,vz,wx,wy,wz\n";
    for (int s = 0; s <= kSeconds; ++s) {
      const auto time = fmt::format("{}.000000000", stamp(s) / 1'000'000'000);
      poses += time + numbers_of(binocular(s), " ") + "\n";
      enhanced_poses += time + numbers_of(enhanced(s), " ") + "\n";
      covariances += fmt::format("{}", stamp(s));
      for (int i = 0; i < 36; ++i) {
        const double left_m = s < 90 ? kDrift * s : 0.25;
        covariances += fmt::format(",{:.12g}", i == 7       ? left_m * left_m
                                               : i == 35    ? std::pow(kTurn * s, 2)
                                               : i % 7 == 0 ? 1.0
                                                            : 0.0);
      }
      for (int i = 0; i < 36 + 6; ++i) covariances += ",0";
      covariances += "\n";
      if (s == 0) continue;
      azimuths += fmt::format("{},{},{:.9f},0.001,0.01,{},\"\"\n", stamp(s), stamp(s - 1),
                              0.001 + (s == 50 ? std::numbers::pi : 0.0), s == 60 ? 0 : 1);
      qualities += fmt::format("{},{},9,9,9,0.9,0.4,\"\"\n", stamp(s), s >= 41 && s <= 45 ? 0 : 1);
    }
    folder_.write("run/odometry_binocular.tum", poses);
    folder_.write("run/odometry_enhanced.tum", enhanced_poses);
    folder_.write("run/odometry_enhanced_covariance.csv", covariances);
    folder_.write("run/azimuth.csv",
                  "stamp_ns,from_stamp_ns,azimuth_change_rad,sigma_rad,side_parallax_rad,valid,reason\n" + azimuths);
    folder_.write("run/quality.csv",
                  "stamp_ns,reliable,detected,tracked,inliers,inlier_ratio,residual_px,reason\n" + qualities);
    folder_.write("run/landmarks.csv",
                  "stamp_ns,id,is_junction" + pose_columns("") + ",sigma_x_m,sigma_y_m,keypoints,points\n" +
                      fmt::format("{},3,1{},0.1,0.1,250,100\n", stamp(10), numbers_of(binocular(10), ",")));
    folder_.write("run/states.csv",
                  fmt::format("stamp_ns,state,position_sigma_m,heading_sigma_rad,reason\n{},tracking,0.1,0.01,\"\"\n"
                              "{},compass_only,0.2,,\"few features, \"\"all\"\" moving\"\n",
                              stamp(0), stamp(41)));
    folder_.write("run/integrity.csv",
                  fmt::format("stamp_ns,usable,reason,risk,hpl_m,alert_limit_m\n{},1,\"\",0.001,0.5,2\n{},0,\"lost\","
                              "0.001,,2\n",
                              stamp(0), stamp(1)));
    folder_.write("run/timing.json",
                  R"({"components": {"landmark_builder": {"stages": {"junction": {"count": 4,
            "wall_ms": {"mean": 8, "median": 7.5, "p95": 9, "p99": 10, "max": 11},
            "cpu_ms": {"mean": 8, "median": 7.5, "p95": 9, "p99": 10, "max": 11}}}}}})");
    folder_.write("run/summary.json",
                  R"({"version": "0.1.0", "system_file": "enhanced_vo.yaml", "replay": true, "seed": 5, "problems": [],
            "wall_s": 3.5, "changed_parameters": {"landmark_store": {"file": "kept.sqlite"}}})");
    write_matches("");
    write_corrections("");
    write_outcomes(outcome(90, "applied", binocular(90), enhanced(90)));
  }

  void write_matches(const std::string& lines) const {
    folder_.write("run/matches.csv",
                  "stamp_ns,state,landmark_id,heading_deg,histogram_distance,large_distance,small_distance,candidates,"
                  "kept_after_histogram,kept_after_large,reason\n" +
                      lines);
  }
  void write_corrections(const std::string& lines) const {
    folder_.write("run/corrections.csv", "stamp_ns,landmark_id,state,inliers" + pose_columns("") +
                                             ",sigma_x_m,sigma_y_m,sigma_yaw_rad,reason\n" + lines);
  }
  void write_outcomes(const std::string& lines) const {
    folder_.write("run/outcomes.csv", "stamp_ns,landmark_id,outcome,chi_square" + pose_columns("before_") +
                                          pose_columns("after_") + ",reason\n" + lines);
  }
  static std::string outcome(int second, const std::string& what, const Eigen::Isometry3d& before,
                             const Eigen::Isometry3d& after, const std::string& reason = "") {
    return fmt::format("{},3,{},4.5{}{},\"{}\"\n", stamp(second), what, numbers_of(before, ","), numbers_of(after, ","),
                       reason);
  }

  panvo::test::TemporaryFolder folder_;
};

}  // namespace panvo::evaluation
