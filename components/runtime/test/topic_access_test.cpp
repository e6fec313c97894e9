// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/topic_access.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "panvo/runtime/container.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/testing.hpp"
#include "rcl_interfaces/srv/ListParameters.h"
#include "std_msgs/msg/String.h"

namespace panvo::runtime {
namespace {

constexpr interfaces::Topic<std_msgs::msg::String> kChat{"chat"};
constexpr interfaces::Topic<std_msgs::msg::String> kLatchedChat{"latched", interfaces::qos::kLatched};

std_msgs::msg::String text(const std::string& data) {
  std_msgs::msg::String message;
  message.data(data);
  return message;
}

/// A component with access to all topics.
class TopicsByName : public testing::Test {
 protected:
  static std::unique_ptr<Component> take(std::unique_ptr<TopicAccess>& access, Context& context) {
    access = context.topic_access();
    return std::make_unique<Component>();
  }

  void SetUp() override {
    ComponentDescription viewer;
    viewer.name = "viewer";
    viewer.name_space = "/";
    harness_.container().add(viewer, [this](Context& context) { return take(access_, context); });
  }

  std::optional<TopicDescription> find(const std::string& name) const {
    for (const auto& topic : access_->published()) {
      if (topic.name == name) return topic;
    }
    return std::nullopt;
  }
  std::shared_ptr<void> read(const std::string& name) {
    return access_->read(find(name).value(), [this](const SamplePtr& sample) {
      texts_.push_back(Sample::as<std_msgs::msg::String>(sample)->data());
    });
  }

  ComponentHarness harness_;
  std::unique_ptr<TopicAccess> access_;
  std::vector<std::string> texts_;
};

TEST_F(TopicsByName, AreThoseThatSomebodyPublishes) {
  EXPECT_FALSE(find("/chat"));
  harness_.publish(kChat, text("one"));
  const auto topic = find("/chat");
  ASSERT_TRUE(topic);
  EXPECT_EQ(topic->type_name, "std_msgs/msg/String");
  EXPECT_EQ(topic->type, &interfaces::message_type<std_msgs::msg::String>());
}

TEST_F(TopicsByName, AreReadWhileTheReadingLasts) {
  harness_.publish(kChat, text("before"));
  auto reading = read("/chat");
  harness_.publish(kChat, text("during"));
  reading.reset();
  harness_.publish(kChat, text("after"));
  EXPECT_THAT(texts_, testing::ElementsAre("during"));
}

TEST_F(TopicsByName, GiveEachReadingTheLatchedMessages) {
  harness_.publish(kLatchedChat, text("latched"));
  const auto first = read("/latched"), second = read("/latched");
  EXPECT_THAT(texts_, testing::ElementsAre("latched", "latched"));
}

TEST_F(TopicsByName, AreNotReadWithAnotherType) {
  harness_.publish(kChat, text("one"));
  EXPECT_THROW(access_->read({"/chat", "std_msgs/msg/Header", {}, nullptr}, [](const SamplePtr&) {}), ConfigError);
}

TEST_F(TopicsByName, DoNotCallServicesInAReplay) {
  EXPECT_THROW(
      access_->call({"/viewer/get_parameters", "rcl_interfaces/srv/GetParameters"}, {}, std::chrono::seconds(1)),
      ConfigError);
}

/// Live, without DDS.
TEST(NodesByName, HaveServicesThatCanBeCalled) {
  Container container(ContainerOptions{.log = [](LogLevel, const std::string&, const std::string&) {}});
  std::unique_ptr<TopicAccess> access;
  ComponentDescription viewer;
  viewer.name = "viewer";
  viewer.name_space = "/";
  container.add(viewer, [&](Context& context) {
    access = context.topic_access();
    return std::make_unique<Component>();
  });
  container.start();
  std::vector<std::string> names;
  for (const auto& node : access->nodes()) names.push_back(node.name);
  EXPECT_THAT(names, testing::UnorderedElementsAre("container", "viewer"));
  std::map<std::string, std::string> services;
  for (const auto& service : access->services()) services[service.name] = service.type_name;
  EXPECT_EQ(services["/viewer/list_parameters"], "rcl_interfaces/srv/ListParameters");

  const auto call = [&](const std::string& name, const std::string& type) {
    return access->call({name, type}, to_bytes(rcl_interfaces::srv::ListParameters_Request()),
                        std::chrono::seconds(20));
  };
  const auto answer = call("/viewer/list_parameters", "rcl_interfaces/srv/ListParameters");
  ASSERT_TRUE(answer);
  EXPECT_THAT(from_bytes<rcl_interfaces::srv::ListParameters_Response>(*answer).result().names(),
              testing::Contains("use_sim_time"));
  EXPECT_FALSE(call("/viewer/list_parameters", "rcl_interfaces/srv/GetParameters"));
  EXPECT_FALSE(call("/nobody/list_parameters", "rcl_interfaces/srv/ListParameters"));
  access.reset();
}

TEST_F(TopicsByName, AreNotWrittenInAReplay) {
  EXPECT_THROW(access_->write({"/chat", "std_msgs/msg/String", {}, nullptr}), ConfigError);
}

TEST_F(TopicsByName, AreReadFromThePublishersPointOfView) {
  Context* publisher = nullptr;
  std::optional<Output<std_msgs::msg::String>> output;
  ComponentDescription chatting;
  chatting.name = "chatting";
  chatting.name_space = "/";
  harness_.container().add(chatting, [&](Context& context) {
    publisher = &context;
    output.emplace(context.output(kChat));
    return std::make_unique<Component>();
  });
  EXPECT_FALSE(publisher->has_reader(kChat));
  auto reading = read("/chat");
  EXPECT_TRUE(publisher->has_reader(kChat));
  reading.reset();
  EXPECT_FALSE(publisher->has_reader(kChat));
}

}  // namespace
}  // namespace panvo::runtime
