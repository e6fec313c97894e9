// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "diagnostic_msgs/msg/DiagnosticArray.h"
#include "geometry_msgs/msg/PoseWithCovariance.h"
#include "panvo/interfaces/message_text.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "rcl_interfaces/msg/ParameterValue.h"
#include "rcl_interfaces/srv/GetParameters.h"
#include "std_msgs/msg/String.h"

namespace panvo::interfaces {
namespace {

template <class Message>
std::string yaml(const Message& message, std::size_t longest = 128) {
  const auto& type = message_type<Message>();
  Bytes bytes(type.serialized_size(&message));
  type.serialize(&message, bytes);
  return to_yaml(type, bytes, longest);
}

std::string text_line(const std::string& text) {
  std_msgs::msg::String message;
  message.data(text);
  return yaml(message);
}

TEST(MessageText, NestsMembersAndListsWhatIsFixed) {
  geometry_msgs::msg::PoseWithCovariance pose;
  pose.pose().position().x(1.5);
  pose.pose().position().y(-0.0);
  pose.pose().position().z(1e-7);
  pose.covariance()[0] = 2;
  const std::string text = yaml(pose, 2);
  EXPECT_EQ(text,
            "pose:\n  position:\n    x: 1.5\n    y: -0.0\n    z: 1e-07\n  orientation:\n    x: 0.0\n    y: 0.0\n    "
            "z: 0.0\n    w: 1.0\ncovariance:\n- 2.0\n- 0.0\n- '...'\n");
}

TEST(MessageText, ListsMessagesWithinMessages) {
  diagnostic_msgs::msg::DiagnosticArray array;
  array.status().resize(2);
  array.status()[0].name("first");
  array.status()[0].values().resize(1);
  array.status()[0].values()[0].key("rate");
  const std::string text = yaml(array);
  EXPECT_NE(text.find("status:\n- level: 0\n  name: first\n  message: ''\n  hardware_id: ''\n  values:\n  - key: rate\n"
                      "    value: ''\n- level: 0\n  name: ''\n"),
            std::string::npos)
      << text;
}

TEST(MessageText, ShowsEveryKindOfNumber) {
  rcl_interfaces::msg::ParameterValue value;
  value.type(255);
  value.bool_value(true);
  value.integer_value(std::numeric_limits<std::int64_t>::min());
  value.double_value(std::numeric_limits<double>::quiet_NaN());
  value.bool_array_value({true, false});
  value.double_array_value({HUGE_VAL, -HUGE_VAL, 3});
  EXPECT_EQ(yaml(value),
            "type: 255\nbool_value: true\ninteger_value: -9223372036854775808\ndouble_value: .nan\nstring_value: ''\n"
            "byte_array_value: []\nbool_array_value:\n- true\n- false\ninteger_array_value: []\ndouble_array_value:\n"
            "- .inf\n- -.inf\n- 3.0\nstring_array_value: []\n");
}

TEST(MessageText, QuotesWhatYamlWouldTakeForSomethingElse) {
  EXPECT_EQ(text_line("odom/base link"), "data: odom/base link\n");
  for (const char* text : {"true", "No", "12", "1.0", "- a", "a: b", "# no", "", " a", "{a}", "~"})
    EXPECT_EQ(text_line(text), "data: '" + std::string(text) + "'\n");
  EXPECT_EQ(text_line("it's"), "data: 'it''s'\n");
  EXPECT_EQ(text_line("two\nlines\t\"\\"), "data: \"two\\nlines\\x09\\\"\\\\\"\n");
}

TEST(MessageText, CutsWhatIsLong) {
  EXPECT_EQ(text_line(std::string(129, 'a')), "data: " + std::string(128, 'a') + "...\n");
  rcl_interfaces::srv::GetParameters_Request request;
  request.names({"a", "b", "c"});
  EXPECT_EQ(yaml(request, 2), "names:\n- a\n- b\n- '...'\n");
  EXPECT_EQ(yaml(request, 0), "names:\n- a\n- b\n- c\n");
}

TEST(MessageText, ReadsEitherByteOrderAndRefusesWhatIsCutOff) {
  const auto& type = message_type<std_msgs::msg::String>();
  EXPECT_EQ(to_yaml(type, Bytes{0, 0, 0, 0, 0, 0, 0, 3, 'h', 'i', 0}), "data: hi\n");
  EXPECT_THROW(to_yaml(type, Bytes{0, 0, 0, 0, 0, 0, 0, 4, 'h', 'i', 0}), DecodeError);
  EXPECT_THROW(to_yaml(type, Bytes{0, 3, 0, 0, 0, 0, 0, 0}), DecodeError);
}

}  // namespace
}  // namespace panvo::interfaces
