// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/runtime/testing.hpp"
#include "synthetic_place.hpp"

namespace panvo::position_corrector {

inline constexpr std::int64_t kPeriod_ns = 200'000'000;

/// The component, with messages in and out.
class CorrectorOnTopics : public testing::Test {
 protected:
  explicit CorrectorOnTopics(const std::map<std::string, std::string>& parameters = {}) {
    harness.load("panvo_position_corrector", "PositionCorrectorComponent", parameters);
  }

  void publish_landmark(std::uint32_t id, unsigned seed, const landmarks::DescriptionSettings& settings) {
    auto landmark = landmark_of(place(seed), describer, Eigen::Vector3d(100.0 * id, 0.0, 0.0));
    landmark.id = id;
    landmark.base_from_panorama = mounted(2.0);
    harness.publish(topics::kLandmarks, to_message(landmark, settings, "map"));
  }
  void publish_landmark(std::uint32_t id, unsigned seed) {
    publish_landmark(id, seed, landmarks::landmark_settings({}, {}, 1));
  }

  void publish_panorama(const cv::Mat& panorama) {
    ++frames;
    auto message = conversions::make_image(frames * kPeriod_ns, "panorama", "mono8", panorama.cols, panorama.rows);
    cv::Mat pixels = conversions::pixels(*message);
    panorama.copyTo(pixels);
    if (has_noise) pixels.at<uchar>(0, frames % pixels.cols) ^= 1U;  // like sensor noise: no two images are equal
    harness.publish(topics::kPanorama, std::shared_ptr<const sensor_msgs::msg::Image>(message));
  }

  /// With the stamp of the next panorama.
  void publish_odometry(double x_m, double sigma_m, double speed_m_s = 0.0) {
    nav_msgs::msg::Odometry odometry;
    odometry.header().stamp(conversions::to_stamp((frames + 1) * kPeriod_ns));
    odometry.twist().twist().linear().x(speed_m_s);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().x() = x_m;
    odometry.pose().pose(conversions::to_pose(pose));
    odometry.pose().covariance(conversions::to_array(sigma_m * sigma_m * vision::Matrix6d::Identity()));
    harness.publish(topics::kOdometryBinocular, odometry);
  }

  void publish_mounting(double up_m) {
    tf2_msgs::msg::TFMessage message;
    message.transforms().push_back(conversions::to_static_transform(0, "base_link", "panorama", mounted(up_m)));
    harness.publish(topics::kTfStatic, message);
  }

  void publish_poses(const std::map<std::uint32_t, double>& x_by_id) {
    panvo_msgs::msg::LandmarkPoses message;
    for (const auto& [id, x_m] : x_by_id) {
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation().x() = x_m;
      message.ids().push_back(id);
      message.poses().emplace_back();
      message.poses().back().pose(conversions::to_pose(pose));
      message.poses().back().covariance(conversions::to_array(vision::Matrix6d::Identity()));
    }
    harness.publish(topics::kLandmarkPoses, message);
  }

  /// Passes place 2, one metre per panorama: a similar view, the exact one, and four more similar views.
  void pass() {
    cv::Mat nearly = place(2);
    cv::rectangle(nearly, {100, 150, 120, 150}, 30, cv::FILLED);
    for (int i = 0; i < 6; ++i) {
      publish_odometry(200.0, 5.0, 5.0);
      publish_panorama(i == 1 ? place(2) : nearly);
    }
  }

  /// Extrinsics of a forward-looking camera (X right, Y down, Z forward) above the base.
  static Eigen::Isometry3d mounted(double up_m) {
    Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
    base_from_panorama.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    base_from_panorama.translation().z() = up_m;
    return base_from_panorama;
  }

  landmarks::PanoramaDescriber describer{{}, 1};
  runtime::ComponentHarness harness;
  const std::vector<std::shared_ptr<const panvo_msgs::msg::LandmarkMatch>>& matches =
      harness.collect(topics::kLandmarkMatch);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::PositionCorrection>>& corrections =
      harness.collect(topics::kCorrection);
  int frames = 0;
  bool has_noise = true;
};

}  // namespace panvo::position_corrector
