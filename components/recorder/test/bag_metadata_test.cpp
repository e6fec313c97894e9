// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/bag_metadata.hpp"

#include <gtest/gtest.h>

#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

BagMetadata example() {
  BagMetadata bag;
  bag.start_ns = test::kStart;
  bag.duration_ns = 5;
  bag.message_count = 3;
  bag.topics = {test::topic("/a"), test::topic("/b")};
  bag.topics[0].message_count = 3;
  bag.topics[1].offered_qos_profiles = {};
  bag.files = {{"bag_0.db3", test::kStart, 5, 3}};
  set_dropped_messages(bag, "/a", 7);
  set_dropped_messages(bag, "", 7);
  return bag;
}

TEST(BagMetadata, IsTheSameAfterWritingAndReading) {
  for (const bool in_database : {false, true}) {
    const auto bag = parse_metadata(to_yaml(example(), in_database), "metadata.yaml");
    EXPECT_EQ(bag.version, 9);
    EXPECT_EQ(bag.storage_identifier, "sqlite3");
    EXPECT_EQ(bag.start_ns, test::kStart);
    EXPECT_EQ(bag.duration_ns, 5);
    EXPECT_EQ(bag.message_count, 3u);
    ASSERT_EQ(bag.topics.size(), 2u);
    EXPECT_EQ(bag.topics[0].name, "/a");
    EXPECT_EQ(bag.topics[0].message_count, 3u);
    EXPECT_EQ(bag.topics[0].offered_qos_profiles, std::vector<QosProfile>{QosProfile{}});
    EXPECT_TRUE(bag.topics[1].offered_qos_profiles.empty());
    EXPECT_EQ(bag.topics[0].type_description_hash, test::topic("/a").type_description_hash);
    ASSERT_EQ(bag.files.size(), 1u);
    EXPECT_EQ(bag.files[0].path, "bag_0.db3");
    EXPECT_EQ(bag.files[0].message_count, 3u);
    EXPECT_EQ(bag.ros_distro, "jazzy");
    EXPECT_EQ(dropped_messages(bag, "/a"), 7u);
    EXPECT_EQ(dropped_messages(bag), 7u);
    EXPECT_EQ(dropped_messages(bag, "/b"), 0u);
  }
}

TEST(BagMetadata, IsWrittenAsVersion9HasIt) {
  const auto yaml = to_yaml(example());
  for (const char* part :
       {"rosbag2_bagfile_information:\n  version: 9\n", "storage_identifier: sqlite3\n",
        "nanoseconds_since_epoch: 1700000000000000000\n", "compression_format: \"\"\n",
        "          - history: keep_last\n", "offered_qos_profiles:\n          []\n", "ros_distro: jazzy\n"}) {
    EXPECT_NE(yaml.find(part), std::string::npos) << part << "\nin\n" << yaml;
  }
}

TEST(BagMetadata, OfVersion4IsRead) {
  const auto bag = parse_metadata(
      "rosbag2_bagfile_information:\n  version: 4\n  storage_identifier: sqlite3\n  relative_file_paths:\n    - "
      "bag_0.db3\n"
      "    - bag_1.db3\n  duration:\n    nanoseconds: 20\n  starting_time:\n    nanoseconds_since_epoch: 1000\n"
      "  message_count: 2\n  topics_with_message_count:\n    - topic_metadata:\n        name: /t\n"
      "        type: std_msgs/msg/String\n        serialization_format: cdr\n        offered_qos_profiles: \"- "
      "history: 1\\n"
      "  depth: 5\\n  reliability: 2\\n  durability: 2\\n  deadline:\\n    sec: 0\\n    nsec: 0\\n  lifespan:\\n    "
      "sec: 0\\n"
      "    nsec: 0\\n  liveliness: 1\\n  liveliness_lease_duration:\\n    sec: 0\\n    nsec: 0\\n"
      "  avoid_ros_namespace_conventions: false\"\n      message_count: 2\n  compression_format: \"\"\n"
      "  compression_mode: \"\"\n",
      "metadata.yaml");
  EXPECT_EQ(bag.version, 4);
  ASSERT_EQ(bag.files.size(), 2u);
  EXPECT_EQ(bag.files[1].path, "bag_1.db3");
  ASSERT_EQ(bag.topics.size(), 1u);
  ASSERT_EQ(bag.topics[0].offered_qos_profiles.size(), 1u);
  EXPECT_EQ(bag.topics[0].offered_qos_profiles[0].depth, 5);
  EXPECT_EQ(bag.topics[0].offered_qos_profiles[0].reliability, QosProfile::Reliability::kBestEffort);
}

TEST(BagMetadata, ThatIsBrokenIsRefusedWithFileAndLine) {
  const auto whole = to_yaml(example());
  for (const std::string& broken :
       {std::string(), std::string("- a\n- b\n"), std::string("version: 1\n"), whole.substr(0, whole.size() / 2),
        std::string("rosbag2_bagfile_information: {version: nine, storage_identifier: x}\n")}) {
    const auto error = test::error_of([&] { parse_metadata(broken, "folder/metadata.yaml"); });
    EXPECT_NE(error.find("folder/metadata.yaml"), std::string::npos) << broken;
    EXPECT_NE(error.find("reindex"), std::string::npos) << broken;
  }
  EXPECT_NE(test::error_of([] { parse_metadata("a: 1\nb: [\n", "metadata.yaml"); }).find("line "), std::string::npos);
}

/// `count` topics with `count` profiles each, all but the first by alias.
std::string metadata_with_aliases(int count) {
  std::string text =
      "{version: 9, storage_identifier: mcap, duration: {nanoseconds: 0}, starting_time: {nanoseconds_since_epoch: 0}, "
      "message_count: 0, topics_with_message_count: [&t {message_count: 0, topic_metadata: {name: /a, type: b, "
      "serialization_format: cdr, offered_qos_profiles: [&p {history: 1, depth: 1, reliability: 1, durability: 1, "
      "deadline: &z {sec: 0, nsec: 0}, lifespan: *z, liveliness: 1, liveliness_lease_duration: *z, "
      "avoid_ros_namespace_conventions: false}";
  for (int i = 1; i < count; ++i) text += ", *p";
  text += "]}}";
  for (int i = 1; i < count; ++i) text += ", *t";
  return text + "]}";
}

TEST(BagMetadata, ThatAliasesBlowUpIsRefused) {
  const auto sound = parse_metadata(metadata_with_aliases(20), "metadata.yaml");
  ASSERT_EQ(sound.topics.size(), 20u);
  EXPECT_EQ(sound.topics[19].offered_qos_profiles.size(), 20u);
  const auto error = test::error_of([] { parse_metadata(metadata_with_aliases(1000), "metadata.yaml"); });
  EXPECT_NE(error.find("metadata.yaml: line 1: aliases repeat"), std::string::npos) << error;
}

TEST(BagMetadata, ReplacesTheFileAtOnceAndLeavesNothingElse) {
  const panvo::test::TemporaryFolder folder;
  write_metadata(folder.path(), example(), false);
  auto changed = example();
  changed.message_count = 4;
  write_metadata(folder.path(), changed, true);
  EXPECT_EQ(read_metadata(folder.path()).message_count, 4u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  EXPECT_NE(test::error_of([&] { write_metadata(folder / "none", changed, true); }).find("none/metadata.yaml"),
            std::string::npos);
}

}  // namespace
}  // namespace panvo::recorder
