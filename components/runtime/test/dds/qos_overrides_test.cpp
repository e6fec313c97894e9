// SPDX-License-Identifier: Apache-2.0
// Parameters qos_overrides.*: the endpoints of a component as another process sees them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "graph_tool.hpp"
#include "node_service_topics.hpp"
#include "panvo/runtime/container.hpp"
#include "peer_process.hpp"
#include "test_messages.hpp"

namespace panvo::runtime::test {
namespace {

using testing::HasSubstr;

/// Reads one topic and publishes another, both reliable and volatile by default.
struct Relay : Component {
  explicit Relay(Context& context) : output(context.output(kEchoed)) {
    context.input(kToEcho, [](const auto&) {});
  }
  Output<std_msgs::msg::String> output;
};

TEST(QosOverrides, AreWhatOtherProcessesSee) {
  const int domain = test_domain();
  Container container({.dds = DdsSettings{.domain = domain, .profiles = ""}});
  ComponentDescription relay;
  relay.name = "relay";
  relay.name_space = "/";
  const auto set = [&](const std::string& name, const std::string& value) {
    relay.parameters["qos_overrides." + name] = {{value}, false, {}};
  };
  set("/robot/echoed.publisher.reliability", "best_effort");
  set("/robot/echoed.publisher.durability", "transient_local");
  set("/robot/to_echo.subscription.reliability", "best_effort");
  set("/robot/to_echo.subscription.durability", "transient_local");
  container.add(relay, [](Context& context) { return std::make_unique<Relay>(context); });
  container.start();
  for (const std::string topic : {"/robot/echoed", "/robot/to_echo"}) {
    std::string said;
    EXPECT_TRUE(eventually([&] {
      said = run_graph_tool(domain, "topic info -v " + topic).said;
      return said.find("Node: /relay") != std::string::npos;
    })) << said;
    EXPECT_THAT(said, HasSubstr("Reliability: best effort\nDurability: transient local")) << topic;
  }
}

}  // namespace
}  // namespace panvo::runtime::test
