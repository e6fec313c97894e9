// SPDX-License-Identifier: Apache-2.0
#include "client_request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "protocol_error.hpp"

namespace panvo::web_view {
namespace {

std::string refusal(std::string_view frame) {
  try {
    parse_text(frame);
  } catch (const ProtocolError& error) {
    return error.what();
  }
  return "";
}

TEST(ClientRequest, ReadsSubscriptions) {
  const auto request = std::get<Subscribe>(
      parse_text(R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":3},{"id":4294967295,"channelId":0}]})"));
  ASSERT_EQ(request.subscriptions.size(), 2u);
  EXPECT_EQ(request.subscriptions[0].id, 7u);
  EXPECT_EQ(request.subscriptions[0].channel, 3u);
  EXPECT_EQ(request.subscriptions[1].id, 4294967295u);
  EXPECT_THAT(std::get<Unsubscribe>(parse_text(R"({"op":"unsubscribe","subscriptionIds":[7]})")).subscriptions,
              testing::ElementsAre(7));
}

TEST(ClientRequest, ReadsWhatAClientPublishes) {
  const auto request =
      std::get<Advertise>(parse_text(R"({"op":"advertise","channels":[{"id":2,"topic":"/initialpose","encoding":"cdr",
                     "schemaName":"geometry_msgs/msg/PoseWithCovarianceStamped","schema":"unused"}]})"));
  ASSERT_EQ(request.channels.size(), 1u);
  EXPECT_EQ(request.channels[0].topic, "/initialpose");
  EXPECT_EQ(request.channels[0].encoding, "cdr");
  EXPECT_EQ(request.channels[0].schema_name, "geometry_msgs/msg/PoseWithCovarianceStamped");
  for (const auto& [written, meant] :
       {std::pair("geometry_msgs/PointStamped", "geometry_msgs/msg/PointStamped"), std::pair("Odd", "Odd")}) {
    const auto short_name = std::get<Advertise>(parse_text(
        std::string(R"({"op":"advertise","channels":[{"id":2,"topic":"/t","encoding":"cdr","schemaName":")") + written +
        "\"}]}"));
    EXPECT_EQ(short_name.channels.at(0).schema_name, meant);
  }
  EXPECT_THAT(std::get<Unadvertise>(parse_text(R"({"op":"unadvertise","channelIds":[2]})")).channels,
              testing::ElementsAre(2));
  constexpr std::array<std::uint8_t, 8> kFrame{1, 2, 1, 0, 0, 0, 1, 9};
  const auto publish = std::get<Publish>(parse_binary(kFrame));
  EXPECT_EQ(publish.channel, 258u);
  EXPECT_THAT(publish.payload, testing::ElementsAre(0, 1, 9));
}

TEST(ClientRequest, ReadsCommandsToAPlayer) {
  constexpr std::array<std::uint8_t, 21> kFrame{3, 1, 0, 0, 0x20, 0x40, 1, 2, 1,   0,  0,
                                                0, 0, 0, 0, 2,    0,    0, 0, 'a', 'b'};
  const auto moved = std::get<ControlPlayback>(parse_binary(kFrame));
  EXPECT_FALSE(moved.is_to_play);
  EXPECT_EQ(moved.speed, 2.5);
  EXPECT_EQ(moved.seek_ns, 258);
  EXPECT_EQ(moved.id, "ab");
  constexpr std::array<std::uint8_t, 19> kPlay{3, 0, 0, 0, 0x80, 0x3f, 0, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  const auto played = std::get<ControlPlayback>(parse_binary(kPlay));
  EXPECT_TRUE(played.is_to_play);
  EXPECT_EQ(played.speed, 1);
  EXPECT_FALSE(played.seek_ns);
  EXPECT_EQ(played.id, "");
}

TEST(ClientRequest, RefusesTextsThatAreNoRequest) {
  EXPECT_EQ(refusal(""), "a text message is not JSON");
  EXPECT_EQ(refusal("{\"op\":\"subscribe\""), "a text message is not JSON");
  EXPECT_EQ(refusal("\"\xff\""), "a text message is not JSON");
  EXPECT_EQ(refusal(std::string(100'000, '[')), "a text message is not JSON");
  EXPECT_EQ(refusal("[1]"), "a text message is not a JSON object");
  EXPECT_EQ(refusal("{}"), "member op is missing");
  EXPECT_EQ(refusal(R"({"op":"fly"})"), "operation fly is not supported");
  EXPECT_EQ(refusal(R"({"op":7})"), "a name is not a string");
}

TEST(ClientRequest, RefusesRequestsWithWrongMembers) {
  EXPECT_EQ(refusal(R"({"op":"subscribe"})"), "member subscriptions is missing");
  EXPECT_EQ(refusal(R"({"op":"subscribe","subscriptions":7})"), "member subscriptions is not a list");
  EXPECT_EQ(refusal(R"({"op":"subscribe","subscriptions":[7]})"), "an element of a list is not an object");
  for (const char* id : {"-1", "4294967296", "1.5", "\"1\"", "null"}) {
    EXPECT_EQ(refusal(std::string(R"({"op":"unsubscribe","subscriptionIds":[)") + id + "]}"),
              "an id is not an integer from 0 to 4294967295")
        << id;
  }
  EXPECT_EQ(refusal(R"({"op":")" + std::string(1001, 'a') + "\"}"), "a name is longer than 1000 bytes");
}

TEST(ClientRequest, RefusesBinaryRubbish) {
  const auto parse = [](std::vector<std::uint8_t> frame) { parse_binary(frame); };
  EXPECT_THROW(parse({}), ProtocolError);
  EXPECT_THROW(parse({1, 2, 0, 0}), ProtocolError);
  EXPECT_THROW(parse({9, 0, 0, 0, 0}), ProtocolError);
  EXPECT_THROW(parse({3, 0, 0, 0, 0}), ProtocolError);                                               // cut off
  EXPECT_THROW(parse({3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}), ProtocolError);     // without its id
  EXPECT_THROW(parse({3, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), ProtocolError);     // command 2
  EXPECT_THROW(parse({3, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0x80, 0, 0, 0, 0}), ProtocolError);  // in the year 2262
}

}  // namespace
}  // namespace panvo::web_view
