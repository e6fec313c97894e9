// SPDX-License-Identifier: Apache-2.0
#include "cyclone_messages.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "known_answers.hpp"
#include "nav_msgs/msg/Odometry.h"
#include "panvo_msgs/msg/PanoramicLandmark.h"
#include "sensor_msgs/msg/CompressedImage.h"
#include "sensor_msgs/msg/Image.h"
#include "tf2_msgs/msg/TFMessage.h"

namespace panvo::test::cyclone {
namespace {

/// Fills the fields of a message with the known values.
class Filler {
 public:
  template <class Number, class Value>
  void operator()(const std::string&, Number& field, Value value) {
    field = static_cast<Number>(value);
  }
  void operator()(const std::string&, char*& field, const std::string& value) { field = dds_string_dup(value.c_str()); }

  template <class Sequence>
  void resize(const std::string&, Sequence& sequence, std::size_t size) {
    const std::size_t bytes = size * sizeof(*sequence._buffer);
    sequence._buffer = static_cast<decltype(sequence._buffer)>(dds_alloc(bytes));
    std::memset(sequence._buffer, 0, bytes);
    sequence._length = sequence._maximum = static_cast<std::uint32_t>(size);
    sequence._release = true;
  }
};

/// Compares the fields of a message with the known values and stores the first difference.
class Checker {
 public:
  template <class Number, class Value>
  void operator()(const std::string& name, const Number& field, Value value) {
    const auto wanted = static_cast<Number>(value);
    if (field != wanted) note(name, std::to_string(field), std::to_string(wanted));
  }
  void operator()(const std::string& name, char* const& field, const std::string& value) {
    if (field != value) note(name, field, value);
  }

  template <class Sequence>
  void resize(const std::string& name, Sequence& sequence, std::size_t size) {
    if (sequence._length == size) return;
    note(name + " length", std::to_string(sequence._length), std::to_string(size));
    throw *this;  // the remaining fields cannot be compared
  }

  const std::string& first() const { return first_; }

 private:
  void note(const std::string& name, const std::string& got, const std::string& wanted) {
    if (first_.empty()) first_ = name + " is " + got + ", not " + wanted;
  }

  std::string first_;
};

template <class Visit>
void header(Visit& visit, std_msgs_msg_Header& header, int field, int n) {
  visit("header.stamp.sec", header.stamp.sec, answer::count(field, n));
  visit("header.stamp.nanosec", header.stamp.nanosec, answer::count(field + 1, n));
  visit("header.frame_id", header.frame_id, answer::text("frame", n));
}

template <class Visit, class Vector>
void vector(Visit& visit, const std::string& name, Vector& vector, int field, int n) {
  visit(name + ".x", vector.x, answer::number(field, n));
  visit(name + ".y", vector.y, answer::number(field + 1, n));
  visit(name + ".z", vector.z, answer::number(field + 2, n));
}

template <class Visit>
void quaternion(Visit& visit, const std::string& name, geometry_msgs_msg_Quaternion& value, int field, int n) {
  vector(visit, name, value, field, n);
  visit(name + ".w", value.w, answer::number(field + 3, n));
}

template <class Visit>
void pose(Visit& visit, const std::string& name, geometry_msgs_msg_Pose& pose, int field, int n) {
  vector(visit, name + ".position", pose.position, field, n);
  quaternion(visit, name + ".orientation", pose.orientation, field + 3, n);
}

template <class Visit>
void covariance(Visit& visit, const std::string& name, double (&values)[36], int field, int n) {
  for (int i = 0; i < 36; ++i) visit(name + ".covariance", values[i], answer::number(field + i, n));
}

template <class Visit, class Sequence>
void bytes(Visit& visit, const std::string& name, Sequence& sequence, std::size_t size, int n) {
  visit.resize(name, sequence, size);
  for (std::size_t i = 0; i < size; ++i) visit(name, sequence._buffer[i], answer::byte(i, n));
}

template <class Visit, class Sequence>
void features(Visit& visit, const std::string& name, Sequence& sequence, std::size_t size, int field, int n) {
  visit.resize(name, sequence, size);
  for (std::size_t i = 0; i < size; ++i, field += 4) {
    panvo_msgs_msg_AdaptiveFeature& feature = sequence._buffer[i];
    visit(name + ".row", feature.row, field);
    visit(name + ".value", feature.value, answer::number(field + 1, n));
    visit(name + ".scale", feature.scale, answer::number(field + 2, n));
    visit(name + ".weight", feature.weight, answer::number(field + 3, n));
  }
}

template <class Visit>
void keypoint(Visit& visit, panvo_msgs_msg_LandmarkKeypoint& keypoint, int field, int n) {
  for (int i = 0; i < 3; ++i) {
    visit("keypoint.bearing", keypoint.bearing[i], answer::number(field + i, n));
    visit("keypoint.point", keypoint.point[i], answer::number(field + 3 + i, n));
  }
  visit("keypoint.size_px", keypoint.size_px, answer::number(field + 6, n));
  visit("keypoint.inverse_range_sigma", keypoint.inverse_range_sigma, answer::number(field + 7, n));
  visit("keypoint.has_point", keypoint.has_point, field % 2 == 0);
  for (std::size_t i = 0; i < 128; ++i) {
    visit("keypoint.descriptor", keypoint.descriptor[i], answer::byte(i, field + n));
  }
}

template <class Visit>
void fields(Visit& visit, nav_msgs_msg_Odometry& odometry, int n) {
  header(visit, odometry.header, 1, n);
  visit("child_frame_id", odometry.child_frame_id, answer::text("child", n + 1));
  pose(visit, "pose", odometry.pose.pose, 10, n);
  covariance(visit, "pose", odometry.pose.covariance, 100, n);
  vector(visit, "twist.linear", odometry.twist.twist.linear, 20, n);
  vector(visit, "twist.angular", odometry.twist.twist.angular, 30, n);
  covariance(visit, "twist", odometry.twist.covariance, 200, n);
}

template <class Visit>
void fields(Visit& visit, sensor_msgs_msg_Image& image, int n) {
  header(visit, image.header, 1, n);
  visit("height", image.height, answer::kHeight);
  visit("width", image.width, answer::kWidth);
  visit("encoding", image.encoding, std::string("rgb8"));
  visit("is_bigendian", image.is_bigendian, answer::byte(1, n));
  visit("step", image.step, answer::kStep);
  bytes(visit, "data", image.data, std::size_t{answer::kStep} * answer::kHeight, n);
}

template <class Visit>
void fields(Visit& visit, sensor_msgs_msg_CompressedImage& image, int n) {
  header(visit, image.header, 1, n);
  visit("format", image.format, std::string("rgb8; jpeg compressed bgr8"));
  bytes(visit, "data", image.data, answer::kThumbnailSize, n);
}

template <class Visit>
void fields(Visit& visit, tf2_msgs_msg_TFMessage& message, int n) {
  visit.resize("transforms", message.transforms, answer::transforms(n));
  for (std::uint32_t i = 0; i < message.transforms._length; ++i) {
    const int field = 1 + 100 * static_cast<int>(i);
    geometry_msgs_msg_TransformStamped& transform = message.transforms._buffer[i];
    header(visit, transform.header, field, n);
    visit("child_frame_id", transform.child_frame_id, answer::text("child", n + field));
    vector(visit, "translation", transform.transform.translation, field + 10, n);
    quaternion(visit, "rotation", transform.transform.rotation, field + 20, n);
  }
}

template <class Visit>
void fields(Visit& visit, panvo_msgs_msg_PanoramicLandmark& landmark, int n) {
  header(visit, landmark.header, 1, n);
  visit("id", landmark.id, answer::count(3, n));
  pose(visit, "pose", landmark.pose.pose, 10, n);
  covariance(visit, "pose", landmark.pose.covariance, 100, n);
  pose(visit, "panorama_pose", landmark.panorama_pose, 20, n);
  visit("is_junction", landmark.is_junction, n % 2 == 1);
  visit("settings", landmark.settings, answer::text("places=1\nangle=\xc2\xb0\n", n));
  visit.resize("histogram", landmark.histogram, answer::kIntensities);
  for (int i = 0; i < static_cast<int>(answer::kIntensities); ++i) {
    visit("histogram", landmark.histogram._buffer[i], answer::number(200 + i, n));
  }
  features(visit, "large_features", landmark.large_features, answer::kLargeFeatures, 500, n);
  features(visit, "small_features", landmark.small_features, answer::kSmallFeatures, 700, n);
  visit.resize("keypoints", landmark.keypoints, answer::kKeypoints);
  for (int i = 0; i < static_cast<int>(answer::kKeypoints); ++i) {
    keypoint(visit, landmark.keypoints._buffer[i], 800 + i, n);
  }
  bytes(visit, "thumbnail", landmark.thumbnail, answer::kThumbnailSize, n);
}

/// idlc uses the type names of the IDL; ROS 2 mangles them on the wire.
dds_topic_descriptor_t named(dds_topic_descriptor_t descriptor, const char* wire_name) {
  descriptor.m_typename = wire_name;
  return descriptor;
}

template <class Message>
MessageKind kind(std::string_view name, const char* wire_name, const dds_topic_descriptor_t& descriptor) {
  return {name, named(descriptor, wire_name),
          [](int n) -> void* {
            auto* message = static_cast<Message*>(dds_alloc(sizeof(Message)));
            std::memset(static_cast<void*>(message), 0, sizeof(Message));
            Filler filler;
            fields(filler, *message, n);
            return message;
          },
          [](const void* received, int n) {
            Checker checker;
            try {
              fields(checker, *static_cast<Message*>(const_cast<void*>(received)), n);
            } catch (const Checker& stopped) {
              return stopped.first();
            }
            return checker.first();
          }};
}

}  // namespace

const MessageKind* find_message_kind(std::string_view name) {
  static const std::array<MessageKind, 5> kinds{
      kind<nav_msgs_msg_Odometry>("nav_msgs/msg/Odometry", "nav_msgs::msg::dds_::Odometry_",
                                  nav_msgs_msg_Odometry_desc),
      kind<sensor_msgs_msg_Image>("sensor_msgs/msg/Image", "sensor_msgs::msg::dds_::Image_",
                                  sensor_msgs_msg_Image_desc),
      kind<sensor_msgs_msg_CompressedImage>("sensor_msgs/msg/CompressedImage",
                                            "sensor_msgs::msg::dds_::CompressedImage_",
                                            sensor_msgs_msg_CompressedImage_desc),
      kind<tf2_msgs_msg_TFMessage>("tf2_msgs/msg/TFMessage", "tf2_msgs::msg::dds_::TFMessage_",
                                   tf2_msgs_msg_TFMessage_desc),
      kind<panvo_msgs_msg_PanoramicLandmark>("panvo_msgs/msg/PanoramicLandmark",
                                             "panvo_msgs::msg::dds_::PanoramicLandmark_",
                                             panvo_msgs_msg_PanoramicLandmark_desc)};
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const auto& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

}  // namespace panvo::test::cyclone
