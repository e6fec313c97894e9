// SPDX-License-Identifier: Apache-2.0
#include "image_stream.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>
#include <thread>

#include "interruption.hpp"
#include "panvo/calibration/calibration_error.hpp"
#include "panvo/interfaces/qos.hpp"
#include "panvo/runtime/graph.hpp"
#include "panvo/runtime/names.hpp"

namespace panvo::calibration {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLook{20};  // polling interval for publishers
constexpr milliseconds kLookForStop{50};
constexpr double kMillisecond_ns = 1e6;

/// Types of the published topics, by name. Omits invalid names from the network, which could contain control
/// characters.
std::map<std::string, std::string> published_topics(runtime::Bridge& bridge) {
  std::map<std::string, std::string> types;
  for (const auto& endpoint : bridge.graph().endpoints) {
    if (endpoint.kind == runtime::EndpointKind::kTopic && endpoint.is_writer &&
        !runtime::topic_name_problem(endpoint.name))
      types[endpoint.name] = endpoint.type_name;
  }
  return types;
}

std::string published_image_topics(const std::map<std::string, std::string>& types) {
  std::vector<std::string> names;
  for (const auto& [name, type] : types) {
    if (is_image_type(type)) names.push_back(name);
  }
  return names.empty() ? "no images are published" : fmt::format("image topics: {}", fmt::join(names, ", "));
}

void warn(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  std::fprintf(stderr, "panvo calibrate: %s\n", text.c_str());
}

runtime::DdsSettings settings() {
  auto settings = runtime::dds_settings_from_environment();
  settings.name = "panvo_calibrate";
  return settings;
}

}  // namespace

ImageStream::ImageStream(const std::vector<CameraTopic>& cameras, milliseconds timeout, std::int64_t tolerance_ns)
    : cameras_(cameras),
      sets_(cameras.size(), tolerance_ns),
      received_(cameras.size(), 0),
      bridge_(runtime::make_dds_bridge(settings())) {
  bridge_->on_warning(warn);
  const auto types = await_publishers(timeout);
  for (std::size_t camera = 0; camera < cameras_.size(); ++camera) {
    const auto& type = types[camera];
    readers_.push_back(bridge_->open_reader(
        {cameras_[camera].topic, type, interfaces::qos::kSensorData, interfaces::find_message_type(type)},
        [this, camera](const runtime::SamplePtr& sample) { take(camera, sample); }));
  }
}

std::vector<std::string> ImageStream::await_publishers(milliseconds timeout) {
  const auto end = Clock::now() + timeout;
  for (;;) {
    const auto types = published_topics(*bridge_);
    const auto lacking = std::find_if(cameras_.begin(), cameras_.end(), [&](const auto& camera) {
      return !types.contains(camera.topic) || !is_image_type(types.at(camera.topic));
    });
    if (lacking == cameras_.end()) {
      std::vector<std::string> found;
      for (const auto& camera : cameras_) found.push_back(types.at(camera.topic));
      return found;
    }
    if (Interruption::came() || Clock::now() >= end)
      throw CalibrationError(fmt::format(
          "{}: {} ({}); check that the driver runs on this ROS_DOMAIN_ID", lacking->topic,
          types.contains(lacking->topic) ? "has type " + types.at(lacking->topic) + ", which is not an image"
                                         : "is not published",
          published_image_topics(types)));
    std::this_thread::sleep_for(kLook);
  }
}

std::optional<ImageStream::Set> ImageStream::next(Clock::time_point end) {
  std::unique_lock lock(mutex_);
  while (!newest_) {
    const auto now = Clock::now();
    if (Interruption::came() || now >= end) return std::nullopt;
    came_.wait_until(lock, std::min(end, now + kLookForStop));
  }
  return std::exchange(newest_, std::nullopt);
}

std::string ImageStream::why_none() const {
  const std::lock_guard lock(mutex_);
  const auto silent = std::find(received_.begin(), received_.end(), std::size_t{0});
  if (silent != received_.end())
    return fmt::format("{}: is published, but no images arrived; check that the camera runs",
                       cameras_[static_cast<std::size_t>(silent - received_.begin())].topic);
  return fmt::format(
      "{}: no simultaneous images on all topics, the closest are {:.1f} ms apart; trigger the cameras together, or "
      "increase --tolerance-ms",
      cameras_.front().topic, static_cast<double>(sets_.closest_ns().value_or(0)) / kMillisecond_ns);
}

void ImageStream::take(std::size_t camera, const runtime::SamplePtr& sample) {
  const auto stamp_ns = sample->type()->stamp_ns(sample->message()).value_or(sample->time_ns());
  const std::lock_guard lock(mutex_);
  ++received_[camera];
  if (auto set = sets_.push(camera, stamp_ns, sample)) {
    newest_ = std::move(set);
    came_.notify_one();
  }
}

}  // namespace panvo::calibration
