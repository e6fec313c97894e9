// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/interfaces/topics.hpp"
#include "panvo/recorder/bag_check.hpp"
#include "panvo/recorder/bag_copy.hpp"
#include "panvo/recorder/bag_diff.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::HasSubstr;
using testing::IsEmpty;

interfaces::Bytes odometry_bytes() {
  const auto& type = interfaces::message_type<nav_msgs::msg::Odometry>();
  const nav_msgs::msg::Odometry message;
  interfaces::Bytes bytes(type.serialized_size(&message));
  type.serialize(&message, bytes);
  return bytes;
}

TEST(CheckBag, FindsNothingInASoundBag) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "bag");
    writer.write(writer.add_topic(topic("/odom", "nav_msgs/msg/Odometry")), 1, odometry_bytes());
  }
  const auto check = check_bag(folder / "bag");
  EXPECT_TRUE(check.is_sound());
  EXPECT_EQ(check.readable, 1u);
  EXPECT_TRUE(check.topics.at(0).is_decodable);
}

TEST(CheckBag, CountsMessagesThatDoNotDecode) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "bag");
    const int odom = writer.add_topic(topic("/odom", "nav_msgs/msg/Odometry"));
    auto bytes = odometry_bytes();
    writer.write(odom, 1, bytes);
    bytes.resize(bytes.size() / 2);
    writer.write(odom, 2, bytes);
    writer.write(odom, 3, {});
  }
  const auto check = check_bag(folder / "bag");
  EXPECT_FALSE(check.is_sound());
  EXPECT_EQ(check.readable, 3u);
  EXPECT_EQ(check.topics.at(0).undecodable, 2u);
  EXPECT_FALSE(check.topics.at(0).first_error.empty());
}

TEST(CheckBag, FindsDamage) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "bag");
    write_numbered(writer, 500, 2000);
  }
  const auto file = folder / "bag" / "bag_0.db3";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const auto check = check_bag(folder / "bag");
  EXPECT_FALSE(check.is_sound());
  EXPECT_EQ(check.readable + check.lost, 500u);
  EXPECT_TRUE(any_contains(check.problems, "cut off"));
}

class TwoBags : public testing::Test {
 protected:
  void write(const std::string& name, const std::vector<Read>& messages) {
    BagWriter writer(folder_ / name, {.overwrite = true});
    std::map<std::string, int> handles;
    for (const auto& message : messages) {
      if (!handles.contains(message.topic)) {
        handles[message.topic] = writer.add_topic(topic(message.topic));
      }
      writer.write(handles[message.topic], message.timestamp_ns, message.data);
    }
  }
  std::string difference(const DiffOptions& options = {}) {
    std::string text;
    for (const auto& topic : compare_bags(folder_ / "a", folder_ / "b", options)) {
      text += topic.difference ? topic.name + " " + *topic.difference + "\n" : "";
    }
    return text;
  }

  TemporaryFolder folder_;
  const std::vector<Read> messages_{{"/x", 1, {1, 2, 3}}, {"/y", 1, {4}}, {"/x", 2, {5}}};
};

TEST_F(TwoBags, AreEqualWhenEachTopicIs) {
  write("a", messages_);
  write("b", {messages_[1], messages_[0], messages_[2]});
  EXPECT_EQ(difference(), "");
  EXPECT_EQ(compare_bags(folder_ / "a", folder_ / "b").size(), 2u);
}

TEST_F(TwoBags, DifferWhereOneBitDoes) {
  write("a", messages_);
  auto other = messages_;
  other[0].data[2] = 2;
  write("b", other);
  EXPECT_EQ(difference(), "/x message 0 differs at byte 2 of 3: 0x03, 0x02\n");
  EXPECT_EQ(difference({.topics = TopicFilter({"/y"})}), "");
}

TEST_F(TwoBags, DifferInLengthNumberAndTopics) {
  write("a", messages_);
  auto other = messages_;
  other[0].data.push_back(0);
  write("b", other);
  EXPECT_THAT(difference(), HasSubstr("/x message 0 has 3 and 4 bytes"));
  write("b", {messages_[0], messages_[1]});
  EXPECT_THAT(difference(), HasSubstr("/x ends after 1 equal messages in " + (folder_ / "b").string()));
  write("b", {messages_[0], messages_[2]});
  EXPECT_THAT(difference(), HasSubstr("/y is in " + (folder_ / "a").string() + " only"));
}

TEST_F(TwoBags, DifferInTimesOnlyWhenAsked) {
  write("a", messages_);
  auto other = messages_;
  other[1].timestamp_ns = 9;
  write("b", other);
  EXPECT_EQ(difference(), "");
  EXPECT_EQ(difference({.times = true}), "/y message 0 was recorded at 1 and 9 ns\n");
}

TEST_F(TwoBags, AreNotCalledEqualWhenOneCannotBeReadWhole) {
  for (const char* name : {"a", "b"}) {
    BagWriter writer(folder_ / name);
    write_numbered(writer, 500, 2000);
  }
  const auto file = folder_ / "b" / "b_0.db3";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THAT(error_of([&] { difference(); }), HasSubstr("cannot be compared"));
}

TEST_F(TwoBags, CopyTakesWhatIsWantedOfADamagedBag) {
  {
    BagWriter writer(folder_ / "a");
    writer.write(writer.add_topic(topic("/other")), kStart, {});
    write_numbered(writer, 500, 2000);
  }
  const auto file = folder_ / "a" / "a_0.db3";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const auto result = copy_bag(folder_ / "a", folder_ / "b", {.topics = TopicFilter({"/data"})});
  EXPECT_GT(result.copied, 100u);
  EXPECT_EQ(result.copied + result.lost, 500u);
  BagReader reader(folder_ / "b");
  EXPECT_THAT(reader.warnings(), IsEmpty());
  const auto messages = read_all(reader);
  EXPECT_EQ(messages.size(), result.copied);
  EXPECT_EQ(wrong_in_numbered(messages, 2000), "");
}

TEST_F(TwoBags, AreEqualWhenOneIsConverted) {
  write("a", messages_);
  for (const auto compression : {Compression::kNone, Compression::kLz4, Compression::kZstd}) {
    copy_bag(folder_ / "a", folder_ / "b", {},
             {.overwrite = true, .storage = Storage::kMcap, .compression = compression});
    EXPECT_EQ(difference({.times = true}), "");
  }
  copy_bag(folder_ / "b", folder_ / "c");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "c" / "c_0.db3"));
  BagReader original(folder_ / "a");
  BagReader there_and_back(folder_ / "c");
  EXPECT_EQ(read_all(there_and_back), read_all(original));
}

class Slice : public testing::TestWithParam<Storage> {};

TEST_P(Slice, KeepsTheStretchAndWhatWasLatchedBeforeIt) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "bag", {.storage = GetParam()});
    auto latched = topic("/map");
    latched.offered_qos_profiles = {offered_profile(interfaces::qos::kLatched)};
    const int map = writer.add_topic(latched);
    const int data = writer.add_topic(topic("/data"));
    writer.write(map, 10, payload(1, 5));
    for (std::int64_t time = 20; time <= 60; time += 10) {
      writer.write(data, time, payload(static_cast<std::uint64_t>(time), 5));
    }
    writer.write(map, 50, payload(2, 5));
  }
  const auto result = copy_bag(folder / "bag", folder / "part", {.from_ns = 30, .to_ns = 60}, {.storage = GetParam()});
  EXPECT_EQ(result.copied, 5u);
  BagReader reader(folder / "part");
  EXPECT_EQ(read_all(reader), (std::vector<Read>{{"/map", 30, payload(1, 5)},
                                                 {"/data", 30, payload(30, 5)},
                                                 {"/data", 40, payload(40, 5)},
                                                 {"/data", 50, payload(50, 5)},
                                                 {"/map", 50, payload(2, 5)}}));
}

INSTANTIATE_TEST_SUITE_P(Storages, Slice, testing::Values(Storage::kSqlite3, Storage::kMcap),
                         [](const auto& storage) { return to_text(storage.param); });

TEST(BagTime, IsSecondsFromTheBeginningOrAStamp) {
  EXPECT_EQ(parse_bag_time("0", kStart), kStart);
  EXPECT_EQ(parse_bag_time("12.5", kStart), kStart + 12'500'000'000);
  EXPECT_EQ(parse_bag_time(".000000001", 0), 1);
  EXPECT_EQ(parse_bag_time("1700000001.123456789", kStart), 1'700'000'001'123'456'789);
  EXPECT_EQ(parse_bag_time("1700000001123456789", kStart), 1'700'000'001'123'456'789);
  for (const char* text : {"", ".", "1.2.3", "-1", "now", "1e3", "99999999999999999999999"}) {
    EXPECT_THAT(error_of([&] { parse_bag_time(text, 0); }), HasSubstr("is not a valid bag time")) << text;
  }
}

}  // namespace
}  // namespace panvo::recorder
