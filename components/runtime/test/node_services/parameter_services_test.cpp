// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_node.hpp"
#include "rcl_interfaces/srv/DescribeParameters.h"
#include "rcl_interfaces/srv/GetParameterTypes.h"
#include "rcl_interfaces/srv/GetParameters.h"
#include "rcl_interfaces/srv/ListParameters.h"
#include "rcl_interfaces/srv/SetParameters.h"
#include "rcl_interfaces/srv/SetParametersAtomically.h"

namespace panvo::runtime::node_services {
namespace {

using namespace rcl_interfaces::srv;
using rcl_interfaces::msg::Parameter;
using rcl_interfaces::msg::ParameterValue;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint8_t kNotSet = 0, kBool = 1, kInteger = 2, kDouble = 3, kString = 4, kDoubleArray = 8,
                       kStringArray = 9;  // rcl_interfaces/msg/ParameterType's

class ParameterServices : public testing::Test {
 protected:
  GetParameters_Response get(const std::vector<std::string>& names) {
    GetParameters_Request request;
    request.names(names);
    return ask<GetParameters_Response>(services, "get_parameters", request);
  }
  ListParameters_Response list(const std::vector<std::string>& prefixes, std::uint64_t depth) {
    ListParameters_Request request;
    request.prefixes(prefixes);
    request.depth(depth);
    return ask<ListParameters_Response>(services, "list_parameters", request);
  }
  SetParameters_Response set(const std::vector<Parameter>& parameters) {
    SetParameters_Request request;
    request.parameters(parameters);
    return ask<SetParameters_Response>(services, "set_parameters", request);
  }

  static Parameter number(const std::string& name, double value) {
    Parameter parameter;
    parameter.name(name);
    parameter.value().type(kDouble);
    parameter.value().double_value(value);
    return parameter;
  }
  static Parameter text(const std::string& name, const std::string& value) {
    Parameter parameter;
    parameter.name(name);
    parameter.value().type(kString);
    parameter.value().string_value(value);
    return parameter;
  }

  FakeNode node;
  const std::vector<OfferedService> services = parameter_services("/robot/tracker", node);
};

TEST_F(ParameterServices, HaveRos2sNamesAndTypes) {
  std::vector<std::string> names;
  for (const auto& service : services) names.push_back(service.description.name + " " + service.description.type_name);
  EXPECT_THAT(names,
              ElementsAre("/robot/tracker/get_parameters rcl_interfaces/srv/GetParameters",
                          "/robot/tracker/get_parameter_types rcl_interfaces/srv/GetParameterTypes",
                          "/robot/tracker/list_parameters rcl_interfaces/srv/ListParameters",
                          "/robot/tracker/describe_parameters rcl_interfaces/srv/DescribeParameters",
                          "/robot/tracker/set_parameters rcl_interfaces/srv/SetParameters",
                          "/robot/tracker/set_parameters_atomically rcl_interfaces/srv/SetParametersAtomically"));
}

TEST_F(ParameterServices, GiveValuesOfEveryTypeAndNoneForAnUnknownName) {
  const auto values =
      get({"tracker.max_features", "unknown", "tracker.gain", "mode", "enabled", "weights", "topics"}).values();
  ASSERT_EQ(values.size(), 7U);
  EXPECT_EQ(values[0].type(), kInteger);
  EXPECT_EQ(values[0].integer_value(), 500);
  EXPECT_EQ(values[1].type(), kNotSet);
  EXPECT_EQ(values[2].type(), kDouble);
  EXPECT_EQ(values[2].double_value(), 0.5);
  EXPECT_EQ(values[3].type(), kString);
  EXPECT_EQ(values[3].string_value(), "fast");
  EXPECT_EQ(values[4].type(), kBool);
  EXPECT_TRUE(values[4].bool_value());
  EXPECT_EQ(values[5].type(), kDoubleArray);
  EXPECT_THAT(values[5].double_array_value(), ElementsAre(1, 2.5));
  EXPECT_EQ(values[6].type(), kStringArray);
  EXPECT_THAT(values[6].string_array_value(), ElementsAre("a, b", "c"));
}

TEST_F(ParameterServices, GiveTypes) {
  GetParameterTypes_Request request;
  request.names({"mode", "unknown"});
  EXPECT_THAT((ask<GetParameterTypes_Response>(services, "get_parameter_types", request).types()),
              ElementsAre(kString, kNotSet));
}

TEST_F(ParameterServices, ListAllByDefaultAndWhatIsBeforeTheLastDot) {
  const auto result = list({}, 0).result();
  EXPECT_EQ(result.names().size(), node.all.size());
  EXPECT_THAT(result.prefixes(), ElementsAre("tracker", "tracker.patch"));
}

TEST_F(ParameterServices, ListWhatIsBelowAPrefixAndNoDeeperThanAsked) {
  EXPECT_THAT(list({}, 1).result().names(), ElementsAre("mode", "enabled", "weights", "topics"));
  EXPECT_THAT(list({"tracker"}, 1).result().names(), ElementsAre("tracker.max_features", "tracker.gain"));
  EXPECT_THAT(list({"tracker"}, 2).result().names(),
              ElementsAre("tracker.max_features", "tracker.gain", "tracker.patch.size"));
  EXPECT_THAT(list({"tracker.patch", "mode"}, 0).result().names(), ElementsAre("tracker.patch.size", "mode"));
  EXPECT_THAT(list({"track"}, 0).result().names(), IsEmpty());
}

TEST_F(ParameterServices, DescribeRangesChoicesUnitsAndWhatMayBeSet) {
  DescribeParameters_Request request;
  request.names({"tracker.max_features", "tracker.gain", "mode", "unknown"});
  const auto descriptors = ask<DescribeParameters_Response>(services, "describe_parameters", request).descriptors();
  ASSERT_EQ(descriptors.size(), 4U);
  ASSERT_EQ(descriptors[0].integer_range().size(), 1U);
  EXPECT_EQ(descriptors[0].integer_range()[0].to_value(), 5000);
  EXPECT_TRUE(descriptors[0].read_only());
  ASSERT_EQ(descriptors[1].floating_point_range().size(), 1U);
  EXPECT_EQ(descriptors[1].floating_point_range()[0].to_value(), 1);
  EXPECT_FALSE(descriptors[1].read_only());
  EXPECT_EQ(descriptors[1].description(), "of the test [px]");
  EXPECT_EQ(descriptors[2].additional_constraints(), "one of fast, exact");
  EXPECT_EQ(descriptors[3].name(), "unknown");
  EXPECT_EQ(descriptors[3].type(), kNotSet);
}

TEST_F(ParameterServices, SetEachForItself) {
  const auto results = set({number("tracker.gain", 0.25), number("mode", 1), text("mode", "exact")}).results();
  ASSERT_EQ(results.size(), 3U);
  EXPECT_TRUE(results[0].successful());
  EXPECT_FALSE(results[1].successful());
  EXPECT_EQ(results[1].reason(), "mode is a text, but a number was given");
  EXPECT_TRUE(results[2].successful());
  EXPECT_EQ(get({"tracker.gain"}).values()[0].double_value(), 0.25);
}

TEST_F(ParameterServices, TakeAWholeNumberForANumber) {
  Parameter whole;
  whole.name("tracker.gain");
  whole.value().type(kInteger);
  whole.value().integer_value(1);
  EXPECT_TRUE(set({whole}).results()[0].successful());
  EXPECT_EQ(node.asked.back().at("tracker.gain").items, std::vector<std::string>{"1"});
}

TEST_F(ParameterServices, RefuseToRemoveAndSayWhyTheNodeRefuses) {
  Parameter none;
  none.name("mode");
  EXPECT_THAT(set({none}).results()[0].reason(), HasSubstr("cannot be removed"));
  node.refusal = "mode is fixed";
  const auto result = set({text("mode", "exact")}).results()[0];
  EXPECT_FALSE(result.successful());
  EXPECT_EQ(result.reason(), "mode is fixed");
}

TEST_F(ParameterServices, SetAllOrNoneWhenAskedTo) {
  SetParametersAtomically_Request request;
  request.parameters({number("tracker.gain", 0.25), number("mode", 1)});
  const auto refused = ask<SetParametersAtomically_Response>(services, "set_parameters_atomically", request).result();
  EXPECT_FALSE(refused.successful());
  EXPECT_THAT(node.asked, IsEmpty());
  request.parameters({number("tracker.gain", 0.25), text("mode", "exact")});
  EXPECT_TRUE(
      ask<SetParametersAtomically_Response>(services, "set_parameters_atomically", request).result().successful());
  ASSERT_EQ(node.asked.size(), 1U);
  EXPECT_EQ(node.asked[0].size(), 2U);
}

TEST_F(ParameterServices, RefuseBytesThatAreNoRequest) {
  for (const auto& service : services) EXPECT_THROW(service.handler({0, 1, 0, 0, 9, 0, 0, 0}), interfaces::DecodeError);
}

}  // namespace
}  // namespace panvo::runtime::node_services
