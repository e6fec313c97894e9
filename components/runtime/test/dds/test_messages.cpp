// SPDX-License-Identifier: Apache-2.0
#include "test_messages.hpp"

#include <unistd.h>

#include <random>

#include "sensor_msgs/msg/Image.h"
#include "std_msgs/msg/String.h"

namespace panvo::runtime::test {

std::string unique_topic(const std::string& name) { return "/bridge_test_" + std::to_string(getpid()) + "/" + name; }

TopicDescription topic(const std::string& name, const std::string& type_name, interfaces::Qos qos) {
  return {name, type_name, qos, interfaces::find_message_type(type_name)};
}

SamplePtr image_sample(std::size_t size, std::uint32_t seed) {
  auto image = std::make_shared<sensor_msgs::msg::Image>();
  image->header().frame_id("camera");
  image->header().stamp().sec(static_cast<std::int32_t>(seed));
  image->encoding("mono8");
  image->height(1);
  image->width(static_cast<std::uint32_t>(size));
  image->data().resize(size);
  std::minstd_rand random(seed + 1);
  for (auto& pixel : image->data()) pixel = static_cast<std::uint8_t>(random() >> 8);
  return Sample::of(interfaces::message_type<sensor_msgs::msg::Image>(), image, 0);
}

SamplePtr text_sample(const std::string& text) {
  auto message = std::make_shared<std_msgs::msg::String>();
  message->data(text);
  return Sample::of(interfaces::message_type<std_msgs::msg::String>(), message, 0);
}

std::uint64_t hash(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0xcbf29ce484222325U;
  for (const auto byte : bytes) value = (value ^ byte) * 0x100000001b3U;
  return value;
}

}  // namespace panvo::runtime::test
