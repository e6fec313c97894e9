// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry_msgs/msg/PoseWithCovarianceStamped.h"
#include "nav_msgs/msg/Odometry.h"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/container.hpp"
#include "sensor_msgs/msg/Image.h"
#include "web_socket_client.hpp"

namespace panvo::web_view::test {

using nlohmann::json;

/// A list of one element is written "[a]".
inline runtime::ComponentDescription description(const std::string& name,
                                                 const std::map<std::string, std::string>& parameters = {}) {
  runtime::ComponentDescription description;
  description.name = name;
  description.name_space = "/";
  for (const auto& [key, text] : parameters) {
    const bool is_list = text.starts_with('[');
    description.parameters[key] = runtime::WrittenValue{
        .items = {is_list ? text.substr(1, text.size() - 2) : text}, .is_list = is_list, .where = {"test", 0}};
  }
  return description;
}

inline nav_msgs::msg::Odometry odometry(std::int32_t sec) {
  nav_msgs::msg::Odometry message;
  message.header().stamp().sec(sec);
  message.header().frame_id("odom");
  message.pose().pose().position().x(1.5);
  return message;
}

/// A web view in a live container without DDS, which also publishes odometry and images.
class WebView : public ::testing::Test {
 protected:
  void start(std::map<std::string, std::string> parameters = {}) {
    container_.emplace(runtime::ContainerOptions{
        .rate = 1, .log = [this](runtime::LogLevel, const std::string&, const std::string& text) { take_log(text); }});
    container_->add(description("camera"), [this](runtime::Context& context) {
      odometry_.emplace(context.output(topics::kOdometryBinocular));
      images_.emplace(context.output(topics::kPanorama));
      return std::make_unique<runtime::Component>();
    });
    container_->add(description("listener"), [this](runtime::Context& context) {
      context.input(topics::kInitialPose,
                    [this](const std::shared_ptr<const geometry_msgs::msg::PoseWithCovarianceStamped>& pose) {
                      take_log("pose in " + pose->header().frame_id());
                    });
      return std::make_unique<runtime::Component>();
    });
    parameters.emplace("port", "0");
    auto view = description("web_view", parameters);
    view.package = "panvo_web_view";
    view.plugin = "WebViewComponent";
    container_->load(view);
    container_->start();
  }

  void TearDown() override {
    odometry_.reset();
    images_.reset();
    container_.reset();
  }

  void take_log(const std::string& text) {
    {
      const std::lock_guard lock(mutex_);
      log_ += text + "\n";
    }
    logged_.notify_all();
  }
  [[nodiscard]] bool is_logged(const std::string& text) {
    std::unique_lock lock(mutex_);
    return logged_.wait_for(lock, std::chrono::seconds(30), [&] { return log_.find(text) != std::string::npos; });
  }

  int port() {
    const std::string start = "listening on ws", host = "://127.0.0.1:";
    EXPECT_TRUE(is_logged(start));
    const std::lock_guard lock(mutex_);
    return std::stoi(log_.substr(log_.find(host, log_.find(start)) + host.size()));
  }

  /// Next text of this operation; others are skipped.
  static json next_text(WebSocketClient& client, const std::string& operation) {
    while (const auto frame = client.receive()) {
      if (frame->operation != 1) continue;
      auto object = json::parse(frame->text());
      if (object["op"] == operation) return object;
    }
    return {};
  }
  static std::string next_status(WebSocketClient& client) {
    return next_text(client, "status").value("message", "no status");
  }
  /// Id of a topic's channel according to the next list of channels.
  static std::uint32_t channel_of(WebSocketClient& client, const std::string& topic) {
    const json channels = next_text(client, "advertise")["channels"];
    for (const auto& channel : channels) {
      if (channel["topic"] == topic) return channel["id"];
    }
    ADD_FAILURE() << topic << " is not offered";
    return 0;
  }
  static void subscribe(WebSocketClient& client, std::uint32_t id, std::uint32_t channel) {
    client.send_text(json{{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", channel}}}}}.dump());
  }
  /// Returns once the server has handled what was sent before.
  static void settle(WebSocketClient& client) {
    client.send_text(R"({"op":"settle"})");
    EXPECT_EQ(next_status(client), "operation settle is not supported");
  }
  /// The next message of any subscription.
  static std::vector<std::uint8_t> next_message(WebSocketClient& client) {
    while (auto frame = client.receive()) {
      if (frame->operation == 2) return std::move(frame->data);
    }
    return {};
  }
  static nav_msgs::msg::Odometry decoded(const std::vector<std::uint8_t>& frame) {
    constexpr std::size_t kHead = 13;
    if (frame.size() < kHead) throw std::runtime_error("no message came");
    return runtime::from_bytes<nav_msgs::msg::Odometry>({frame.begin() + kHead, frame.end()});
  }

  std::mutex mutex_;
  std::condition_variable logged_;
  std::string log_;
  std::optional<runtime::Output<nav_msgs::msg::Odometry>> odometry_;
  std::optional<runtime::Output<sensor_msgs::msg::Image>> images_;
  std::optional<runtime::Container> container_;
};

}  // namespace panvo::web_view::test
