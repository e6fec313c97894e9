// SPDX-License-Identifier: Apache-2.0
#include "panvo_messages.hpp"

#include "known_answers.hpp"

namespace panvo::test {
namespace {

float real(int field, int n) { return static_cast<float>(answer::number(field, n)); }

std_msgs::msg::Header header(int field, int n) {
  std_msgs::msg::Header header;
  header.stamp().sec(static_cast<std::int32_t>(answer::count(field, n)));
  header.stamp().nanosec(answer::count(field + 1, n));
  header.frame_id(answer::text("frame", n));
  return header;
}

template <class Vector>
void fill_vector(Vector& vector, int field, int n) {
  vector.x(answer::number(field, n));
  vector.y(answer::number(field + 1, n));
  vector.z(answer::number(field + 2, n));
}

void fill(geometry_msgs::msg::Quaternion& quaternion, int field, int n) {
  fill_vector(quaternion, field, n);
  quaternion.w(answer::number(field + 3, n));
}

void fill(geometry_msgs::msg::Pose& pose, int field, int n) {
  fill_vector(pose.position(), field, n);
  fill(pose.orientation(), field + 3, n);
}

void fill(std::array<double, 36>& covariance, int field, int n) {
  for (int i = 0; i < 36; ++i) covariance.at(i) = answer::number(field + i, n);
}

void fill(std::vector<panvo_msgs::msg::AdaptiveFeature>& features, std::size_t size, int field, int n) {
  features.resize(size);
  for (auto& feature : features) {
    feature.row(static_cast<std::uint16_t>(field));
    feature.value(real(field + 1, n));
    feature.scale(real(field + 2, n));
    feature.weight(real(field + 3, n));
    field += 4;
  }
}

void fill(panvo_msgs::msg::LandmarkKeypoint& keypoint, int field, int n) {
  for (int i = 0; i < 3; ++i) {
    keypoint.bearing().at(i) = real(field + i, n);
    keypoint.point().at(i) = real(field + 3 + i, n);
  }
  keypoint.size_px(real(field + 6, n));
  keypoint.inverse_range_sigma(real(field + 7, n));
  keypoint.has_point(field % 2 == 0);
  for (std::size_t i = 0; i < 128; ++i) keypoint.descriptor().at(i) = answer::byte(i, field + n);
}

}  // namespace

template <>
nav_msgs::msg::Odometry made(int n) {
  nav_msgs::msg::Odometry odometry;
  odometry.header(header(1, n));
  odometry.child_frame_id(answer::text("child", n + 1));
  fill(odometry.pose().pose(), 10, n);
  fill(odometry.pose().covariance(), 100, n);
  fill_vector(odometry.twist().twist().linear(), 20, n);
  fill_vector(odometry.twist().twist().angular(), 30, n);
  fill(odometry.twist().covariance(), 200, n);
  return odometry;
}

template <>
sensor_msgs::msg::Image made(int n) {
  sensor_msgs::msg::Image image;
  image.header(header(1, n));
  image.height(answer::kHeight);
  image.width(answer::kWidth);
  image.encoding("rgb8");
  image.is_bigendian(answer::byte(1, n));
  image.step(answer::kStep);
  image.data().resize(std::size_t{answer::kStep} * answer::kHeight);
  for (std::size_t i = 0; i < image.data().size(); ++i) image.data()[i] = answer::byte(i, n);
  return image;
}

template <>
sensor_msgs::msg::CompressedImage made(int n) {
  sensor_msgs::msg::CompressedImage image;
  image.header(header(1, n));
  image.format("rgb8; jpeg compressed bgr8");
  image.data().resize(answer::kThumbnailSize);
  for (std::size_t i = 0; i < image.data().size(); ++i) image.data()[i] = answer::byte(i, n);
  return image;
}

template <>
tf2_msgs::msg::TFMessage made(int n) {
  tf2_msgs::msg::TFMessage message;
  message.transforms().resize(answer::transforms(n));
  int field = 1;
  for (auto& transform : message.transforms()) {
    transform.header(header(field, n));
    transform.child_frame_id(answer::text("child", n + field));
    fill_vector(transform.transform().translation(), field + 10, n);
    fill(transform.transform().rotation(), field + 20, n);
    field += 100;
  }
  return message;
}

template <>
panvo_msgs::msg::PanoramicLandmark made(int n) {
  panvo_msgs::msg::PanoramicLandmark landmark;
  landmark.header(header(1, n));
  landmark.id(answer::count(3, n));
  fill(landmark.pose().pose(), 10, n);
  fill(landmark.pose().covariance(), 100, n);
  fill(landmark.panorama_pose(), 20, n);
  landmark.is_junction(n % 2 == 1);
  landmark.settings(answer::text("places=1\nangle=\xc2\xb0\n", n));
  landmark.histogram().resize(answer::kIntensities);
  for (int i = 0; i < static_cast<int>(answer::kIntensities); ++i) landmark.histogram()[i] = real(200 + i, n);
  fill(landmark.large_features(), answer::kLargeFeatures, 500, n);
  fill(landmark.small_features(), answer::kSmallFeatures, 700, n);
  landmark.keypoints().resize(answer::kKeypoints);
  int field = 800;
  for (auto& keypoint : landmark.keypoints()) fill(keypoint, field++, n);
  landmark.thumbnail().resize(answer::kThumbnailSize);
  for (std::size_t i = 0; i < answer::kThumbnailSize; ++i) landmark.thumbnail()[i] = answer::byte(i, n);
  return landmark;
}

}  // namespace panvo::test
