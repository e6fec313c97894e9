// SPDX-License-Identifier: Apache-2.0
#include "server_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "std_msgs/msg/Header.h"
#include "std_msgs/msg/String.h"

namespace panvo::web_view {
namespace {

using nlohmann::json;

TEST(ServerMessage, PresentsTheServer) {
  EXPECT_EQ(json::parse(server_info("panvo", {"clientPublish"}, "12", {})), json::parse(R"({
    "op": "serverInfo", "name": "panvo", "capabilities": ["clientPublish"], "supportedEncodings": ["cdr"],
    "metadata": {"ROS_DISTRO": "jazzy"}, "sessionId": "12"})"));
  const json reading_only = json::parse(server_info("panvo", {}, "", {}));
  EXPECT_EQ(reading_only["capabilities"], json::array());
  EXPECT_EQ(reading_only["metadata"], json::object());
  const json playing = json::parse(server_info("panvo", {}, "", runtime::StampRange{2'000'000'003, 4'500'000'000}));
  EXPECT_EQ(playing["dataStartTime"], json::parse(R"({"sec": 2, "nsec": 3})"));
  EXPECT_EQ(playing["dataEndTime"], json::parse(R"({"sec": 4, "nsec": 500000000})"));
}

TEST(ServerMessage, OffersChannels) {
  const auto& type = interfaces::message_type<std_msgs::msg::String>();
  const std::vector<Channel> channels{{3, {"/chat", "std_msgs/msg/String", {}, &type}},
                                      {4, {"/odd", "odd_msgs/msg/Odd", {}, nullptr}}};
  json expected = json::parse(R"({
    "op": "advertise", "channels": [{"id": 3, "topic": "/chat", "encoding": "cdr", "schemaName": "std_msgs/msg/String",
    "schema": "", "schemaEncoding": "ros2msg"}, {"id": 4, "topic": "/odd", "encoding": "cdr",
    "schemaName": "odd_msgs/msg/Odd", "schema": "", "schemaEncoding": "ros2msg"}]})");
  expected["channels"][0]["schema"] = type.definition;
  EXPECT_EQ(json::parse(advertise(channels, SchemaNotation::kRos2msg)), expected);
  EXPECT_EQ(json::parse(unadvertise(std::vector<std::uint32_t>{3, 4})),
            json::parse(R"({"op": "unadvertise", "channelIds": [3, 4]})"));
}

TEST(ServerMessage, DescribesTypesInOmgIdlToo) {
  const auto& type = interfaces::message_type<std_msgs::msg::Header>();
  const std::vector<Channel> channels{{3, {"/head", "std_msgs/msg/Header", {}, &type}},
                                      {4, {"/odd", "odd_msgs/msg/Odd", {}, nullptr}}};
  const json offered = json::parse(advertise(channels, SchemaNotation::kOmgIdl))["channels"];
  EXPECT_EQ(offered[0]["schemaName"], "std_msgs::msg::Header");
  EXPECT_EQ(offered[0]["schemaEncoding"], "omgidl");
  EXPECT_THAT(std::string(offered[0]["schema"]), testing::HasSubstr("builtin_interfaces::msg::Time stamp;"));
  EXPECT_EQ(offered[1]["schema"], "");
  const std::vector<OfferedService> services{{7, {"/node/list_parameters", "rcl_interfaces/srv/ListParameters"}}};
  const json service = json::parse(advertise_services(services, SchemaNotation::kOmgIdl))["services"].at(0);
  EXPECT_EQ(service["type"], "rcl_interfaces/srv/ListParameters");
  EXPECT_EQ(service["request"]["schemaName"], "rcl_interfaces::srv::ListParameters_Request");
  EXPECT_THAT(std::string(service["request"]["schema"]), testing::HasSubstr("sequence<string> prefixes;"));
}

TEST(ServerMessage, OffersServicesWithBothSchemas) {
  const std::vector<OfferedService> services{{7, {"/node/list_parameters", "rcl_interfaces/srv/ListParameters"}}};
  const json service = json::parse(advertise_services(services, SchemaNotation::kRos2msg))["services"].at(0);
  EXPECT_EQ(service["id"], 7);
  EXPECT_EQ(service["name"], "/node/list_parameters");
  EXPECT_EQ(service["type"], "rcl_interfaces/srv/ListParameters");
  EXPECT_EQ(service["request"]["schemaName"], "rcl_interfaces/srv/ListParameters_Request");
  EXPECT_THAT(std::string(service["request"]["schema"]), testing::HasSubstr("string[] prefixes"));
  EXPECT_EQ(service["response"]["encoding"], "cdr");
  EXPECT_EQ(json::parse(unadvertise_services(std::vector<std::uint32_t>{7})),
            json::parse(R"({"op": "unadvertiseServices", "serviceIds": [7]})"));
}

TEST(ServerMessage, NamesTheTypeOfParametersThatJavaScriptWouldTakeForIntegers) {
  const std::vector<Parameter> parameters{{"/a/on", true},
                                          {"/a/one", 1.0},
                                          {"/a/two", std::int64_t{2}},
                                          {"/a/list", std::vector<double>{1.0}},
                                          {"/a/gone", {}}};
  EXPECT_EQ(json::parse(parameter_values(parameters, "x")), json::parse(R"({
    "op": "parameterValues", "id": "x", "parameters": [{"name": "/a/on", "value": true},
    {"name": "/a/one", "value": 1.0, "type": "float64"}, {"name": "/a/two", "value": 2},
    {"name": "/a/list", "value": [1.0], "type": "float64_array"}, {"name": "/a/gone"}]})"));
  EXPECT_FALSE(json::parse(parameter_values({}, "")).contains("id"));
}

TEST(ServerMessage, TellsWhatChangedInTheGraph) {
  const ConnectionGraph before{{{"/a", {"/one"}}, {"/b", {"/one"}}}, {{"/b", {"/two"}}}, {{"/s", {"/one"}}}};
  const ConnectionGraph now{{{"/a", {"/one", "/two"}}}, {{"/b", {"/two"}}}, {}};
  EXPECT_EQ(json::parse(connection_graph_update(before, now)), json::parse(R"({
    "op": "connectionGraphUpdate", "publishedTopics": [{"name": "/a", "publisherIds": ["/one", "/two"]},
    {"name": "/b", "publisherIds": []}], "subscribedTopics": [], "advertisedServices": [], "removedTopics": [],
    "removedServices": ["/s"]})"));
  EXPECT_EQ(json::parse(connection_graph_update(now, {}))["removedTopics"], json::parse(R"(["/a", "/b"])"));
}

TEST(ServerMessage, WritesBinaryAnswersInLittleEndian) {
  using testing::ElementsAre;
  EXPECT_THAT(service_response_head(1, 2), ElementsAre(3, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r'));
  EXPECT_THAT(time_frame(0x0102), ElementsAre(2, 2, 1, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(playback_frame({PlaybackStatus::kEnded, 0x0102, 2.5}, true, "ab"),
              ElementsAre(5, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0x20, 0x40, 1, 2, 0, 0, 0, 'a', 'b'));
  EXPECT_THAT(asset_frame(9, "ab"), ElementsAre(4, 9, 0, 0, 0, 0, 0, 0, 0, 0, 'a', 'b'));
  EXPECT_THAT(asset_failure(9, "no"), ElementsAre(4, 9, 0, 0, 0, 1, 2, 0, 0, 0, 'n', 'o'));
}

TEST(ServerMessage, TellsOfProblems) {
  EXPECT_EQ(json::parse(status(StatusLevel::kError, "why")),
            json::parse(R"({"op": "status", "level": 2, "message": "why"})"));
}

TEST(ServerMessage, ReplacesInvalidUtf8) {
  EXPECT_EQ(json::parse(status(StatusLevel::kInfo, "a\xff"))["message"], "a\xef\xbf\xbd");
}

TEST(ServerMessage, WritesTheHeadOfAMessageInLittleEndian) {
  EXPECT_THAT(message_head(0x01020304, 0x1112131415161718),
              testing::ElementsAre(1, 4, 3, 2, 1, 0x18, 0x17, 0x16, 0x15, 0x14, 0x13, 0x12, 0x11));
}

}  // namespace
}  // namespace panvo::web_view
