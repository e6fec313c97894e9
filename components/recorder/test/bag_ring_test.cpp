// SPDX-License-Identifier: Apache-2.0
// Bags of many files, of which only the latest are kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "latched_messages.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> names_of(const std::vector<BagFile>& files) {
  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.path);
  return names;
}

BagTopic latched(const std::string& name) {
  auto description = topic(name);
  description.offered_qos_profiles[0].durability = QosProfile::Durability::kTransientLocal;
  return description;
}

TEST(BagRing, StartsTheNextFileAfterATimeOfTheStamps) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "bag", {.max_file_time = std::chrono::nanoseconds(10 * kStep)});
    write_numbered(writer, 35, 100);
  }
  BagReader reader(folder / "bag");
  const auto& files = reader.metadata().files;
  EXPECT_THAT(names_of(files), ElementsAre("bag_0.db3", "bag_1.db3", "bag_2.db3", "bag_3.db3"));
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_EQ(files[i].start_ns, kStart + static_cast<std::int64_t>(i) * 10 * kStep);
    EXPECT_EQ(files[i].message_count, i < 3 ? 10u : 5u);
  }
  const auto messages = read_all(reader);
  EXPECT_EQ(messages.size(), 35u);
  EXPECT_EQ(wrong_in_first_numbered(messages, 100), "");
}

TEST(BagRing, KeepsTheLatestFilesAndTheirCounts) {
  for (const auto storage : {Storage::kSqlite3, Storage::kMcap}) {
    const TemporaryFolder folder;
    {
      BagWriter writer(folder / "bag",
                       {.max_file_time = std::chrono::nanoseconds(10 * kStep), .max_files = 2, .storage = storage});
      write_numbered(writer, 35, 100);
    }
    BagReader reader(folder / "bag");
    EXPECT_THAT(reader.warnings(), IsEmpty());
    EXPECT_EQ(reader.metadata().files.size(), 2u);
    EXPECT_EQ(reader.metadata().message_count, 15u);
    EXPECT_EQ(reader.metadata().topics[0].message_count, 15u);
    EXPECT_EQ(reader.metadata().start_ns, kStart + 20 * kStep);
    EXPECT_EQ(reader.metadata().duration_ns, 14 * kStep);
    const auto messages = read_all(reader);
    ASSERT_EQ(messages.size(), 15u);
    EXPECT_EQ(messages.front().timestamp_ns, kStart + 20 * kStep);
    EXPECT_EQ(wrong_in_numbered(messages, 100), "");
    EXPECT_FALSE(std::filesystem::exists(folder / "bag" / (storage == Storage::kMcap ? "bag_1.mcap" : "bag_1.db3")));
  }
}

TEST(BagRing, RepeatsLatchedMessagesInEachFile) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "bag", {.max_file_time = std::chrono::nanoseconds(10 * kStep), .max_files = 1});
    const int transforms = writer.add_topic(latched("/tf_static"));
    writer.write(transforms, kStart, payload(1001, 50));
    writer.write(transforms, kStart, payload(1002, 50));
    writer.write(transforms, kStart, payload(1001, 50));
    write_numbered(writer, 35, 100);
  }
  BagReader reader(folder / "bag");
  EXPECT_THAT(names_of(reader.metadata().files), ElementsAre("bag_3.db3"));
  EXPECT_EQ(reader.metadata().message_count, 7u);
  const auto messages = read_all(reader);
  ASSERT_EQ(messages.size(), 7u);
  EXPECT_EQ(messages[0], (Read{"/tf_static", kStart + 30 * kStep, payload(1002, 50)}));
  EXPECT_EQ(messages[1], (Read{"/tf_static", kStart + 30 * kStep, payload(1001, 50)}));
  EXPECT_EQ(messages[2], (Read{"/data", kStart + 30 * kStep, payload(30, 100)}));
}

TEST(BagRing, DoesNotFillItselfWithLatchedMessages) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "bag",
                     {.max_file_bytes = 100'000, .max_files = 3, .batch_bytes = 1000, .storage = Storage::kMcap});
    const int maps = writer.add_topic(latched("/map"));
    for (std::uint64_t i = 0; i < 100; ++i) writer.write(maps, kStart, payload(i, 20'000));
    for (int commit = 0; commit < 20; ++commit) writer.commit();
    write_numbered(writer, 3, 100);
  }
  BagReader reader(folder / "bag");
  const auto messages = read_all(reader);
  EXPECT_EQ(messages.back().topic, "/data");
  EXPECT_GE(messages.size(), 5u);
  std::uintmax_t bytes = 0;
  for (const auto& file : reader.metadata().files) bytes += std::filesystem::file_size(folder / "bag" / file.path);
  EXPECT_LT(bytes, 600'000u);
}

TEST(BagRing, StartsNoEmptyFileWhereOneIsFullAndOver) {
  const TemporaryFolder folder;
  {
    // One message fills a file, and the next one comes after its time.
    BagWriter writer(folder / "bag", {.max_file_bytes = 1000,
                                      .max_file_time = std::chrono::nanoseconds(kStep),
                                      .batch_bytes = 1'000'000,
                                      .storage = Storage::kMcap});
    write_numbered(writer, 10, 2000);
  }
  const BagReader reader(folder / "bag");
  EXPECT_EQ(reader.metadata().files.size(), 10u);
  for (const auto& file : reader.metadata().files) EXPECT_EQ(file.message_count, 1u) << file.path;
}

TEST(BagRing, SplitsWhenAskedTo) {
  const TemporaryFolder folder;
  BagWriter writer(folder / "bag");
  const int data = writer.add_topic(topic("/data"));
  writer.write(data, kStart, payload(0, 10));
  EXPECT_THAT(writer.take_splits(), IsEmpty());
  writer.split();
  const auto splits = writer.take_splits();
  ASSERT_EQ(splits.size(), 1u);
  EXPECT_EQ(splits[0].closed, folder / "bag" / "bag_0.db3");
  EXPECT_EQ(splits[0].opened, folder / "bag" / "bag_1.db3");
  EXPECT_THAT(writer.take_splits(), IsEmpty());
  writer.write(data, kStart + kStep, payload(1, 10));
  writer.close();
  EXPECT_THAT(error_of([&] { writer.split(); }), HasSubstr("is closed"));
  BagReader reader(folder / "bag");
  EXPECT_EQ(reader.metadata().files[0].message_count, 1u);
  EXPECT_EQ(reader.metadata().files[1].message_count, 1u);
  EXPECT_EQ(wrong_in_first_numbered(read_all(reader), 10), "");
}

TEST(LatchedMessages, AreBoundedByTopicAndInAll) {
  LatchedMessages latched(1000);
  for (std::uint64_t i = 0; i < 150; ++i) latched.add(1, payload(i, 5));
  EXPECT_EQ(latched.all().size(), LatchedMessages::kMostOfTopic);
  EXPECT_EQ(latched.all().front().data, payload(50, 5));
  latched.add(2, payload(7, 900));
  EXPECT_EQ(latched.all().size(), 21u) << "the oldest 80 gave way";
  EXPECT_EQ(latched.all().back().topic, 2);
  latched.add(2, payload(8, 1001));
  EXPECT_EQ(latched.all().size(), 21u);
}

}  // namespace
}  // namespace panvo::recorder
