// SPDX-License-Identifier: Apache-2.0
#include "image_compressor.hpp"

#include <algorithm>
#include <set>

#include "panvo/compressed_images/encode.hpp"

namespace panvo::web_view {
namespace {

using sensor_msgs::msg::CompressedImage;
using sensor_msgs::msg::Image;

constexpr int kJpegQuality = 80;       // of pictures to look at: a tenth of the size
constexpr std::size_t kMaxRecent = 8;  // stereo pair and panorama of the last moments

}  // namespace

std::vector<runtime::TopicDescription> ImageCompressor::offer(std::vector<runtime::TopicDescription> published) {
  std::set<std::string> names;
  for (const auto& topic : published) names.insert(topic.name);
  std::map<std::string, runtime::TopicDescription> sources;
  for (const auto& topic : published) {
    const std::string name = topic.name + "/compressed";
    if (topic.type == &interfaces::message_type<Image>() && !names.contains(name)) sources.emplace(name, topic);
  }
  const auto& type = interfaces::message_type<CompressedImage>();
  for (const auto& [name, topic] : sources) published.push_back({name, std::string(type.name), topic.qos, &type});
  const std::lock_guard lock(mutex_);
  sources_ = std::move(sources);
  return published;
}

std::optional<runtime::TopicDescription> ImageCompressor::source_of(const std::string& compressed) const {
  const std::lock_guard lock(mutex_);
  const auto found = sources_.find(compressed);
  return found == sources_.end() ? std::nullopt : std::optional(found->second);
}

runtime::SamplePtr ImageCompressor::compressed(const runtime::SamplePtr& image) {
  const auto is_same = [&](const Pair& pair) { return pair.first.lock() == image; };
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = std::ranges::find_if(recent_, is_same); found != recent_.end()) return found->second;
  }
  const auto message = runtime::Sample::as<Image>(image);
  if (!message) return nullptr;
  const auto encoded = compressed_images::encode(*message, {.jpeg_quality = kJpegQuality});
  if (!encoded) return nullptr;
  auto sample = runtime::Sample::of(interfaces::message_type<CompressedImage>(), *encoded, image->time_ns());
  const std::lock_guard lock(mutex_);
  recent_.emplace_back(image, sample);
  if (recent_.size() > kMaxRecent) recent_.pop_front();
  return sample;
}

}  // namespace panvo::web_view
