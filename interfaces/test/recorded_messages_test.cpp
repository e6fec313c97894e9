// SPDX-License-Identifier: Apache-2.0
// Compares messages with those in bags written by ROS 2 tools: bytes, type hashes and definitions.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "common_packages.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "panvo/test/recorded_data.hpp"

namespace panvo::interfaces {
namespace {

namespace fs = std::filesystem;

/// Rows of a query on a bag's database.
class Query {
 public:
  Query(const fs::path& database, const char* sql) {
    // Immutable, because the folder may be read-only. No other process writes to it.
    const std::string uri = "file:" + database.string() + "?mode=ro&immutable=1";
    sqlite3* connection = nullptr;
    const int opened = sqlite3_open_v2(uri.c_str(), &connection, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    connection_.reset(connection);
    sqlite3_stmt* statement = nullptr;
    // Bags with an older schema lack some columns; the query then returns no rows.
    if (opened == SQLITE_OK && sqlite3_prepare_v2(connection, sql, -1, &statement, nullptr) == SQLITE_OK) {
      statement_.reset(statement);
    }
  }

  bool next() { return statement_ && sqlite3_step(statement_.get()) == SQLITE_ROW; }

  Bytes bytes(int column) const {
    const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), column));
    return {data, data + sqlite3_column_bytes(statement_.get(), column)};
  }

  std::string text(int column) const {
    const Bytes data = bytes(column);
    return {data.begin(), data.end()};
  }

 private:
  std::unique_ptr<sqlite3, decltype([](sqlite3* c) { sqlite3_close_v2(c); })> connection_;
  std::unique_ptr<sqlite3_stmt, decltype([](sqlite3_stmt* s) { sqlite3_finalize(s); })> statement_;
};

class RecordedMessages : public testing::Test {
 protected:
  void SetUp() override {
    load_common_packages();
    const auto folder = panvo::test::recorded_data("bags");
    PANVO_NEEDS_RECORDING(folder);
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() == ".db3") {
        bags_.insert(entry.path());
      }
    }
  }

  std::set<fs::path> bags_;
};

/// Accepts also "sensor_msgs/Image", as written by the first ROS 2 releases, for "sensor_msgs/msg/Image".
const MessageType* find(std::string name) {
  if (name.find("/msg/") == std::string::npos && name.find('/') != std::string::npos) {
    name.insert(name.find('/'), "/msg");
  }
  return find_message_type(name);
}

/// A definition without the parts that may differ: comments, white space, defaults, package names, and where constants
/// stand: they come first.
std::string normalised(const std::string& definition) {
  std::istringstream lines(definition);
  std::string line, fields, result;
  while (std::getline(lines, line)) {
    line.erase(std::min(line.find('#'), line.size()));
    std::istringstream words(line);
    std::string type, name;
    if (!(words >> type >> name)) {
      continue;
    }
    if (type == "MSG:") result += std::exchange(fields, "");
    const std::size_t slash = type.find('/');
    const bool is_before_fields = type == "MSG:" || name.find('=') != std::string::npos;
    (is_before_fields ? result : fields) += type.substr(slash == std::string::npos ? 0 : slash + 1) + " " + name + "\n";
  }
  return result + fields;
}

/// Whether `later` has all lines of `earlier` in the same order, possibly with new lines between them.
bool extends(const std::string& later, const std::string& earlier) {
  std::istringstream later_lines(later), earlier_lines(earlier);
  std::string wanted, line;
  while (std::getline(earlier_lines, wanted)) {
    do {
      if (!std::getline(later_lines, line)) return false;
    } while (line != wanted);
  }
  return true;
}

/// Types with an additional field in Jazzy (variance, node_name); the bags are from Iron.
bool has_grown(std::string_view type) {
  return type == "sensor_msgs/msg/Range" || type == "rosbag2_interfaces/msg/WriteSplitEvent";
}
/// For the tool that wrote the bags, `char` is a type of its own; in ROS 2 it is uint8.
constexpr std::string_view kHashedOtherwise = "std_msgs/msg/Char";

Bytes read_and_written(const MessageType& type, const Bytes& recorded) {
  const auto message = type.deserialize(recorded);
  Bytes written(type.serialized_size(message.get()), 0xAA);
  type.serialize(message.get(), written);
  return written;
}

TEST_F(RecordedMessages, AreWrittenByteForByteAsTheyWereRead) {
  std::set<std::string_view> types;
  int messages = 0;
  for (const fs::path& bag : bags_) {
    Query query(bag, "SELECT topics.type, messages.data FROM messages JOIN topics ON topics.id = messages.topic_id");
    while (query.next()) {
      const MessageType* type = find(query.text(0));
      if (type == nullptr || has_grown(type->name)) continue;
      Bytes recorded = query.bytes(1);
      const Bytes written = read_and_written(*type, recorded);
      // Padding between members may have any value, and a recorder may keep the padding after the last member.
      ASSERT_LE(written.size(), recorded.size()) << type->name << " in " << bag;
      ASSERT_LE(recorded.size() - written.size(), 3U) << type->name << " in " << bag;
      recorded.resize(written.size());
      for (std::size_t i = 0; i < written.size(); ++i) {
        if (written[i] == recorded[i]) continue;
        EXPECT_EQ(written[i], 0U) << "byte " << i << " of " << type->name << " in " << bag;
        ++recorded[i];  // a byte of padding has no effect on the message
        ASSERT_EQ(read_and_written(*type, recorded), written) << "byte " << i << " of " << type->name << " in " << bag;
      }
      types.insert(type->name);
      ++messages;
    }
  }
  RecordProperty("messages", messages);
  RecordProperty("types", static_cast<int>(types.size()));
  EXPECT_GE(types.size(), 85U);
  EXPECT_GE(messages, 3000);
}

TEST_F(RecordedMessages, KeepTheRulesOfTheirTypes) {
  std::set<std::string_view> types;
  for (const fs::path& bag : bags_) {
    // Bags of rosbag2's own tests have random numbers and images of three bytes.
    const std::string name = bag.stem();
    if (name.find("rosbag2_test") != std::string::npos || name.find("test_bag") != std::string::npos) continue;
    Query query(bag, "SELECT topics.type, messages.data FROM messages JOIN topics ON topics.id = messages.topic_id");
    while (query.next()) {
      const MessageType* type = find(query.text(0));
      if (type == nullptr || type->problem == nullptr) continue;
      const auto message = type->deserialize(query.bytes(1));
      EXPECT_EQ(type->problem(message.get()), std::nullopt) << type->name << " in " << bag;
      types.insert(type->name);
    }
  }
  EXPECT_GE(types.size(), 5U);  // types with rules, in bags recorded on robots
}

TEST_F(RecordedMessages, HaveOurTypeHashes) {
  std::set<std::string_view> types;
  for (const fs::path& bag : bags_) {
    Query query(bag, "SELECT type, type_description_hash FROM topics WHERE type_description_hash != ''");
    while (query.next()) {
      if (const MessageType* type = find(query.text(0));
          type && !has_grown(type->name) && type->name != kHashedOtherwise) {
        EXPECT_EQ(type->hash, query.text(1)) << type->name << " in " << bag;
        types.insert(type->name);
      }
    }
  }
  EXPECT_GE(types.size(), 85U);
}

TEST_F(RecordedMessages, HaveOurDefinitions) {
  std::set<std::string_view> types;
  for (const fs::path& bag : bags_) {
    // Some of rosbag2's own test bags have stubs instead of definitions, and then no type hash.
    Query query(bag,
                "SELECT topic_type, encoded_message_definition FROM message_definitions JOIN topics ON topics.type = "
                "topic_type "
                "WHERE topics.type_description_hash != ''");
    while (query.next()) {
      const MessageType* type = find(query.text(0));
      if (type != nullptr && type->name != kHashedOtherwise && !query.text(1).empty()) {
        EXPECT_TRUE(extends(normalised(std::string(type->definition)), normalised(query.text(1))))
            << type->name << " in " << bag << ":\n"
            << normalised(query.text(1)) << "ours:\n"
            << normalised(std::string(type->definition));
        types.insert(type->name);
      }
    }
  }
  EXPECT_GE(types.size(), 85U);
}

}  // namespace
}  // namespace panvo::interfaces
