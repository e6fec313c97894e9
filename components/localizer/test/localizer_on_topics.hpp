// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::localizer {

inline constexpr std::int64_t kBegin_ns = 1'700'000'000'000'000'000;
inline constexpr std::int64_t kPeriod_ns = 40'000'000;

inline Eigen::Isometry3d at(double x, double y, double yaw) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, 0.0);
  pose.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

/// The component, with messages in and out.
class LocalizerOnTopics : public ::testing::Test {
 protected:
  void load(const std::map<std::string, std::string>& parameters = {}) {
    harness_.load("panvo_localizer", "LocalizerComponent", parameters);
  }

  static std::int64_t stamp(int frame) { return kBegin_ns + frame * kPeriod_ns; }

  void publish_odometry(int frame, const Eigen::Isometry3d& pose, double variance) {
    publish_odometry(frame, pose, vision::Matrix6d(variance * vision::Matrix6d::Identity()));
  }
  void publish_odometry(int frame, const Eigen::Isometry3d& pose, const vision::Matrix6d& covariance) {
    nav_msgs::msg::Odometry odometry;
    odometry.header().stamp(conversions::to_stamp(stamp(frame)));
    odometry.header().frame_id("odom");
    odometry.child_frame_id("base_link");
    odometry.pose().pose(conversions::to_pose(pose));
    odometry.pose().covariance(conversions::to_array(covariance));
    odometry.twist().twist().linear().x(5.0);
    harness_.publish(topics::kOdometryBinocular, odometry);
  }

  /// Drives straight, 0.2 m per frame.
  void drive(int from, int to) {
    for (int i = from; i < to; ++i) publish_odometry(i, at(0.2 * i, 0.0, 0.0), 1e-4 + 1e-4 * i);
  }

  void publish_quality(int frame, bool is_reliable) {
    panvo_msgs::msg::OdometryQuality quality;
    quality.header().stamp(conversions::to_stamp(stamp(frame)));
    quality.reliable(is_reliable);
    harness_.publish(topics::kOdometryQuality, quality);
  }
  void drive_with_quality(int from, int to, bool is_reliable) {
    for (int i = from; i < to; ++i) {
      publish_quality(i, is_reliable);
      drive(i, i + 1);
    }
  }

  void publish_landmark(std::uint32_t id, std::int64_t stamp_ns, const Eigen::Isometry3d& pose) {
    panvo_msgs::msg::PanoramicLandmark landmark;
    landmark.header().stamp(conversions::to_stamp(stamp_ns));
    landmark.id(id);
    landmark.histogram({1.0F});
    landmark.pose().pose(conversions::to_pose(pose));
    landmark.pose().covariance(conversions::to_array(1e-4 * vision::Matrix6d::Identity()));
    harness_.publish(topics::kLandmarks, landmark);
  }

  void publish_correction(std::uint32_t id, std::int64_t stamp_ns, const Eigen::Isometry3d& landmark_from_base,
                          std::uint8_t state = panvo_msgs::msg::PositionCorrection_Constants::FULL) {
    panvo_msgs::msg::PositionCorrection correction;
    correction.header().stamp(conversions::to_stamp(stamp_ns));
    correction.landmark_id(id);
    correction.state(state);
    correction.landmark_from_base().pose(conversions::to_pose(landmark_from_base));
    correction.landmark_from_base().covariance(conversions::to_array(1e-4 * vision::Matrix6d::Identity()));
    harness_.publish(topics::kCorrection, correction);
  }

  void publish_azimuth(std::int64_t from_ns, std::int64_t to_ns, double change_rad) {
    panvo_msgs::msg::AzimuthChange change;
    change.header().stamp(conversions::to_stamp(to_ns));
    change.from_stamp(conversions::to_stamp(from_ns));
    change.azimuth_change_rad(change_rad);
    change.variance_rad2(1e-6);
    change.valid(true);
    harness_.publish(topics::kAzimuthChange, change);
  }

  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const nav_msgs::msg::Odometry>>& enhanced_ =
      harness_.collect(topics::kOdometryEnhanced);
  const std::vector<std::shared_ptr<const tf2_msgs::msg::TFMessage>>& tf_ = harness_.collect(topics::kTf);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::LocalizationState>>& states_ =
      harness_.collect(topics::kLocalizationState);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::CorrectionOutcome>>& outcomes_ =
      harness_.collect(topics::kCorrectionOutcome);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::LandmarkPoses>>& poses_ =
      harness_.collect(topics::kLandmarkPoses);
  const std::vector<std::shared_ptr<const nav_msgs::msg::Path>>& paths_ = harness_.collect(topics::kPathEnhanced);
};

}  // namespace panvo::localizer
