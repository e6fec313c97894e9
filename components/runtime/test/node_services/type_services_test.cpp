// SPDX-License-Identifier: Apache-2.0
// A type's description must have the type's hash, which the generator computes of the IDL.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/sha.h>

#include <algorithm>

#include "fake_node.hpp"
#include "node_services/type_description.hpp"
#include "type_description_interfaces/srv/GetTypeDescription.h"

namespace panvo::runtime::node_services {
namespace {

using type_description_interfaces::msg::IndividualTypeDescription;
using type_description_interfaces::msg::TypeDescription;
using namespace type_description_interfaces::srv;
using testing::ElementsAre;
using testing::HasSubstr;

std::string json(const IndividualTypeDescription& description) {
  std::string fields;
  for (const auto& field : description.fields()) {
    const auto& type = field.type();
    fields += fmt::format(
        "{}{{\"name\": \"{}\", \"type\": {{\"type_id\": {}, \"capacity\": {}, \"string_capacity\": {}, "
        "\"nested_type_name\": \"{}\"}}}}",
        fields.empty() ? "" : ", ", field.name(), type.type_id(), type.capacity(), type.string_capacity(),
        type.nested_type_name());
  }
  return fmt::format("{{\"type_name\": \"{}\", \"fields\": [{}]}}", description.type_name(), fields);
}

/// As defined by ROS 2 (REP 2016): SHA-256 of a canonical JSON.
std::string hash_of(const TypeDescription& description) {
  std::string contained;
  for (const auto& one : description.referenced_type_descriptions())
    contained += (contained.empty() ? "" : ", ") + json(one);
  const std::string text = fmt::format("{{\"type_description\": {}, \"referenced_type_descriptions\": [{}]}}",
                                       json(description.type_description()), contained);
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest);
  std::string hash = "RIHS01_";
  for (const auto byte : digest) hash += fmt::format("{:02x}", byte);
  return hash;
}

GetTypeDescription_Response describe(const std::string& type, const std::string& hash = "", bool with_sources = true) {
  GetTypeDescription_Request request;
  request.type_name(type);
  request.type_hash(hash);
  request.include_type_sources(with_sources);
  return ask<GetTypeDescription_Response>(type_services("/tracker"), "get_type_description", request);
}

TEST(TypeServices, DescribeEveryTypeSoThatItsHashIsRight) {
  std::size_t count = 0;
  for (const auto* type : interfaces::message_types()) {
    EXPECT_EQ(hash_of(describe_type(*type)), type->hash) << type->name;
    ++count;
  }
  EXPECT_GT(count, 60U);
}

TEST(TypeServices, GiveTheSources) {
  const auto response = describe("std_msgs/msg/Header");
  ASSERT_TRUE(response.successful()) << response.failure_reason();
  EXPECT_EQ(response.type_description().type_description().type_name(), "std_msgs/msg/Header");
  ASSERT_EQ(response.type_sources().size(), 2U);
  EXPECT_EQ(response.type_sources()[0].type_name(), "std_msgs/msg/Header");
  EXPECT_EQ(response.type_sources()[0].encoding(), "msg");
  EXPECT_THAT(response.type_sources()[0].raw_file_contents(), HasSubstr("builtin_interfaces/Time stamp"));
  EXPECT_EQ(response.type_sources()[1].type_name(), "builtin_interfaces/msg/Time");
  EXPECT_THAT(response.type_sources()[1].raw_file_contents(), HasSubstr("int32 sec"));
  EXPECT_TRUE(describe("std_msgs/msg/Header", "", false).type_sources().empty());
}

TEST(TypeServices, SayWhyThereIsNoDescription) {
  EXPECT_THAT(describe("std_msgs/msg/Nothing").failure_reason(), HasSubstr("std_msgs/msg/Nothing is unknown"));
  EXPECT_THAT(describe("std_msgs/msg/Header", "RIHS01_00").failure_reason(), HasSubstr("has the hash RIHS01_"));
}

}  // namespace
}  // namespace panvo::runtime::node_services
