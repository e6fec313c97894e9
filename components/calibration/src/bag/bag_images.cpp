// SPDX-License-Identifier: Apache-2.0
#include "bag_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "frame_choice.hpp"
#include "messages/grey_picture.hpp"
#include "panvo/calibration/calibration_error.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "panvo/recorder/bag_reader.hpp"

namespace panvo::calibration {
namespace {

bool holds_images(const recorder::BagTopic& topic) { return is_image_type(recorder::full_type_name(topic.type)); }

const interfaces::MessageType& type_of(const recorder::BagTopic& topic) {
  return *interfaces::find_message_type(recorder::full_type_name(topic.type));
}

std::string image_topics(const recorder::BagReader& bag) {
  std::string names;
  for (const auto& topic : bag.metadata().topics) {
    if (holds_images(topic)) names += (names.empty() ? "" : ", ") + topic.name;
  }
  return names.empty() ? "none" : names;
}

void find_cameras(const recorder::BagReader& bag, BagImages& settings) {
  const auto& topics = bag.metadata().topics;
  if (settings.cameras.empty()) {
    for (const auto& topic : topics) {
      const auto name = camera_of(topic.name);
      const bool is_known = std::any_of(settings.cameras.begin(), settings.cameras.end(),
                                        [&](const auto& known) { return known.name == name; });
      if (holds_images(topic) && !name.empty() && !is_known) settings.cameras.push_back({name, topic.name});
    }
    std::sort(settings.cameras.begin(), settings.cameras.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
    if (settings.cameras.empty())
      throw CalibrationError(
          fmt::format("{}: contains no topic */image_raw; specify topics with --topics left:=/TOPIC (available: {})",
                      settings.bag.string(), image_topics(bag)));
  }
  for (const auto& camera : settings.cameras) {
    const bool is_there = std::any_of(topics.begin(), topics.end(), [&](const auto& topic) {
      return topic.name == camera.topic && holds_images(topic);
    });
    if (!is_there)
      throw CalibrationError(fmt::format("{}: contains no images of {}; available topics: {}", settings.bag.string(),
                                         camera.topic, image_topics(bag)));
  }
}

std::vector<std::int64_t> stamps_of(recorder::BagReader& bag, const std::string& name) {
  std::vector<std::int64_t> stamps;
  bag.select([&](const recorder::BagTopic& topic) { return topic.name == name; });
  while (const auto* message = bag.next()) {
    const auto& type = type_of(bag.metadata().topics[message->topic]);
    stamps.push_back(type.stamp_ns(type.deserialize(message->data).get()).value_or(message->timestamp_ns));
  }
  return stamps;
}

}  // namespace

std::vector<std::size_t> write_images(BagImages& settings) {
  recorder::BagReader bag(settings.bag);
  find_cameras(bag, settings);
  const auto chosen = choose_frames(stamps_of(bag, settings.cameras[0].topic), settings.every_ns);
  std::vector<std::size_t> written(settings.cameras.size(), 0);
  for (const auto& camera : settings.cameras) std::filesystem::create_directories(settings.out / camera.name);
  bag.select([&](const recorder::BagTopic& topic) {
    return std::any_of(settings.cameras.begin(), settings.cameras.end(),
                       [&](const auto& camera) { return camera.topic == topic.name; });
  });
  while (const auto* message = bag.next()) {
    const auto& topic = bag.metadata().topics[message->topic];
    const auto& type = type_of(topic);
    const auto content = type.deserialize(message->data);
    const auto frame =
        nearest_frame(chosen, type.stamp_ns(content.get()).value_or(message->timestamp_ns), settings.tolerance_ns);
    if (!frame) continue;
    for (std::size_t i = 0; i < settings.cameras.size(); ++i) {
      if (settings.cameras[i].topic != topic.name) continue;
      const auto file = settings.out / settings.cameras[i].name / fmt::format("{}.png", *frame);
      if (!cv::imwrite(file.string(), grey_picture(topic.name, type, content.get())))
        throw CalibrationError(file.string() + ": cannot be written; choose a writable folder with --out");
      ++written[i];
    }
  }
  return written;
}

}  // namespace panvo::calibration
