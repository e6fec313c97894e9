// SPDX-License-Identifier: Apache-2.0
#include "config/message_from_yaml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry_msgs/msg/PoseWithCovariance.h"
#include "panvo/interfaces/message_text.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/service.hpp"
#include "rcl_interfaces/srv/SetParameters.h"

namespace panvo::runtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <class Message>
Message read(const std::string& text) {
  return from_bytes<Message>(message_from_yaml(interfaces::message_type<Message>(), text));
}

template <class Message>
std::string why_not(const std::string& text) {
  try {
    read<Message>(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "read";
}

using Request = rcl_interfaces::srv::SetParameters_Request;
using Pose = geometry_msgs::msg::PoseWithCovariance;

TEST(MessageFromYaml, ReadsWhatIsWrittenAndLeavesTheRestZero) {
  const auto request = read<Request>(
      "{parameters: [{name: gain, value: {type: 3, double_value: 0.5}}, {name: topics, value: {type: 9, "
      "string_array_value: [a, 'b c'], bool_array_value: [true, false]}}]}");
  ASSERT_EQ(request.parameters().size(), 2U);
  EXPECT_EQ(request.parameters()[0].name(), "gain");
  EXPECT_EQ(request.parameters()[0].value().double_value(), 0.5);
  EXPECT_EQ(request.parameters()[0].value().integer_value(), 0);
  EXPECT_THAT(request.parameters()[1].value().string_array_value(), ElementsAre("a", "b c"));
  EXPECT_THAT(request.parameters()[1].value().bool_array_value(), ElementsAre(true, false));
  EXPECT_TRUE(read<Request>("").parameters().empty());
  EXPECT_TRUE(read<Request>("{}").parameters().empty());
}

TEST(MessageFromYaml, ReadsBackWhatMessagesAreShownAs) {
  Pose pose;
  pose.pose().position().x(-1e-300);
  pose.covariance()[35] = 7;
  const auto bytes = to_bytes(pose);
  const auto& type = interfaces::message_type<Pose>();
  EXPECT_EQ(message_from_yaml(type, interfaces::to_yaml(type, bytes)), bytes);
}

TEST(MessageFromYaml, SaysWhichMemberIsWrong) {
  EXPECT_THAT(why_not<Pose>("{pose: {positon: {x: 1}}}"), HasSubstr("pose: there is no member \"positon\""));
  EXPECT_THAT(why_not<Pose>("{pose: {position: {x: one}}}"), HasSubstr("pose.position.x = one: is not a number"));
  EXPECT_THAT(why_not<Pose>("{pose: 1}"), HasSubstr("pose: write its members"));
  EXPECT_THAT(why_not<Pose>("{covariance: [1, 2]}"), HasSubstr("covariance: needs 36 values, not 2"));
  EXPECT_THAT(why_not<Request>("{parameters: [{value: {type: 256}}]}"), HasSubstr("parameters[0].value.type = 256"));
  EXPECT_THAT(why_not<Request>("{parameters: {}}"), HasSubstr("write a list"));
  EXPECT_THAT(why_not<Request>("{parameters: [{name: []}]}"), HasSubstr("parameters[0].name: needs one value"));
  EXPECT_THAT(why_not<Request>("{parameters: ["), HasSubstr("YAML"));
}

TEST(ParameterValueFromYaml, TakesATypeFromWhatIsWritten) {
  EXPECT_TRUE(parameter_value_from_yaml("true").bool_value());
  EXPECT_EQ(parameter_value_from_yaml("-5").integer_value(), -5);
  EXPECT_EQ(parameter_value_from_yaml("5").type(), 2);
  EXPECT_EQ(parameter_value_from_yaml("5.0").type(), 3);
  EXPECT_EQ(parameter_value_from_yaml("fast").string_value(), "fast");
  EXPECT_EQ(parameter_value_from_yaml("'5'").string_value(), "5");
  EXPECT_EQ(parameter_value_from_yaml("\"\"").type(), 4);
}

TEST(ParameterValueFromYaml, TakesListsOfOneType) {
  EXPECT_THAT(parameter_value_from_yaml("[1, 2]").integer_array_value(), ElementsAre(1, 2));
  EXPECT_THAT(parameter_value_from_yaml("[1, 2.5]").double_array_value(), ElementsAre(1, 2.5));
  EXPECT_THAT(parameter_value_from_yaml("[a, 'b, c']").string_array_value(), ElementsAre("a", "b, c"));
  EXPECT_THAT(parameter_value_from_yaml("[true]").bool_array_value(), ElementsAre(true));
  EXPECT_EQ(parameter_value_from_yaml("[]").type(), 9);
  EXPECT_THROW(parameter_value_from_yaml("[1, a]"), ConfigError);
  EXPECT_THROW(parameter_value_from_yaml("{a: 1}"), ConfigError);
}

}  // namespace
}  // namespace panvo::runtime
