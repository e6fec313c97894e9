// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/bag_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>

#include "panvo/sqlite/database.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::HasSubstr;

TEST(BagWriter, WritesWhatTheReaderReads) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "bag");
    const int a = writer.add_topic(topic("/a", "a_msgs/msg/A"));
    const int b = writer.add_topic(topic("/b", "b_msgs/msg/B"));
    writer.write(b, kStart + 2, payload(1, 3'000'000));  // many pages
    writer.write(a, kStart + 1, payload(2, 0));
    writer.write(a, kStart + 2, payload(3, 17));
    writer.close();
    EXPECT_EQ(writer.committed_messages(), 3u);
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "bag"), {}), 2)
      << "the database and metadata.yaml";
  BagReader reader(folder / "bag");
  EXPECT_THAT(reader.warnings(), testing::IsEmpty());
  EXPECT_EQ(read_all(reader), (std::vector<Read>{{"/a", kStart + 1, payload(2, 0)},
                                                 {"/b", kStart + 2, payload(1, 3'000'000)},
                                                 {"/a", kStart + 2, payload(3, 17)}}));
  const auto& metadata = reader.metadata();
  EXPECT_EQ(metadata.start_ns, kStart + 1);
  EXPECT_EQ(metadata.duration_ns, 1);
  EXPECT_EQ(metadata.message_count, 3u);
  ASSERT_EQ(metadata.topics.size(), 2u);
  EXPECT_EQ(metadata.topics[0].type, "a_msgs/msg/A");
  EXPECT_EQ(metadata.topics[0].message_count, 2u);
  EXPECT_EQ(metadata.topics[0].offered_qos_profiles, topic("").offered_qos_profiles);
  EXPECT_EQ(metadata.topics[0].type_description_hash, topic("").type_description_hash);
}

TEST(BagWriter, NamesItsFilesAfterAFolderThatEndsWithASlash) {
  const TemporaryFolder folder;
  {
    BagWriter writer((folder / "bag").string() + "/");
    write_numbered(writer, 3, 100);
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "bag" / "bag_0.db3"));
  EXPECT_EQ(BagReader(folder / "bag").metadata().message_count, 3U);
}

TEST(BagWriter, StoresOurTypesWithHashAndDefinition) {
  const TemporaryFolder folder;
  const auto* type = interfaces::find_message_type("nav_msgs/msg/Odometry");
  ASSERT_TRUE(type);
  {
    BagWriter writer(folder / "bag");
    writer.add_topic(BagTopic::of("/odom", *type, interfaces::qos::kResult), type->definition);
    writer.add_topic(BagTopic::of("/odom2", *type, interfaces::qos::kResult), type->definition);
  }
  const sqlite::Database database(folder / "bag" / "bag_0.db3", sqlite::Database::Mode::kRead);
  const auto value = [&](const char* sql) {
    std::string text;
    for (sqlite::Statement rows(database, sql); rows.step();) {
      text += rows.text(0) + ";";
    }
    return text;
  };
  EXPECT_EQ(value("SELECT schema_version || ros_distro FROM schema"), "4jazzy;");
  EXPECT_EQ(value("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name"),
            "message_definitions;messages;metadata;schema;topics;");
  EXPECT_EQ(value("SELECT type_description_hash FROM topics LIMIT 1"), std::string(type->hash) + ";");
  EXPECT_EQ(value("SELECT topic_type || encoding FROM message_definitions"), "nav_msgs/msg/Odometryros2msg;");
  EXPECT_EQ(value("SELECT encoded_message_definition FROM message_definitions"), std::string(type->definition) + ";");
  EXPECT_THAT(value("SELECT offered_qos_profiles FROM topics LIMIT 1"), HasSubstr("reliability: reliable"));
  EXPECT_THAT(value("SELECT metadata FROM metadata ORDER BY id DESC LIMIT 1"), HasSubstr("version: 9"));
}

TEST(BagWriter, KeepsNothingBesideTheDatabaseBetweenCommits) {
  const TemporaryFolder folder;
  BagWriter writer(folder / "bag");
  write_numbered(writer, 20, 1000);
  writer.commit();
  EXPECT_EQ(writer.committed_messages(), 20u);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "bag")) {
    const auto name = entry.path().filename().string();
    EXPECT_TRUE(name == "metadata.yaml" || name == "bag_0.db3" || entry.file_size() == 0) << name;
  }
}

TEST(BagWriter, CommitsWhenTheBatchIsFull) {
  const TemporaryFolder folder;
  BagWriter writer(folder / "bag", {.batch_time = std::chrono::hours(1), .batch_bytes = 10'000});
  write_numbered(writer, 25, 1000);
  EXPECT_EQ(writer.committed_messages(), 20u);
}

TEST(BagWriter, CommitsWhenTheBatchIsOld) {
  const TemporaryFolder folder;
  BagWriter writer(folder / "bag", {.batch_time = std::chrono::milliseconds(0)});
  const int data = writer.add_topic(topic("/data"));
  writer.write(data, kStart, payload(0, 10));
  EXPECT_EQ(writer.committed_messages(), 1u);
}

TEST(BagWriter, CommitsWhatWaitsThoughNothingMoreComes) {
  const TemporaryFolder folder;
  BagWriter writer(folder / "bag", {.batch_time = std::chrono::milliseconds(20)});
  // A commit with a new topic renames a new metadata.yaml over the old one.
  const int notifier = inotify_init1(IN_CLOEXEC);
  ASSERT_GE(inotify_add_watch(notifier, (folder / "bag").c_str(), IN_MOVED_TO), 0);
  writer.write(writer.add_topic(topic("/data")), kStart, payload(0, 10));
  char event[4096];
  EXPECT_GT(::read(notifier, event, sizeof event), 0);
  ::close(notifier);
  EXPECT_EQ(writer.committed_messages(), 1u);
}

TEST(BagWriter, StartsTheNextFileWhenOneIsFull) {
  const TemporaryFolder folder;
  constexpr std::size_t kSize = 100'000;
  {
    BagWriter writer(folder / "bag", {.max_file_bytes = 2'000'000, .batch_bytes = 500'000});
    write_numbered(writer, 60, kSize);
  }
  BagReader reader(folder / "bag");
  EXPECT_THAT(reader.warnings(), testing::IsEmpty());
  EXPECT_GE(reader.metadata().files.size(), 3u);
  EXPECT_TRUE(std::filesystem::exists(folder / "bag" / "bag_2.db3"));
  const auto messages = read_all(reader);
  EXPECT_EQ(messages.size(), 60u);
  EXPECT_EQ(wrong_in_first_numbered(messages, kSize), "");
}

TEST(BagWriter, RemembersWhatWasDropped) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "bag");
    write_numbered(writer, 1, 10);
    writer.count_dropped("/data", 3);
    writer.count_dropped("/other", 1);
    writer.count_dropped("/data", 2);
  }
  const BagReader reader(folder / "bag");
  EXPECT_EQ(dropped_messages(reader.metadata()), 6u);
  EXPECT_EQ(dropped_messages(reader.metadata(), "/data"), 5u);
  EXPECT_EQ(dropped_messages(reader.metadata(), "/other"), 1u);
}

TEST(BagWriter, RefusesAFolderThatIsInUse) {
  const TemporaryFolder folder;
  { BagWriter writer(folder / "bag"); }
  EXPECT_THAT(error_of([&] { BagWriter writer(folder / "bag"); }), HasSubstr("already exists"));
  folder.write(folder / "file", "x");
  EXPECT_THAT(error_of([&] { BagWriter writer(folder / "file"); }), HasSubstr("is a file"));
  EXPECT_THAT(error_of([&] { BagWriter writer(folder / "file" / "bag"); }), HasSubstr("cannot be created"));
}

TEST(BagWriter, OverwritesABagWhenToldToAndNothingElse) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "bag");
    write_numbered(writer, 5, 10);
  }
  {
    BagWriter writer(folder / "bag", {.overwrite = true});
    write_numbered(writer, 2, 10);
  }
  EXPECT_EQ(BagReader(folder / "bag").metadata().message_count, 2u);
  folder.write(folder / "bag" / "thesis.tex", "x");
  EXPECT_THAT(error_of([&] { BagWriter writer(folder / "bag", {.overwrite = true}); }), HasSubstr("thesis.tex"));
  EXPECT_EQ(BagReader(folder / "bag").metadata().message_count, 2u);
}

TEST(BagWriter, RefusesAFolderThatAnotherWriterIsAt) {
  const TemporaryFolder folder;
  BagWriter writer(folder / "bag");
  write_numbered(writer, 2, 100);
  EXPECT_THAT(error_of([&] { BagWriter(folder / "bag", {.overwrite = true}); }),
              HasSubstr("another recorder is writing"));
  writer.close();
  BagReader reader(folder / "bag");
  EXPECT_EQ(read_all(reader).size(), 2u);
  EXPECT_NO_THROW(BagWriter(folder / "bag", {.overwrite = true})) << "the writer has been closed";
}

/// A recording whose file or folder is changed after the first three messages.
class LostBag : public testing::TestWithParam<Storage> {
 protected:
  LostBag() {
    write_numbered(writer_, 3, 1000);
    writer_.commit();
  }
  /// The error of committing the next batch.
  std::string error_of_next_batch() {
    writer_.write(0, kStart + 10, payload(10, 1000));
    return error_of([&] { writer_.commit(); });
  }
  static std::size_t count_messages(const std::filesystem::path& bag) {
    BagReader reader(bag);
    return read_all(reader).size();
  }

  const TemporaryFolder folder_;
  const std::filesystem::path bag_ = folder_ / "bag";
  const std::filesystem::path file_ = bag_ / (GetParam() == Storage::kMcap ? "bag_0.mcap" : "bag_0.db3");
  BagWriter writer_{bag_, {.batch_time = std::chrono::hours(1), .storage = GetParam()}};
};

TEST_P(LostBag, IsKeptWhenItsFileIsRemoved) {
  std::filesystem::remove(file_);
  EXPECT_THAT(error_of_next_batch(),
              testing::AllOf(HasSubstr("was removed"), HasSubstr("4 messages"), HasSubstr(file_.string())));
  EXPECT_THAT(error_of([&] { writer_.write(0, kStart, payload(0, 1)); }), HasSubstr("was removed"));
  EXPECT_EQ(count_messages(bag_), 4u);
}

TEST_P(LostBag, IsKeptWhenItsFolderIsRemoved) {
  std::filesystem::remove_all(bag_);
  EXPECT_THAT(error_of_next_batch(), HasSubstr("was removed"));
  EXPECT_EQ(count_messages(bag_), 4u);
}

TEST_P(LostBag, StaysWhereItWasMovedTo) {
  std::filesystem::rename(bag_, folder_ / "moved");
  EXPECT_THAT(
      error_of_next_batch(),
      testing::AllOf(HasSubstr("was moved away"), HasSubstr((folder_ / "moved" / file_.filename().string()).string())));
  writer_.close();
  EXPECT_FALSE(std::filesystem::exists(bag_)) << "nothing is written to the old path";
  EXPECT_EQ(count_messages(folder_ / "moved"), 4u);
}

TEST_P(LostBag, IsKeptBesideWhatReplacesIt) {
  std::filesystem::remove(file_);
  folder_.write(file_, "somebody else's");
  const auto kept = bag_ / ("bag_0_kept1" + file_.extension().string());
  EXPECT_THAT(error_of_next_batch(), testing::AllOf(HasSubstr("was removed and replaced"), HasSubstr(kept.string())));
  writer_.close();
  EXPECT_EQ(count_messages(kept), 4u);
  EXPECT_EQ(folder_.read(file_), "somebody else's");
}

INSTANTIATE_TEST_SUITE_P(Storages, LostBag, testing::Values(Storage::kSqlite3, Storage::kMcap),
                         [](const auto& storage) { return to_text(storage.param); });

TEST(BagWriter, RefusesMessagesOnceClosed) {
  const TemporaryFolder folder;
  BagWriter writer(folder / "bag");
  const int data = writer.add_topic(topic("/data"));
  writer.close();
  EXPECT_THAT(error_of([&] { writer.write(data, kStart, payload(0, 1)); }), HasSubstr("is closed"));
  writer.close();
}

TEST(BagWriter, KeepsReadersAwayWhileItWrites) {
  const TemporaryFolder folder;
  BagWriter writer(folder / "bag");
  write_numbered(writer, 5, 10);
  writer.commit();
  EXPECT_THAT(error_of([&] { BagReader reader(folder / "bag"); }), HasSubstr("being written"));
  writer.close();
  EXPECT_EQ(BagReader(folder / "bag").metadata().message_count, 5u);
}

}  // namespace
}  // namespace panvo::recorder
