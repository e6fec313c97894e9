// SPDX-License-Identifier: Apache-2.0
#include "camera_topic.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "panvo/calibration/calibration_error.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "sensor_msgs/msg/CompressedImage.h"
#include "sensor_msgs/msg/Image.h"

namespace panvo::calibration {
namespace {

CameraTopic parse_topic(const std::string& text, const std::string& name) {
  CameraTopic camera = text.find(":=") == std::string::npos ? CameraTopic{name, text} : parse_named_topic(text);
  if (!camera.topic.starts_with('/')) camera.topic.insert(0, "/");
  if (camera.name.empty()) camera.name = camera_of(camera.topic);
  if (camera.name.empty() || camera.name.find('/') != std::string::npos)
    throw CalibrationError(fmt::format("--topics {}: has no camera name; use NAME:={}", text, camera.topic));
  return camera;
}

}  // namespace

CameraTopic parse_named_topic(const std::string& text) {
  const auto at = text.find(":=");
  if (at == 0 || at == std::string::npos || at + 2 == text.size())
    throw CalibrationError("--topics " + text + ": is not of the form NAME:=TOPIC, e.g. left:=/stereo/left/image_raw");
  return {text.substr(0, at), text.substr(at + 2)};
}

std::string camera_of(const std::string& topic) {
  const auto last = topic.find("/image_raw");
  if (last == std::string::npos || last == 0) return "";
  return topic.substr(topic.rfind('/', last - 1) + 1, last - topic.rfind('/', last - 1) - 1);
}

std::vector<CameraTopic> parse_topics(const std::vector<std::string>& topics, const std::vector<std::string>& names) {
  if (names.empty() ? topics.size() < 2 : topics.size() != names.size())
    throw CalibrationError(fmt::format("--topics: {} given, expected {}", topics.size(),
                                       names.empty() ? "two or more" : fmt::format("{}", names.size())));
  std::vector<CameraTopic> cameras;
  for (const auto& text : topics) {
    auto camera = parse_topic(text, names.empty() ? "" : names[cameras.size()]);
    const auto has_name = [&](const CameraTopic& other) { return other.name == camera.name; };
    if (std::any_of(cameras.begin(), cameras.end(), has_name))
      throw CalibrationError(
          fmt::format("--topics {}: is a second topic of camera '{}'; use NAME:={}", text, camera.name, camera.topic));
    if (!names.empty() && std::find(names.begin(), names.end(), camera.name) == names.end())
      throw CalibrationError(
          fmt::format("--topics {}: unknown camera; the cameras are {}", text, fmt::join(names, " and ")));
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

bool is_image_type(const std::string& type) {
  return type == interfaces::message_type<sensor_msgs::msg::Image>().name ||
         type == interfaces::message_type<sensor_msgs::msg::CompressedImage>().name;
}

}  // namespace panvo::calibration
