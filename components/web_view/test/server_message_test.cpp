// SPDX-License-Identifier: Apache-2.0
#include "server_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace panvo::web_view {
namespace {

using nlohmann::json;

TEST(ServerMessage, PresentsTheServer) {
  EXPECT_EQ(json::parse(server_info("panvo", {"clientPublish"}, "12")), json::parse(R"({
    "op": "serverInfo", "name": "panvo", "capabilities": ["clientPublish"], "supportedEncodings": ["cdr"],
    "metadata": {}, "sessionId": "12"})"));
  EXPECT_EQ(json::parse(server_info("panvo", {}, ""))["capabilities"], json::array());
}

TEST(ServerMessage, OffersChannels) {
  const std::vector<Channel> channels{{3, "/chat", "std_msgs/msg/String", "string data\n"}};
  EXPECT_EQ(json::parse(advertise(channels)), json::parse(R"({
    "op": "advertise", "channels": [{"id": 3, "topic": "/chat", "encoding": "cdr", "schemaName": "std_msgs/msg/String",
    "schema": "string data\n", "schemaEncoding": "ros2msg"}]})"));
  EXPECT_EQ(json::parse(unadvertise(std::vector<std::uint32_t>{3, 4})),
            json::parse(R"({"op": "unadvertise", "channelIds": [3, 4]})"));
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
