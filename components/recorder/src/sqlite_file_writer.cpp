// SPDX-License-Identifier: Apache-2.0
#include "sqlite_file_writer.hpp"

namespace panvo::recorder {
namespace {

using sqlite::Statement;

// 64 KiB pages: an image takes 27 pages instead of 430, which halves the CPU time. The messages of a bag of usual size
// then have one root page near the start of the file, so that a truncated file is readable up to the cut.
// Exclusive lock: no reader can block a commit. No cache spill: the file changes only during commits.
constexpr const char* kSettings =
    "PRAGMA page_size=65536;"
    "PRAGMA locking_mode=EXCLUSIVE;"
    "PRAGMA journal_mode=TRUNCATE;"
    "PRAGMA synchronous=FULL;"
    "PRAGMA cache_spill=OFF;";

constexpr const char* kSchema =
    "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);"
    "CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);"
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
    " serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL, type_description_hash TEXT NOT NULL);"
    "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT NULL,"
    " encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);"
    "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,"
    " data BLOB NOT NULL);"
    "CREATE INDEX timestamp_idx ON messages (timestamp ASC);";

constexpr int kSchemaVersion = 4;

/// Translates DatabaseError to StorageError.
template <class Action>
void guarded(Action action) {
  try {
    action();
  } catch (const sqlite::DatabaseError& error) {
    throw StorageError(error.what(), error.primary_code() == SQLITE_FULL || error.primary_code() == SQLITE_IOERR);
  }
}

}  // namespace

SqliteFileWriter::SqliteFileWriter(const std::filesystem::path& file, const std::string& ros_distro)
    : BagFileWriter(file) {
  guarded([&] {
    database_.emplace(file, sqlite::Database::Mode::kCreate);
    database_->execute(kSettings);
    database_->execute("BEGIN");
    database_->execute(kSchema);
    Statement(*database_, "INSERT INTO schema(schema_version, ros_distro) VALUES(?, ?)")
        .bind(1, std::int64_t{kSchemaVersion})
        .bind(2, ros_distro)
        .run();
    database_->execute("COMMIT");
    insert_.emplace(*database_, "INSERT INTO messages(timestamp, topic_id, data) VALUES(?, ?, ?)");
  });
}

void SqliteFileWriter::begin() {
  guarded([this] { database_->execute("BEGIN"); });
}

void SqliteFileWriter::commit() {
  guarded([this] { database_->execute("COMMIT"); });
}

void SqliteFileWriter::add_topic(int id, const BagTopic& topic, const TypeDefinition& definition) {
  guarded([&] {
    Statement(*database_, "INSERT INTO topics VALUES(?, ?, ?, ?, ?, ?)")
        .bind(1, std::int64_t{id})
        .bind(2, topic.name)
        .bind(3, topic.type)
        .bind(4, topic.serialization_format)
        .bind(5, to_text(topic.offered_qos_profiles, QosNotation::kNames))
        .bind(6, topic.type_description_hash)
        .run();
    if (!defined_types_.insert(topic.type).second) {
      return;
    }
    Statement(*database_,
              "INSERT INTO message_definitions(topic_type, encoding, encoded_message_definition, type_description_hash)"
              " VALUES(?, ?, ?, ?)")
        .bind(1, topic.type)
        .bind(2, definition.text.empty() ? std::string_view("unknown") : std::string_view(definition.encoding))
        .bind(3, definition.text)
        .bind(4, topic.type_description_hash)
        .run();
  });
}

void SqliteFileWriter::insert(int topic_id, std::int64_t timestamp_ns, std::span<const std::uint8_t> data) {
  guarded([&] { insert_->bind(1, timestamp_ns).bind(2, std::int64_t{topic_id}).bind(3, data).run(); });
}

void SqliteFileWriter::insert_metadata(const std::string& yaml) {
  guarded([&] {
    Statement(*database_, "INSERT INTO metadata(metadata_version, metadata) VALUES(?, ?)")
        .bind(1, std::int64_t{BagMetadata::kCurrentVersion})
        .bind(2, yaml)
        .run();
  });
}

void SqliteFileWriter::rollback() noexcept {
  try {
    if (database_ && database_->in_transaction()) {
      database_->execute("ROLLBACK");
    }
  } catch (const sqlite::DatabaseError&) {
    // The journal stays; the next opener rolls back.
  }
}

void SqliteFileWriter::finish() {
  insert_.reset();
  database_.reset();
  const auto journal = path_.string() + "-journal";
  std::error_code error;
  if (std::filesystem::file_size(journal, error) == 0 && !error) {
    std::filesystem::remove(journal, error);
  }
}

}  // namespace panvo::recorder
