// SPDX-License-Identifier: Apache-2.0
// Message packages that this program does not link: found by name, or rejected with a reason.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/interfaces/library_folders.hpp"
#include "panvo/interfaces/message_layout.hpp"
#include "panvo/interfaces/message_text.hpp"
#include "panvo/interfaces/message_type.hpp"

namespace panvo::interfaces {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Little-endian CDR of a lamp: stamp 1.5 s, frame "map", level 7, a name, one switch, an empty echo, two points, one
/// colour.
Bytes lamp(const std::string& name) {
  Bytes bytes{0, 1, 0, 0};
  const auto align = [&bytes](std::size_t to) {
    while ((bytes.size() - 4) % to != 0) bytes.push_back(0);
  };
  const auto put = [&](auto value) {
    align(sizeof value);
    const auto* raw = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), raw, raw + sizeof value);
  };
  const auto put_text = [&](const std::string& text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    bytes.insert(bytes.end(), text.begin(), text.end());
    bytes.push_back(0);
  };
  put(std::int32_t{1});
  put(std::uint32_t{500'000'000});
  put_text("map");
  put(std::uint8_t{7});
  put_text(name);
  put(std::uint32_t{1});
  put(std::uint8_t{1});
  put(std::uint32_t{0});
  for (int i = 0; i < 6; ++i) put(0.5 * i);
  put(std::uint32_t{1});
  put(0.25F);
  return bytes;
}

class MessagePackages : public testing::Test {
 protected:
  void SetUp() override { setenv("PANVO_PLUGIN_PATH", PANVO_TEST_PACKAGES, 1); }
  void TearDown() override { unsetenv("PANVO_PLUGIN_PATH"); }
};

TEST_F(MessagePackages, OfAUserAreFoundByTheNamesOfTheirTypes) {
  const MessageType* type = find_message_type("test_msgs/msg/Lamp");
  ASSERT_NE(type, nullptr) << why_unknown("test_msgs/msg/Lamp");
  EXPECT_EQ(type->name, "test_msgs/msg/Lamp");
  EXPECT_EQ(type->dds_name, "test_msgs::msg::dds_::Lamp_");
  EXPECT_EQ(type->layout->fields.size(), 7U);
  EXPECT_NE(find_message_type("test_msgs/srv/Dim_Request"), nullptr);
  EXPECT_NE(find_message_type("test_msgs/srv/Dim_Response"), nullptr);
}

TEST_F(MessagePackages, CarryMessagesAsThoseOfThisLibraryDo) {
  const MessageType& type = *find_message_type("test_msgs/msg/Lamp");
  const Bytes bytes = lamp("front");
  const auto message = type.deserialize(bytes);
  Bytes again(type.serialized_size(message.get()));
  type.serialize(message.get(), again);
  EXPECT_EQ(again, bytes);
  EXPECT_EQ(type.stamp_ns(message.get()), 1'500'000'000);
  EXPECT_THAT(to_yaml(type, bytes, 0), HasSubstr("name: front"));
  EXPECT_THROW(type.deserialize(std::span(bytes).first(20)), DecodeError);
}

TEST_F(MessagePackages, MayDeclareRulesForTheirMessages) {
  const MessageType& type = *find_message_type("test_msgs/msg/Lamp");
  ASSERT_NE(type.problem, nullptr);
  EXPECT_EQ(type.problem(type.deserialize(lamp("front")).get()), std::nullopt);
  EXPECT_EQ(type.problem(type.deserialize(lamp("")).get()), "name is empty");
  EXPECT_EQ(find_message_type("test_msgs/msg/Switch")->problem, nullptr);
}

TEST_F(MessagePackages, HaveTheDefinitionThatBagsCarry) {
  const std::string_view definition = find_message_type("test_msgs/msg/Lamp")->definition;
  EXPECT_THAT(definition, HasSubstr("uint8 FULL=255\n"));
  EXPECT_THAT(definition, HasSubstr("Switch[] switches\n"));
  EXPECT_THAT(definition, HasSubstr("float32[<=3] colour\n"));
  EXPECT_THAT(definition, HasSubstr("MSG: sensor_msgs/LaserEcho\n"));
}

TEST_F(MessagePackages, ThatAreNotThereAreNamedWithTheirRemedy) {
  EXPECT_EQ(find_message_type("missing_msgs/msg/Thing"), nullptr);
  EXPECT_THAT(why_unknown("missing_msgs/msg/Thing"), HasSubstr("cannot find libmissing_msgs__panvo.so"));
  EXPECT_EQ(find_message_type("test_msgs/msg/Candle"), nullptr);
  EXPECT_THAT(why_unknown("test_msgs/msg/Candle"), HasSubstr("the package test_msgs does not define it"));
}

TEST_F(MessagePackages, CannotBeReachedByAPath) {
  const fs::path outside = fs::path(PANVO_TEST_PACKAGES) / "outside";
  fs::create_directories(outside);
  fs::copy_file(fs::path(PANVO_TEST_PACKAGES) / message_library_name("test_msgs"), outside / "libpath_msgs__panvo.so",
                fs::copy_options::overwrite_existing);
  for (const char* name :
       {"outside/libpath_msgs/msg/Lamp", "../outside/path_msgs/msg/Lamp", "/msg/Lamp", "Path_Msgs/msg/Lamp"}) {
    EXPECT_EQ(find_message_type(name), nullptr) << name;
    EXPECT_THAT(why_unknown(name), HasSubstr("is not a type name")) << name;
  }
}

TEST_F(MessagePackages, ThatCannotBeLoadedAreRefusedWithTheReason) {
  std::ofstream(fs::path(PANVO_TEST_PACKAGES) / message_library_name("broken_msgs")) << "not a library";
  EXPECT_EQ(find_message_type("broken_msgs/msg/Thing"), nullptr);
  EXPECT_THAT(why_unknown("broken_msgs/msg/Thing"), HasSubstr("cannot be loaded: "));
}

TEST_F(MessagePackages, ThatWereBuiltWithOtherHeadersAreRefused) {
  EXPECT_EQ(find_message_type("misfit_msgs/msg/Thing"), nullptr);
  EXPECT_THAT(why_unknown("misfit_msgs/msg/Thing"), HasSubstr("was built with different headers of panvo_interfaces"));
}

TEST_F(MessagePackages, ThatStrangersNameDoNotFillTheMemory) {
  for (int i = 0; i < 3000; ++i) {
    EXPECT_EQ(find_message_type("stranger_" + std::to_string(i) + "/msg/Thing"), nullptr);
  }
  EXPECT_NE(find_message_type("nav_msgs/msg/Odometry"), nullptr);
}

}  // namespace
}  // namespace panvo::interfaces
