// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "panvo/runtime/container.hpp"

namespace panvo::runtime {

/// Drives components in a test: replay mode, one message at a time, deterministic.
///
///     ComponentHarness harness;
///     const auto& rectified = harness.collect(topics::kStereoLeftImageRect);
///     harness.load("panvo_stereo_rectifier", "StereoRectifierComponent", {{"output", "mono8"}});
///     harness.publish(topics::kStereoLeftImageRaw, image);
///     ASSERT_EQ(rectified.size(), 1U);
class ComponentHarness {
 public:
  explicit ComponentHarness(ContainerOptions options = {.replay = true}) : container_(with_log(std::move(options))) {}

  Container& container() noexcept { return container_; }

  /// Log lines in order: "warning dataset_player: ...".
  const std::vector<std::string>& log() const noexcept { return log_; }
  bool log_contains(const std::string& text) const {
    for (const auto& line : log_) {
      if (line.find(text) != std::string::npos) return true;
    }
    return false;
  }

  /// Loads a component. A list parameter is written "[a, b]". Throws ConfigError like the container.
  void load(const std::string& package, const std::string& plugin,
            const std::map<std::string, std::string>& parameters = {}) {
    container_.load(describe(package, plugin, parameters));
  }

  /// Adds a component class of the test.
  template <class ComponentClass>
  void add(const std::string& name, const std::map<std::string, std::string>& parameters = {}) {
    container_.add(describe("panvo_" + name, "", parameters),
                   [](Context& context) { return std::make_unique<ComponentClass>(context); });
  }

  /// Collects the messages published on a topic from now on, in order.
  template <class Message>
  const std::vector<std::shared_ptr<const Message>>& collect(const interfaces::Topic<Message>& topic) {
    auto messages = std::make_shared<std::vector<std::shared_ptr<const Message>>>();
    kept_.push_back(messages);
    const std::string name = topic.name.starts_with('/') ? std::string(topic.name) : "/" + std::string(topic.name);
    container_.observe([name](const TopicDescription& there) { return there.name == name; },
                       [messages](const TopicDescription&, const SamplePtr& sample) {
                         messages->push_back(Sample::as<Message>(sample));
                       });
    return *messages;
  }

  /// Publishes a message and handles everything it triggers.
  template <class Message>
  void publish(const interfaces::Topic<Message>& topic, Message message) {
    publish(topic, std::make_shared<const Message>(std::move(message)));
  }
  template <class Message>
  void publish(const interfaces::Topic<Message>& topic, std::shared_ptr<const Message> message) {
    auto& output = outputs_[std::string(topic.name)];
    if (!output) {
      const auto& type = interfaces::message_type<Message>();
      container_.add(
          describe("panvo_test_publisher_" + std::to_string(outputs_.size()), "", {}), [&](Context& context) {
            output = context.open_output({std::string(topic.name), std::string(type.name), topic.qos, &type});
            return std::make_unique<Component>();
          });
    }
    output->publish(std::shared_ptr<const void>(std::move(message)));
    container_.run_until_quiet();
  }

  ~ComponentHarness() { outputs_.clear(); }

 private:
  static ComponentDescription describe(const std::string& package, const std::string& plugin,
                                       const std::map<std::string, std::string>& parameters) {
    ComponentDescription description;
    description.package = package;
    description.plugin = plugin;
    description.name = package.starts_with("panvo_") ? package.substr(6) : package;
    description.name_space = "/";
    for (const auto& [name, text] : parameters) {
      WrittenValue value{.items = {}, .is_list = text.starts_with('['), .where = {"test", 0}};
      if (!value.is_list) {
        value.items.push_back(text);
      } else {
        std::string item;
        for (const char letter : text.substr(1)) {
          if (letter == ',' || letter == ']') {
            if (!item.empty()) value.items.push_back(std::exchange(item, ""));
          } else if (letter != ' ') {
            item += letter;
          }
        }
      }
      description.parameters[name] = std::move(value);
    }
    return description;
  }

  ContainerOptions with_log(ContainerOptions options) {
    options.log = [this](LogLevel level, const std::string& component, const std::string& text) {
      const char* name = level >= LogLevel::kError ? "error " : level >= LogLevel::kWarning ? "warning " : "info ";
      log_.push_back(name + component + ": " + text);
    };
    return options;
  }

  std::vector<std::string> log_;
  std::vector<std::shared_ptr<void>> kept_;
  Container container_;
  std::map<std::string, std::shared_ptr<UntypedOutput>> outputs_;
};

}  // namespace panvo::runtime
