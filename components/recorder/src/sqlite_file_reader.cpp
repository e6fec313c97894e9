// SPDX-License-Identifier: Apache-2.0
#include "sqlite_file_reader.hpp"

#include <algorithm>

#include "open_database.hpp"
#include "panvo/recorder/bag_error.hpp"
#include "salvage.hpp"

namespace panvo::recorder {
namespace {

using sqlite::DatabaseError;
using sqlite::Statement;

/// Stored columns of an ordinary table; empty for views and virtual tables, which may have unlimited rows. Excludes
/// generated columns, whose values may have any size.
std::set<std::string> columns_of(const sqlite::Database& database, std::string_view table) {
  std::set<std::string> columns;
  Statement statement(
      database,
      "SELECT name FROM pragma_table_info(?1) WHERE EXISTS "
      "(SELECT 1 FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND lower(name) = lower(?1))");
  statement.bind(1, table);
  while (statement.step()) {
    columns.insert(statement.text(0));
  }
  return columns;
}

}  // namespace

SqliteFileReader::SqliteFileReader(std::filesystem::path file, std::vector<std::string>& warnings)
    : BagFileReader(std::move(file), warnings), database_(open_database(path_, warnings)) {
  try {
    read_description();
  } catch (const DatabaseError& error) {
    throw BagError(path_.string() + ": its list of topics cannot be read (" + error.what() +
                   "), so the file is unusable; use another copy of the bag");
  }
  if (const auto expected = expected_bytes_if_cut(path_)) {
    salvage("is cut off: " + std::to_string(std::filesystem::file_size(path_)) + " of " + std::to_string(expected) +
            " bytes present");
    return;
  }
  try {
    read_extent();
  } catch (const DatabaseError& error) {
    salvage(std::string("is damaged (") + error.what() + ")");
  }
}

void SqliteFileReader::read_description() {
  const auto topic_columns = columns_of(database_, "topics");
  const auto message_columns = columns_of(database_, "messages");
  for (const char* column : {"id", "name", "type", "serialization_format"}) {
    if (!topic_columns.contains(column)) {
      throw BagError(path_.string() + ": is a SQLite database but not a bag: it has no table topics with column " +
                     column);
    }
  }
  for (const char* column : {"id", "topic_id", "timestamp", "data"}) {
    if (!message_columns.contains(column)) {
      throw BagError(path_.string() + ": is a SQLite database but not a bag: it has no table messages with column " +
                     column);
    }
  }
  const bool has_qos = topic_columns.contains("offered_qos_profiles");    // since schema 2 (Foxy)
  const bool has_hash = topic_columns.contains("type_description_hash");  // since schema 4 (Iron)
  Statement topics(database_, std::string("SELECT id, name, type, serialization_format, ") +
                                  (has_qos ? "offered_qos_profiles, " : "'', ") +
                                  (has_hash ? "type_description_hash" : "''") + " FROM topics ORDER BY id");
  while (topics.step()) {
    BagTopic topic;
    topic.name = topics.text(1);
    topic.type = topics.text(2);
    topic.serialization_format = topics.text(3);
    if (auto profiles = parse_qos_profiles(topics.text(4))) {
      topic.offered_qos_profiles = std::move(*profiles);
    } else {
      warnings_.push_back(path_.string() + ": the QoS profiles of topic " + topic.name +
                          " cannot be parsed; using the ROS 2 default");
    }
    topic.type_description_hash = topics.text(5);
    content_.topics.emplace(topics.integer(0), std::move(topic));
    wanted_.insert(topics.integer(0));
  }
  try {
    read_definitions();
    if (!columns_of(database_, "schema").empty()) {
      Statement schema(database_, "SELECT ros_distro FROM schema LIMIT 1");
      content_.ros_distro = schema.step() ? schema.text(0) : std::string();
    }
    if (!columns_of(database_, "metadata").empty()) {
      Statement metadata(database_, "SELECT metadata FROM metadata ORDER BY id DESC LIMIT 1");
      if (metadata.step()) {
        content_.stored_metadata = parse_metadata(metadata.text(0), path_);
      }
    }
  } catch (const std::runtime_error&) {
    // Optional data, used only if metadata.yaml is missing.
  }
}

void SqliteFileReader::read_definitions() {
  if (columns_of(database_, "message_definitions").empty()) {  // since schema 4 (Iron)
    return;
  }
  Statement definitions(database_, "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions");
  while (definitions.step()) {
    content_.definitions[definitions.text(0)] = {definitions.text(1), definitions.text(2)};
  }
}

void SqliteFileReader::read_extent() {
  // Not count(*): SQLite computes it in one step that the progress handler cannot interrupt.
  Statement extent(database_, "SELECT count(timestamp) FROM messages WHERE timestamp >= 0");
  extent.step();
  content_.message_count = static_cast<std::uint64_t>(extent.integer(0));
  if (content_.message_count == 0) {
    return;
  }
  // Separate queries: SQLite uses the index for min or max alone, not for both.
  Statement first(database_, "SELECT min(timestamp) FROM messages WHERE timestamp >= 0");
  first.step();
  content_.first_ns = first.integer(0);
  Statement last(database_, "SELECT max(timestamp) FROM messages WHERE timestamp >= 0");
  last.step();
  content_.last_ns = last.integer(0);
}

std::map<std::int64_t, std::uint64_t> SqliteFileReader::count_by_topic() {
  std::map<std::int64_t, std::uint64_t> counts;
  if (!damaged()) {
    try {
      Statement statement(database_, "SELECT topic_id, count(*) FROM messages WHERE timestamp >= 0 GROUP BY topic_id");
      while (statement.step()) {
        counts[statement.integer(0)] = static_cast<std::uint64_t>(statement.integer(1));
      }
      return counts;
    } catch (const DatabaseError& error) {
      salvage(std::string("is damaged (") + error.what() + ")");
      counts.clear();
    }
  }
  for (const auto& entry : *salvaged_) {
    ++counts[entry.topic_id];
  }
  return counts;
}

void SqliteFileReader::select(std::set<std::int64_t> topic_ids, std::int64_t begin_ns) {
  wanted_ = std::move(topic_ids);
  begin_ns_ = std::max<std::int64_t>(begin_ns, 0);
  last_entry_.reset();
  entries_.reset();
  next_salvaged_ = 0;
}

bool SqliteFileReader::next(Entry& entry, interfaces::Bytes& data) {
  while (next_entry(entry)) {
    if (!wanted_.contains(entry.topic_id) || entry.timestamp_ns < begin_ns_) {
      continue;
    }
    if (read_data(entry.id, data)) {
      return true;
    }
    ++lost_;
  }
  return false;
}

bool SqliteFileReader::next_entry(Entry& entry) {
  if (!damaged()) {
    try {
      if (!entries_) {
        // Without the data, since SQLite sorts all selected columns if the index is missing.
        entries_.emplace(database_,
                         "SELECT timestamp, id, topic_id FROM messages WHERE timestamp >= ? ORDER BY timestamp, id");
        entries_->bind(1, begin_ns_);
      }
      if (!entries_->step()) {
        return false;
      }
      entry = {entries_->integer(0), entries_->integer(1), entries_->integer(2)};
      if (!last_entry_ || *last_entry_ < entry) {
        last_entry_ = entry;
        return true;
      }
      salvage("is damaged (its index is out of order)");
    } catch (const DatabaseError& error) {
      salvage(std::string("is damaged (") + error.what() + ")");
    }
    next_salvaged_ =
        !last_entry_ ? 0
                     : static_cast<std::size_t>(std::upper_bound(salvaged_->begin(), salvaged_->end(), *last_entry_) -
                                                salvaged_->begin());
  }
  if (next_salvaged_ == salvaged_->size()) {
    return false;
  }
  entry = (*salvaged_)[next_salvaged_++];
  return true;
}

bool SqliteFileReader::read_data(std::int64_t id, interfaces::Bytes& data) {
  try {
    if (!data_) {
      data_.emplace(database_, "SELECT data FROM messages WHERE id = ?");
    }
    data_->reset();
    data_->bind(1, id);
    if (!data_->step()) {
      return false;
    }
    const auto blob = data_->blob(0);
    data.assign(blob.begin(), blob.end());
    data_->reset();
    return true;
  } catch (const DatabaseError&) {
    return false;
  }
}

void SqliteFileReader::salvage(const std::string& reason) {
  entries_.reset();
  auto found = salvage_messages(database_);
  std::erase_if(found.entries, [this](const Entry& entry) {
    return !content_.topics.contains(entry.topic_id) || entry.timestamp_ns < 0;
  });
  lost_ += found.missing_ids;
  content_.message_count = found.entries.size();
  if (!found.entries.empty()) {
    content_.first_ns = found.entries.front().timestamp_ns;
    content_.last_ns = found.entries.back().timestamp_ns;
  }
  warnings_.push_back(path_.string() + ": " + reason + "; " + std::to_string(content_.message_count) +
                      " messages can be read");
  salvaged_ = std::move(found.entries);
}

std::vector<std::string> SqliteFileReader::check_integrity() {
  std::vector<std::string> complaints;
  try {
    Statement check(database_, "PRAGMA integrity_check(20)");
    while (check.step()) {
      if (check.text(0) != "ok") {
        complaints.push_back(path_.string() + ": " + check.text(0));
      }
    }
  } catch (const DatabaseError& error) {
    complaints.push_back(path_.string() + ": " + error.what());
  }
  return complaints;
}

}  // namespace panvo::recorder
