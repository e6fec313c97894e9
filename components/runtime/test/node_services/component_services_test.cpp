// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "composition_interfaces/srv/ListNodes.h"
#include "composition_interfaces/srv/LoadNode.h"
#include "composition_interfaces/srv/UnloadNode.h"
#include "fake_node.hpp"

namespace panvo::runtime::node_services {
namespace {

using namespace composition_interfaces::srv;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class FakeContainer final : public ControlledContainer {
 public:
  Loaded load_component(const ComponentDescription& description) override {
    if (!refusal.empty()) throw ConfigError(std::vector<std::string>{refusal, "and more"});
    descriptions.push_back(description);
    return loaded.emplace_back(Loaded{descriptions.size(), description.name_space + "|" + description.name});
  }
  void unload_component(std::uint64_t id) override {
    if (std::erase_if(loaded, [id](const Loaded& one) { return one.id == id; }) == 0) throw ConfigError("no such id");
  }
  std::vector<Loaded> loaded_components() const override { return loaded; }

  std::vector<ComponentDescription> descriptions;
  std::vector<Loaded> loaded;
  std::string refusal;
};

class ComponentServices : public testing::Test {
 protected:
  ComponentServices() {
    request.package_name("panvo_stereo_rectifier");
    request.plugin_name("panvo::StereoRectifierComponent");
  }
  LoadNode_Response load() { return ask<LoadNode_Response>(services, "load_node", request); }

  FakeContainer container;
  const std::vector<OfferedService> services = component_services("/stereo", container);
  LoadNode_Request request;
};

TEST_F(ComponentServices, HaveRos2sNames) {
  EXPECT_EQ(services.at(0).description.name, "/stereo/_container/load_node");
  EXPECT_EQ(services.at(1).description.type_name, "composition_interfaces/srv/UnloadNode");
  EXPECT_EQ(services.at(2).description.name, "/stereo/_container/list_nodes");
}

TEST_F(ComponentServices, LoadUnderTheNameOfThePackageIfNoneIsGiven) {
  const auto response = load();
  EXPECT_TRUE(response.success()) << response.error_message();
  EXPECT_EQ(response.unique_id(), 1U);
  EXPECT_EQ(response.full_node_name(), "/|stereo_rectifier");
}

TEST_F(ComponentServices, LoadWithNameNamespaceRemapsAndParameters) {
  request.node_name("left");
  request.node_namespace("/robot");
  request.remap_rules({"image:=/camera/image", "~/a:=b"});
  rcl_interfaces::msg::Parameter parameter;
  parameter.name("scale");
  parameter.value().type(3);
  parameter.value().double_value(0.5);
  request.parameters({parameter});
  EXPECT_TRUE(load().success());
  const auto& description = container.descriptions.at(0);
  EXPECT_EQ(description.name_space, "/robot");
  EXPECT_EQ(description.name, "left");
  EXPECT_EQ(description.plugin, "panvo::StereoRectifierComponent");
  EXPECT_EQ(description.remaps.at("image"), "/camera/image");
  EXPECT_EQ(description.remaps.at("~/a"), "b");
  EXPECT_EQ(description.parameters.at("scale").items, std::vector<std::string>{"0.5"});
}

TEST_F(ComponentServices, RemapATopicByTheLastRuleInWhateverForm) {
  request.remap_rules({"/image:=/first", "image:=/last"});
  EXPECT_TRUE(load().success());
  const std::map<std::string, std::string> last{{"image", "/last"}};
  EXPECT_EQ(container.descriptions.at(0).remaps, last);
}

TEST_F(ComponentServices, NameTheNodeByARemapRule) {
  request.node_name("left");
  request.remap_rules({"__node:=right", "image:=/camera/image", "__ns:=/robot"});
  EXPECT_TRUE(load().success());
  EXPECT_EQ(container.descriptions.at(0).name, "right");
  EXPECT_EQ(container.descriptions.at(0).name_space, "/robot");
  EXPECT_EQ(container.descriptions.at(0).remaps.size(), 1U);
  request.remap_rules({"__node:=2nd"});
  EXPECT_THAT(load().error_message(), HasSubstr("node name \"2nd\""));
}

TEST_F(ComponentServices, SayAllThatIsWrongWithARequest) {
  request.node_name("1st");
  request.node_namespace("a b");
  request.remap_rules({"image"});
  request.parameters().resize(1);
  request.parameters()[0].name("scale");
  const auto response = load();
  EXPECT_FALSE(response.success());
  for (const char* part : {"1st", "a b", "from:=to", "parameter scale has no value"})
    EXPECT_THAT(response.error_message(), HasSubstr(part));
  EXPECT_THAT(container.descriptions, IsEmpty());
}

TEST_F(ComponentServices, PassOnWhyTheContainerRefuses) {
  container.refusal = "has no plugin";
  EXPECT_EQ(load().error_message(), "has no plugin; and more");
}

TEST_F(ComponentServices, ListAndUnloadByUniqueId) {
  load();
  request.node_name("second");
  load();
  UnloadNode_Request first;
  first.unique_id(1);
  EXPECT_TRUE(ask<UnloadNode_Response>(services, "unload_node", first).success());
  const auto again = ask<UnloadNode_Response>(services, "unload_node", first);
  EXPECT_FALSE(again.success());
  EXPECT_EQ(again.error_message(), "no such id");
  const auto left = ask<ListNodes_Response>(services, "list_nodes", ListNodes_Request());
  EXPECT_THAT(left.unique_ids(), ElementsAre(2));
  EXPECT_THAT(left.full_node_names(), ElementsAre("/|second"));
}

}  // namespace
}  // namespace panvo::runtime::node_services
