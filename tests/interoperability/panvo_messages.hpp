// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nav_msgs/msg/Odometry.h"
#include "panvo_msgs/msg/PanoramicLandmark.h"
#include "sensor_msgs/msg/CompressedImage.h"
#include "sensor_msgs/msg/Image.h"
#include "tf2_msgs/msg/TFMessage.h"

namespace panvo::test {

/// The known messages (known_answers.hpp) in the classes generated from interfaces/idl.
template <class Message>
Message made(int n);

template <>
nav_msgs::msg::Odometry made(int n);
template <>
sensor_msgs::msg::Image made(int n);
template <>
sensor_msgs::msg::CompressedImage made(int n);
template <>
tf2_msgs::msg::TFMessage made(int n);
template <>
panvo_msgs::msg::PanoramicLandmark made(int n);

}  // namespace panvo::test
