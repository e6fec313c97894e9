// SPDX-License-Identifier: Apache-2.0
#include "live_cameras.hpp"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "diagnostic_msgs/msg/DiagnosticArray.h"
#include "panvo/conversions/time.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::aravis_camera::testing {

Simulator& LiveCameras::start(const std::vector<std::string>& words) {
  return *simulators_.emplace_back(std::make_unique<Simulator>(words));
}

void LiveCameras::load(const ParameterLines& parameters) {
  runtime::ContainerOptions options;
  options.log = [this](runtime::LogLevel level, const std::string& component, const std::string& text) {
    const std::lock_guard lock(mutex_);
    log_.push_back(
        fmt::format("{} {}: {}", level >= runtime::LogLevel::kWarning ? "warning" : "info", component, text));
  };
  container_ = std::make_unique<runtime::Container>(std::move(options));
  container_->observe([](const runtime::TopicDescription&) { return true; },
                      [this](const runtime::TopicDescription& topic, const runtime::SamplePtr& sample) {
                        const std::lock_guard lock(mutex_);
                        ++counts_[topic.name];
                        if (topic.name == "/diagnostics") {
                          const auto array = runtime::Sample::as<diagnostic_msgs::msg::DiagnosticArray>(sample);
                          for (const auto& status : array->status()) {
                            auto& values = diagnostics_[status.name()];
                            values["level"] = std::to_string(int{status.level()});
                            values["message"] = status.message();
                            for (const auto& entry : status.values()) values[entry.key()] = entry.value();
                          }
                        } else if (topic.name.ends_with("/image_raw")) {
                          const auto image = runtime::Sample::as<sensor_msgs::msg::Image>(sample);
                          seen_[topic.name].push_back(
                              {conversions::stamp_ns(*image),
                               TestPicture::read(image->data(), image->step()).value_or(TestPicture{99, 0, 0}),
                               image->encoding(), static_cast<int>(image->width()), static_cast<int>(image->height())});
                        }
                      });
  runtime::ComponentDescription description;
  description.package = "panvo_aravis_camera";
  description.plugin = "AravisCameraComponent";
  description.name = "aravis_camera";
  description.name_space = std::string("/");
  auto lines = parameters;
  if (!lines.contains("packet_socket")) lines["packet_socket"] = {"off"};
  for (const auto& [name, items] : lines) {
    const bool is_list = name == "cameras" || name == "features" || name == "mount" || name == "chunks";
    description.parameters[name] = runtime::WrittenValue{items, is_list, {"test", 0}};
  }
  container_->load(description);
  container_->start();
}

void LiveCameras::unload() { container_.reset(); }

bool LiveCameras::eventually(const std::function<bool()>& condition) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < give_up) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

std::vector<LiveCameras::Seen> LiveCameras::seen(const std::string& topic) const {
  const std::lock_guard lock(mutex_);
  const auto found = seen_.find(topic);
  return found != seen_.end() ? found->second : std::vector<Seen>{};
}

std::size_t LiveCameras::count(const std::string& topic) const {
  const std::lock_guard lock(mutex_);
  const auto found = counts_.find(topic);
  return found != counts_.end() ? found->second : 0;
}

std::map<std::string, std::string> LiveCameras::diagnostics(const std::string& camera) const {
  const std::lock_guard lock(mutex_);
  const auto found = diagnostics_.find("panvo: aravis_camera: " + camera);
  return found != diagnostics_.end() ? found->second : std::map<std::string, std::string>{};
}

std::uint64_t LiveCameras::counter(const std::string& camera, const std::string& key) const {
  const auto values = diagnostics(camera);
  const auto found = values.find(key);
  return found != values.end() ? std::stoull(found->second) : 0;
}

bool LiveCameras::log_contains(const std::string& text) const { return log().find(text) != std::string::npos; }

std::string LiveCameras::log() const {
  const std::lock_guard lock(mutex_);
  std::string all;
  for (const auto& line : log_) all += line + "\n";
  return all;
}

}  // namespace panvo::aravis_camera::testing
