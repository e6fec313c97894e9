// SPDX-License-Identifier: Apache-2.0
// Properties of every message type, tested with random messages.
#include <algorithm>
#include <random>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "common_packages.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "random_message.hpp"

namespace panvo::interfaces {
namespace {

constexpr unsigned kSeeds = 20;

/// All types of panvo_interfaces and of ROS 2's common_interfaces.
std::vector<const MessageType*> every_type() {
  static const bool is_loaded = (load_common_packages(), true);
  static_cast<void>(is_loaded);
  return message_types();
}

TEST(CommonInterfaces, AreLoadedWhenTheyAreAskedFor) {
  load_common_packages();
  for (const char* name : kOneOfEachPackage)
    EXPECT_NE(find_message_type(name), nullptr) << name << " " << why_unknown(name);
}

Bytes made_up(std::size_t type_index, std::endian order, unsigned seed) {
  RandomMessage writer(order, seed);
  writer.message(*every_type()[type_index]->layout);
  return writer.bytes();
}

Bytes encode(const MessageType& type, const void* message) {
  Bytes bytes(type.serialized_size(message), 0xAA);
  type.serialize(message, bytes);
  return bytes;
}

class EveryType : public testing::TestWithParam<std::size_t> {
 protected:
  const MessageType& type() const { return *every_type()[GetParam()]; }
};

TEST_P(EveryType, WritesTheBytesItRead) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const Bytes bytes = made_up(GetParam(), std::endian::little, seed);
    EXPECT_EQ(encode(type(), type().deserialize(bytes).get()), bytes);
  }
}

TEST_P(EveryType, ReadsBigEndianToTheSameMessage) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const auto message = type().deserialize(made_up(GetParam(), std::endian::big, seed));
    EXPECT_EQ(encode(type(), message.get()), made_up(GetParam(), std::endian::little, seed));
  }
}

TEST_P(EveryType, RefusesBytesCutOffAnywhere) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const Bytes bytes = made_up(GetParam(), order, 1);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_THROW(type().deserialize(cut), DecodeError) << size << " of " << bytes.size() << " bytes";
    }
  }
}

TEST_P(EveryType, ReadsDamagedBytesOrRefusesThem) {
  std::mt19937 random(7);
  for (unsigned trial = 0; trial < 500; ++trial) {
    Bytes bytes = made_up(GetParam(), std::endian::little, trial % kSeeds);
    for (unsigned i = 0; i < 3; ++i) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    try {
      encode(type(), type().deserialize(bytes).get());
    } catch (const DecodeError& error) {
      EXPECT_EQ(std::string(error.what()).find(type().name), 0U) << error.what();
    }
  }
}

TEST_P(EveryType, IgnoresPaddingAfterTheMessage) {
  const Bytes bytes = made_up(GetParam(), std::endian::little, 3);
  Bytes padded = bytes;
  padded.insert(padded.end(), 3, 0);
  EXPECT_EQ(encode(type(), type().deserialize(padded).get()), bytes);
}

TEST_P(EveryType, RefusesParameterListsAndUnknownEncapsulations) {
  Bytes bytes = made_up(GetParam(), std::endian::little, 2);
  for (const auto& [first, second] : {std::tuple{0, 2}, {0, 3}, {0, 7}, {1, 1}, {255, 255}}) {
    bytes[0] = static_cast<std::uint8_t>(first);
    bytes[1] = static_cast<std::uint8_t>(second);
    EXPECT_THROW(type().deserialize(bytes), DecodeError);
  }
}

TEST_P(EveryType, HasAStampIfItHasAHeader) {
  const auto message = type().deserialize(made_up(GetParam(), std::endian::little, 4));
  const std::string_view own_definition = type().definition.substr(0, type().definition.find("===="));
  if (own_definition.find("std_msgs/Header header") != std::string_view::npos) {
    EXPECT_TRUE(type().stamp_ns(message.get()).has_value());
  }
}

TEST_P(EveryType, HasNamesThatAgree) {
  std::string dds_name(type().name);
  const bool is_of_a_service = dds_name.find("/srv/") != std::string::npos;
  dds_name.replace(dds_name.find(is_of_a_service ? "/srv/" : "/msg/"), 5,
                   is_of_a_service ? "::srv::dds_::" : "::msg::dds_::");
  EXPECT_EQ(type().dds_name, dds_name + "_");
  EXPECT_EQ(type().hash.size(), 71U);
  EXPECT_TRUE(type().hash.starts_with("RIHS01_"));
}

std::string test_name(const testing::TestParamInfo<std::size_t>& info) {
  std::string name(every_type()[info.param]->name);
  std::ranges::replace(name, '/', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Of, EveryType, testing::Range(std::size_t{0}, every_type().size()), test_name);

}  // namespace
}  // namespace panvo::interfaces
