// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "dds/names.hpp"

namespace panvo::runtime::dds {
namespace {

TEST(WireTopicName, IsRos2sAndBack) {
  EXPECT_EQ(wire_topic_name("/stereo/left/image_rect"), "rt/stereo/left/image_rect");
  EXPECT_EQ(wire_topic_name("odom"), "rt/odom");
  EXPECT_EQ(topic_name_from_wire("rt/stereo/left/image_rect"), "/stereo/left/image_rect");
}

TEST(WireTopicName, OfAServiceOrDiscoveryIsNoTopic) {
  EXPECT_FALSE(topic_name_from_wire("rq/node/get_parametersRequest"));
  EXPECT_FALSE(topic_name_from_wire("ros_discovery_info"));
}

TEST(WireServiceName, IsRos2sAndBack) {
  EXPECT_EQ(wire_request_name("/node/get_parameters"), "rq/node/get_parametersRequest");
  EXPECT_EQ(wire_reply_name("/node/get_parameters"), "rr/node/get_parametersReply");
  EXPECT_EQ(service_from_wire_request("rq/node/get_parametersRequest"), "/node/get_parameters");
  EXPECT_EQ(service_from_wire_reply("rr/node/get_parametersReply"), "/node/get_parameters");
  for (const char* none : {"rt/odom", "rq/Request", "rq/node", "ros_discovery_info"})
    EXPECT_FALSE(service_from_wire_request(none)) << none;
  EXPECT_EQ(service_type_name("a/srv/Add_Request"), "a/srv/Add");
  EXPECT_EQ(service_type_name("a/srv/Add_Response"), "a/srv/Add");
}

TEST(WireTypeName, IsRos2sAndBack) {
  EXPECT_EQ(wire_type_name("nav_msgs/msg/Odometry"), "nav_msgs::msg::dds_::Odometry_");
  EXPECT_EQ(type_name_from_wire("nav_msgs::msg::dds_::Odometry_"), "nav_msgs/msg/Odometry");
  const std::string long_name(1'000'000, 'a');  // from a bag or from another process
  EXPECT_EQ(wire_type_name(long_name + "/msg/Odometry"), std::nullopt);
  EXPECT_EQ(type_name_from_wire(long_name + "::msg::dds_::Odometry_"), std::nullopt);
}

TEST(WireTypeName, OfAnotherFormIsNoTypeName) {
  EXPECT_FALSE(wire_type_name("Odometry"));
  EXPECT_FALSE(wire_type_name("nav_msgs/Odometry"));
  EXPECT_FALSE(type_name_from_wire("HelloWorld"));
}

}  // namespace
}  // namespace panvo::runtime::dds
