// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/bag_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/sqlite/database.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void run_sql(const std::filesystem::path& file, const std::string& sql) {
  sqlite::Database(file, sqlite::Database::Mode::kCreate).execute(sql);
}

constexpr const char* kHumbleSchema =
    "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY,ros_distro TEXT NOT NULL);"
    "CREATE TABLE metadata(id INTEGER PRIMARY KEY,metadata_version INTEGER NOT NULL,metadata TEXT NOT NULL);"
    "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,serialization_format TEXT NOT "
    "NULL,"
    "offered_qos_profiles TEXT NOT NULL);"
    "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp INTEGER NOT NULL, data BLOB NOT "
    "NULL);"
    "CREATE INDEX timestamp_idx ON messages (timestamp ASC);"
    "INSERT INTO schema VALUES(3,'humble');";

/// Three messages, two with equal times, stored in an order that differs from the reading order.
void write_humble_bag(const TemporaryFolder& folder) {
  const auto bag = folder / "bag";
  std::filesystem::create_directories(bag);
  const std::string qos = to_text({offered_profile(interfaces::qos::kLatched)}, QosNotation::kNumbers);
  run_sql(bag / "humble_0.db3", std::string(kHumbleSchema) + "INSERT INTO topics VALUES(7,'/a','a_msgs/msg/A','cdr','" +
                                    qos +
                                    "'),(9,'/b','b_msgs/msg/B','cdr','');"
                                    "INSERT INTO messages VALUES(1,7,30,x'01'),(2,9,20,x'02'),(3,7,20,x'03');");
  std::string text;
  for (const char c : qos) {
    text += c == '\n' ? std::string("\\n") : std::string(1, c);
  }
  folder.write(
      bag / "metadata.yaml",
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n  duration:\n    nanoseconds: 10\n"
      "  starting_time:\n    nanoseconds_since_epoch: 20\n  message_count: 3\n  topics_with_message_count:\n"
      "    - topic_metadata:\n        name: /a\n        type: a_msgs/msg/A\n        serialization_format: cdr\n"
      "        offered_qos_profiles: \"" +
          text +
          "\"\n      message_count: 2\n"
          "    - topic_metadata:\n        name: /b\n        type: b_msgs/msg/B\n        serialization_format: cdr\n"
          "        offered_qos_profiles: \"\"\n      message_count: 1\n"
          "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - humble_0.db3\n"
          "  files:\n    - path: humble_0.db3\n      starting_time:\n        nanoseconds_since_epoch: 20\n"
          "      duration:\n        nanoseconds: 10\n      message_count: 3");
}

const std::vector<Read> kHumbleMessages{{"/b", 20, {2}}, {"/a", 20, {3}}, {"/a", 30, {1}}};

TEST(IsBag, NeedsMetadataOrABagFile) {
  const TemporaryFolder folder;
  EXPECT_FALSE(is_bag(folder / "missing.db3"));
  for (const auto* name : {"one/metadata.yaml", "two/bag_0.db3", "three/bag_0.mcap.zstd", "four/times.txt"}) {
    std::filesystem::create_directories((folder / name).parent_path());
    folder.write(folder / name, "");
  }
  EXPECT_TRUE(is_bag(folder / "one"));
  EXPECT_TRUE(is_bag(folder / "two"));
  EXPECT_TRUE(is_bag(folder / "two/bag_0.db3"));
  EXPECT_TRUE(is_bag(folder / "three"));
  EXPECT_FALSE(is_bag(folder / "four"));
  EXPECT_FALSE(is_bag(folder / "four/times.txt"));
}

TEST(BagReader, ReadsABagOfHumbleInOrderOfTimeThenId) {
  const TemporaryFolder folder;
  write_humble_bag(folder);
  BagReader reader(folder / "bag");
  EXPECT_THAT(reader.warnings(), IsEmpty());
  EXPECT_EQ(read_all(reader), kHumbleMessages);
  EXPECT_EQ(reader.metadata().version, 5);
  EXPECT_EQ(reader.metadata().ros_distro, "humble");
  const auto& a = reader.metadata().topics[0];
  ASSERT_EQ(a.offered_qos_profiles.size(), 1u);
  EXPECT_EQ(a.offered_qos_profiles[0].durability, QosProfile::Durability::kTransientLocal);
}

TEST(BagReader, ReadsABagWithoutMetadata) {
  const TemporaryFolder folder;
  write_humble_bag(folder);
  std::filesystem::remove(folder / "bag" / "metadata.yaml");
  BagReader reader(folder / "bag");
  EXPECT_THAT(reader.warnings(), ElementsAre(HasSubstr("metadata.yaml: is missing")));
  EXPECT_EQ(read_all(reader), kHumbleMessages);
  EXPECT_EQ(reader.metadata().topics[0].message_count, 2u);
  EXPECT_EQ(reader.metadata().duration_ns, 10);
}

TEST(BagReader, BelievesTheDatabaseMoreThanAStaleOrBrokenMetadata) {
  const TemporaryFolder folder;
  write_humble_bag(folder);
  const auto file = folder / "bag" / "metadata.yaml";
  auto stale = folder.read(file);
  stale.replace(stale.find("message_count: 3"), 16, "message_count: 8");
  for (const auto& text : {stale, stale.substr(0, 200), std::string()}) {
    folder.write(file, text);
    BagReader reader(folder / "bag");
    EXPECT_TRUE(any_contains(reader.warnings(), "reindex")) << text;
    EXPECT_EQ(reader.metadata().message_count, 3u);
    EXPECT_EQ(reader.metadata().topics[0].message_count, 2u);
    EXPECT_EQ(read_all(reader), kHumbleMessages);
  }
}

TEST(BagReader, ReadsOneDatabaseOfItself) {
  const TemporaryFolder folder;
  write_humble_bag(folder);
  BagReader reader(folder / "bag" / "humble_0.db3");
  EXPECT_THAT(reader.warnings(), IsEmpty());
  EXPECT_EQ(read_all(reader), kHumbleMessages);
}

TEST(BagReader, ReadsWithoutAnIndex) {
  const TemporaryFolder folder;
  write_humble_bag(folder);
  run_sql(folder / "bag" / "humble_0.db3", "DROP INDEX timestamp_idx");
  BagReader reader(folder / "bag");
  EXPECT_EQ(read_all(reader), kHumbleMessages);
}

TEST(BagReader, ReadsABagLeftInWriteAheadMode) {
  const TemporaryFolder folder;
  write_humble_bag(folder);
  run_sql(folder / "bag" / "humble_0.db3", "PRAGMA journal_mode=WAL");
  BagReader reader(folder / "bag");
  EXPECT_EQ(read_all(reader), kHumbleMessages);
}

TEST(BagReader, MergesFilesWhoseTimesOverlap) {
  const TemporaryFolder folder;
  write_humble_bag(folder);
  run_sql(folder / "bag" / "humble_1.db3",
          std::string(kHumbleSchema) +
              "INSERT INTO topics VALUES(1,'/b','b_msgs/msg/B','cdr','');"
              "INSERT INTO messages VALUES(1,1,20,x'04'),(2,1,25,x'05'),(3,1,40,x'06');");
  BagReader reader(folder / "bag");
  EXPECT_TRUE(any_contains(reader.warnings(), "humble_1.db3: is not listed"));
  EXPECT_EQ(read_all(reader),
            (std::vector<Read>{
                {"/b", 20, {2}}, {"/a", 20, {3}}, {"/b", 20, {4}}, {"/b", 25, {5}}, {"/a", 30, {1}}, {"/b", 40, {6}}}));
  EXPECT_EQ(reader.metadata().message_count, 6u);
}

TEST(BagReader, OrdersFilesByTheirNumber) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "bag");
  for (const int i : {10, 9, 100}) {
    run_sql(folder / "bag" / ("x_" + std::to_string(i) + ".db3"),
            std::string(kHumbleSchema) + "INSERT INTO topics VALUES(1,'/b','b_msgs/msg/B','cdr','');");
  }
  std::vector<std::string> files;
  const BagReader reader(folder / "bag");
  for (const auto& file : reader.metadata().files) {
    files.push_back(file.path);
  }
  EXPECT_THAT(files, ElementsAre("x_9.db3", "x_10.db3", "x_100.db3"));
}

TEST(BagReader, GivesOnlyWantedTopicsAndBeginsAnew) {
  const TemporaryFolder folder;
  write_humble_bag(folder);
  BagReader reader(folder / "bag");
  ASSERT_TRUE(reader.next());
  reader.select([](const BagTopic& topic) { return topic.name == "/a"; });
  EXPECT_EQ(read_all(reader), (std::vector<Read>{{"/a", 20, {3}}, {"/a", 30, {1}}}));
  EXPECT_EQ(reader.next(), nullptr);
  reader.select([](const BagTopic&) { return false; });
  EXPECT_EQ(reader.next(), nullptr);
}

TEST(BagReader, ReadsOnWhenAFileOfASplitBagIsMissing) {
  const TemporaryFolder folder;
  write_humble_bag(folder);
  const auto file = folder / "bag" / "metadata.yaml";
  auto text = folder.read(file);
  text.replace(text.find("message_count: 3"), 16, "message_count: 5");
  text.replace(text.find("    - path: humble_0.db3"), 0,
               "    - path: humble_1.db3\n      starting_time:\n        nanoseconds_since_epoch: 20\n"
               "      duration:\n        nanoseconds: 10\n      message_count: 2\n");
  folder.write(file, text);
  BagReader reader(folder / "bag");
  EXPECT_TRUE(any_contains(reader.warnings(), "humble_1.db3: is missing"));
  EXPECT_EQ(read_all(reader), kHumbleMessages);
  EXPECT_EQ(reader.lost_messages(), 2u);
}

TEST(BagReader, FindsFilesThatEarlyVersionsNamedFromTheParentFolder) {
  const TemporaryFolder folder;
  write_humble_bag(folder);
  const auto file = folder / "bag" / "metadata.yaml";
  auto text = folder.read(file);
  text.replace(text.find("path: humble_0.db3"), 18, "path: bag/humble_0.db3");
  folder.write(file, text);
  BagReader reader(folder / "bag");
  EXPECT_THAT(reader.warnings(), IsEmpty());
  EXPECT_EQ(read_all(reader), kHumbleMessages);
}

TEST(BagReader, NeverLeavesTheBagsFolder) {
  const TemporaryFolder folder;
  write_humble_bag(folder);
  std::filesystem::rename(folder / "bag" / "humble_0.db3", folder / "secret.db3");
  const auto file = folder / "bag" / "metadata.yaml";
  auto text = folder.read(file);
  text.replace(text.find("path: humble_0.db3"), 18, "path: ../secret.db3");
  folder.write(file, text);
  EXPECT_THAT(error_of([&] { BagReader reader(folder / "bag"); }), HasSubstr("none of its files"));
}

TEST(BagReader, OpensAnEmptyBag) {
  const TemporaryFolder folder;
  { BagWriter writer(folder / "bag"); }
  BagReader reader(folder / "bag");
  EXPECT_THAT(reader.warnings(), IsEmpty());
  EXPECT_EQ(reader.metadata().message_count, 0u);
  EXPECT_EQ(reader.next(), nullptr);
}

TEST(BagReader, SaysWhatIsWrongWithWhatIsNoBag) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& name) { return error_of([&] { BagReader reader(folder / name); }); };
  EXPECT_THAT(error("none"), testing::AllOf(HasSubstr("none"), HasSubstr("does not exist")));
  std::filesystem::create_directories(folder / "folder");
  EXPECT_THAT(error("folder"), HasSubstr("neither metadata.yaml nor a .db3 or .mcap file"));
  folder.write(folder / "text.db3", "Plain text instead of a database, long enough to hold a header.");
  EXPECT_THAT(error("text.db3"), HasSubstr("neither a SQLite database nor MCAP"));
  folder.write(folder / "empty.db3", "");
  EXPECT_THAT(error("empty.db3"), HasSubstr("is empty"));
  folder.write(folder / "bag.mcap", "Plain text in a file named like an MCAP bag.");
  EXPECT_THAT(error("bag.mcap"), HasSubstr("bag.mcap: nothing in it can be read"));
  folder.write(folder / "bag.db3.zstd", "\x28\xb5\x2f\xfd....");
  EXPECT_THAT(error("bag.db3.zstd"), HasSubstr("bag.db3.zstd: the compressed content cannot be read"));
  folder.write(folder / "ros1.bag", "#ROSBAG V2.0\n");
  EXPECT_THAT(error("ros1.bag"), HasSubstr("ROS 1"));
  run_sql(folder / "other.db3", "CREATE TABLE recipes(id INTEGER, text TEXT)");
  EXPECT_THAT(error("other.db3"), HasSubstr("not a bag: it has no table topics"));
}

TEST(BagReader, RefusesOtherStorageAndCompressionWithARemedy) {
  const TemporaryFolder folder;
  write_humble_bag(folder);
  const auto file = folder / "bag" / "metadata.yaml";
  const auto text = folder.read(file);
  const auto error_with = [&](const std::string& from, const std::string& to) {
    auto changed = text;
    changed.replace(changed.find(from), from.size(), to);
    folder.write(file, changed);
    return error_of([&] { BagReader reader(folder / "bag"); });
  };
  EXPECT_THAT(error_with("storage_identifier: sqlite3", "storage_identifier: tape"),
              testing::AllOf(HasSubstr("'tape'"), HasSubstr("ros2 bag convert")));
  const std::string none = "compression_format: \"\"\n  compression_mode: \"\"";
  EXPECT_THAT(error_with(none, "compression_format: bz2\n  compression_mode: MESSAGE"), HasSubstr("'bz2'"));
  EXPECT_EQ(error_with(none, "compression_format: \"\"\n  compression_mode: NONE"), "");
}

TEST(FullTypeName, CompletesWhatEarlyBagsHave) {
  EXPECT_EQ(full_type_name("sensor_msgs/Image"), "sensor_msgs/msg/Image");
  EXPECT_EQ(full_type_name("sensor_msgs/msg/Image"), "sensor_msgs/msg/Image");
  EXPECT_EQ(full_type_name("Image"), "Image");
}

}  // namespace
}  // namespace panvo::recorder
