// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/interfaces/message_type.hpp"
#include "panvo/interfaces/node_topics.hpp"
#include "panvo/interfaces/topics.hpp"
#include "rcl_interfaces/msg/ParameterValue.h"
#include "rmw_dds_common/msg/ParticipantEntitiesInfo.h"
#include "rosgraph_msgs/msg/Clock.h"
#include "std_msgs/msg/String.h"

namespace panvo::interfaces {
namespace {

using testing::HasSubstr;

template <class Message>
Bytes encode(const Message& message) {
  const MessageType& type = message_type<Message>();
  Bytes bytes(type.serialized_size(&message), 0xAA);
  type.serialize(&message, bytes);
  return bytes;
}

template <class Message>
std::shared_ptr<Message> decode(const Bytes& bytes) {
  return std::static_pointer_cast<Message>(message_type<Message>().deserialize(bytes));
}

template <class Message>
std::string decode_error(const Bytes& bytes) {
  try {
    message_type<Message>().deserialize(bytes);
  } catch (const DecodeError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MessageType, IsFoundByItsRos2Name) {
  const MessageType* found = find_message_type("nav_msgs/msg/Odometry");
  EXPECT_EQ(found, &message_type<nav_msgs::msg::Odometry>());
  EXPECT_TRUE(*found->cpp_type == typeid(nav_msgs::msg::Odometry));
  EXPECT_EQ(found->dds_name, "nav_msgs::msg::dds_::Odometry_");
}

TEST(MessageType, IsNotFoundByOtherNames) {
  for (const char* name : {"", "nav_msgs/Odometry", "nav_msgs/msg/Odometr", "nav_msgs/msg/Odometry2", "zzz/msg/Zzz"}) {
    EXPECT_EQ(find_message_type(name), nullptr) << name;
  }
}

TEST(MessageType, ListIsSortedByName) {
  EXPECT_TRUE(std::ranges::is_sorted(message_types(), {}, [](const MessageType* type) { return type->name; }));
  EXPECT_GE(message_types().size(), 41U);
}

TEST(MessageType, HasTheHashThatRos2Announces) {
  // As printed by `ros2 topic info --verbose` and written into bags.
  const std::pair<const char*, const char*> known[] = {
      {"std_msgs/msg/String", "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"},
      {"std_msgs/msg/Empty", "RIHS01_20b625256f32d5dbc0d04fee44f43c41e51c70d3502f84b4a08e7a9c26a96312"},
      {"nav_msgs/msg/Odometry", "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0"},
      {"sensor_msgs/msg/Image", "RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47"},
      {"sensor_msgs/msg/CameraInfo", "RIHS01_b3dfd68ff46c9d56c80fd3bd4ed22c7a4ddce8c8348f2f59c299e73118e7e275"},
      {"sensor_msgs/msg/PointCloud2", "RIHS01_9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5"},
      {"tf2_msgs/msg/TFMessage", "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"},
      {"rcl_interfaces/msg/Log", "RIHS01_e28ce254ca8abc06abf92773b74602cdbf116ed34fbaf294fb9f81da9f318eac"},
      {"rcl_interfaces/msg/ParameterEvent", "RIHS01_043e627780fcad87a22d225bc2a037361dba713fca6a6b9f4b869a5aa0393204"},
  };
  for (const auto& [name, hash] : known) {
    EXPECT_EQ(find_message_type(name)->hash, hash) << name;
  }
}

TEST(MessageType, DefinitionIsRos2MsgWithAllThatIsContained) {
  const std::string_view definition = message_type<nav_msgs::msg::Odometry>().definition;
  EXPECT_THAT(definition, HasSubstr("\ngeometry_msgs/PoseWithCovariance pose\n"));
  EXPECT_THAT(definition, HasSubstr("\n" + std::string(80, '=') + "\nMSG: geometry_msgs/PoseWithCovariance\n"));
  EXPECT_THAT(definition, HasSubstr("\nfloat64[36] covariance"));
  EXPECT_THAT(message_type<rcl_interfaces::msg::Log>().definition, HasSubstr("\nuint8 WARN=30\n"));
  EXPECT_THAT(message_type<diagnostic_msgs::msg::DiagnosticArray>().definition,
              HasSubstr("\nDiagnosticStatus[] status\n"));
}

TEST(MessageType, SerialisesAsXcdr1LittleEndian) {
  std_msgs::msg::Header header;
  header.stamp().sec(0x01020304);
  header.stamp().nanosec(5);
  header.frame_id("odom");
  const Bytes expected = {0, 1, 0, 0, 4, 3, 2, 1, 5, 0, 0, 0, 5, 0, 0, 0, 'o', 'd', 'o', 'm', 0};
  EXPECT_EQ(encode(header), expected);
}

TEST(MessageType, ReadsWhatItWrote) {
  nav_msgs::msg::Odometry odometry;
  odometry.header().stamp().sec(12);
  odometry.header().frame_id("odom");
  odometry.child_frame_id("base_link");
  odometry.pose().pose().position().x(1.5);
  odometry.pose().covariance()[35] = 0.25;
  odometry.twist().twist().angular().z(-0.125);
  const auto read = decode<nav_msgs::msg::Odometry>(encode(odometry));
  EXPECT_EQ(*read, odometry);
  EXPECT_EQ(read->pose().pose().position().x(), 1.5);
  EXPECT_EQ(read->pose().covariance()[35], 0.25);
  EXPECT_EQ(read->twist().twist().angular().z(), -0.125);
}

TEST(MessageType, QuaternionStartsAsIdentityLikeInRos2) {
  const geometry_msgs::msg::Quaternion quaternion;
  EXPECT_EQ(quaternion.w(), 1.0);
  EXPECT_EQ(quaternion.x(), 0.0);
}

TEST(MessageType, TextWithNulIsCutThere) {
  std_msgs::msg::String message;
  message.data(std::string("ab\0cd", 5));
  const Bytes expected = {0, 1, 0, 0, 3, 0, 0, 0, 'a', 'b', 0};
  EXPECT_EQ(encode(message), expected);
}

TEST(MessageType, RefusesALengthBeyondTheBytesWithoutAllocatingIt) {
  sensor_msgs::msg::Image image;
  Bytes bytes = encode(image);
  std::fill(bytes.end() - 4, bytes.end(), std::uint8_t{0xFF});  // the length of data comes last
  EXPECT_THAT(decode_error<sensor_msgs::msg::Image>(bytes),
              testing::StartsWith("sensor_msgs/msg/Image: truncated or not of this type: member data"));

  Bytes path = encode(nav_msgs::msg::Path());
  std::fill(path.end() - 4, path.end(), std::uint8_t{0xFF});
  EXPECT_THAT(decode_error<nav_msgs::msg::Path>(path), HasSubstr("nav_msgs/msg/Path"));
}

TEST(MessageType, RefusesABooleanThatIsNeither0Nor1) {
  rcl_interfaces::msg::ParameterValue value;
  value.bool_value(true);
  value.bool_array_value({true});
  const Bytes bytes = encode(value);
  for (const std::size_t place : {5U, 44U}) {  // the value, and the first of the array
    ASSERT_EQ(bytes.at(place), 1U);
    Bytes damaged = bytes;
    damaged[place] = 2;
    EXPECT_EQ(decode_error<rcl_interfaces::msg::ParameterValue>(damaged),
              "rcl_interfaces/msg/ParameterValue: a boolean is neither 0 nor 1");
  }
}

TEST(MessageType, StampIsThatOfTheHeader) {
  nav_msgs::msg::Odometry odometry;
  odometry.header().stamp().sec(2'000'000'000);
  odometry.header().stamp().nanosec(999'999'999);
  EXPECT_EQ(message_type<nav_msgs::msg::Odometry>().stamp_ns(&odometry), 2'000'000'000'999'999'999);
}

TEST(MessageType, StampOfTransformsIsThatOfTheFirst) {
  tf2_msgs::msg::TFMessage transforms;
  const MessageType& type = message_type<tf2_msgs::msg::TFMessage>();
  EXPECT_EQ(type.stamp_ns(&transforms), std::nullopt);
  transforms.transforms().resize(2);
  transforms.transforms()[0].header().stamp().nanosec(7);
  EXPECT_EQ(type.stamp_ns(&transforms), 7);
}

TEST(MessageType, StampOfClockAndLogIsTheirTime) {
  rosgraph_msgs::msg::Clock clock;
  clock.clock().sec(3);
  EXPECT_EQ(message_type<rosgraph_msgs::msg::Clock>().stamp_ns(&clock), 3'000'000'000);
  rcl_interfaces::msg::Log log;
  log.stamp().sec(4);
  EXPECT_EQ(message_type<rcl_interfaces::msg::Log>().stamp_ns(&log), 4'000'000'000);
}

TEST(MessageType, WithoutATimeHasNoStamp) {
  const std_msgs::msg::String text;
  EXPECT_EQ(message_type<std_msgs::msg::String>().stamp_ns(&text), std::nullopt);
}

TEST(MessageType, HoldsNodeNamesOfRos2sLengths) {
  rmw_dds_common::msg::NodeEntitiesInfo node;
  node.node_name(std::string(256, 'n'));
  const auto read = decode<rmw_dds_common::msg::NodeEntitiesInfo>(encode(node));
  EXPECT_EQ(read->node_name(), std::string(256, 'n'));
}

}  // namespace
}  // namespace panvo::interfaces
