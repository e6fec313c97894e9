// SPDX-License-Identifier: Apache-2.0
#include "sqlite_mutator.hpp"

#include <sqlite3.h>

#include <array>
#include <cstring>
#include <memory>
#include <random>

namespace panvo::recorder::fuzz {
namespace {

using Random = std::minstd_rand;

// Each statement breaks one assumption of a bag reader. ? is replaced by a small, large or negative number.
constexpr std::array kStatements{
    "UPDATE messages SET id = id + ?",
    "UPDATE messages SET timestamp = ? WHERE id % 3 = 0",
    "UPDATE messages SET timestamp = 'later' WHERE id % 7 = 0",
    "UPDATE messages SET timestamp = 1e300 WHERE id % 5 = 0",
    "UPDATE messages SET topic_id = ? WHERE id % 4 = 0",
    "UPDATE messages SET data = NULL WHERE id % 2 = 0",
    "UPDATE messages SET data = 'text' WHERE id % 3 = 0",
    "UPDATE messages SET data = zeroblob(? % 100000) WHERE id = 3",
    "INSERT INTO messages(id, topic_id, timestamp, data) VALUES (?, 1, 2, x'00')",
    "DELETE FROM messages WHERE id % 2 = 0",
    "DROP INDEX timestamp_idx",
    "REINDEX",
    "UPDATE topics SET id = ?",
    "UPDATE topics SET name = NULL",
    "UPDATE topics SET name = CAST(x'ff00fe' AS TEXT), type = ''",
    "UPDATE topics SET serialization_format = 'cdr;zstd'",
    "UPDATE topics SET offered_qos_profiles = '- history: [' || ? || '}'",
    "INSERT INTO topics SELECT id + ?, name, type, serialization_format, offered_qos_profiles, '' FROM topics",
    "DELETE FROM topics",
    "UPDATE schema SET ros_distro = ?, schema_version = ?",
    "UPDATE metadata SET metadata = 'rosbag2_bagfile_information: {version: ' || ? || '}'",
    "UPDATE metadata SET metadata = zeroblob(70000)",
    "UPDATE message_definitions SET encoded_message_definition = NULL",
    "DROP TABLE metadata",
    "DROP TABLE message_definitions",
    "ALTER TABLE messages RENAME COLUMN data TO date",
    "ALTER TABLE messages RENAME TO m; CREATE VIEW messages AS SELECT * FROM m",
    "ALTER TABLE messages RENAME TO m; CREATE VIEW messages AS SELECT a.* FROM m a, m b, m c, m d, m e, m f, m g",
    "ALTER TABLE topics RENAME TO t; CREATE VIEW topics AS SELECT * FROM t",
    "DROP TABLE messages; CREATE VIEW messages(id, topic_id, timestamp, data) AS WITH RECURSIVE n(i) AS (SELECT 1 "
    "UNION ALL SELECT i + 1 FROM n) SELECT i, 1, i, x'00' FROM n",
    "ALTER TABLE messages ADD COLUMN more AS (zeroblob(1000000000))",
    "CREATE TABLE d(id, topic_id, timestamp, x, data AS (zeroblob(x))); INSERT INTO d SELECT id, topic_id, timestamp, "
    "900000000 FROM messages; DROP TABLE messages; ALTER TABLE d RENAME TO messages",
    "CREATE INDEX odd ON messages(timestamp DESC, data)",
    "PRAGMA writable_schema=ON; UPDATE sqlite_master SET rootpage = ? % 12 WHERE name = 'messages'",
    "PRAGMA writable_schema=ON; UPDATE sqlite_master SET rootpage = ? % 12 WHERE type = 'index'",
    "PRAGMA writable_schema=ON; UPDATE sqlite_master SET sql = replace(sql, 'INTEGER', 'TEXT')",
    "PRAGMA writable_schema=ON; UPDATE sqlite_master SET sql = replace(sql, 'PRIMARY KEY', '')",
    "PRAGMA writable_schema=ON; UPDATE sqlite_master SET sql = substr(sql, 1, abs(?) % 60)",
    "PRAGMA auto_vacuum = 1; VACUUM",
    "PRAGMA page_size = 512; VACUUM",
    "PRAGMA page_size = 65536; VACUUM",
    "PRAGMA encoding = 'UTF-16le'; VACUUM",
    "PRAGMA application_id = ?",
};

std::int64_t odd_number(Random& random) {
  constexpr std::array<std::int64_t, 10> kOdd{0,         1,        -1, 2, 1000, 1LL << 31, 1LL << 48, (1LL << 48) - 1,
                                              INT64_MAX, INT64_MIN};
  return random() % 2 == 0 ? kOdd[random() % kOdd.size()] : static_cast<std::int64_t>(random() % 100);
}

std::string with_numbers(std::string sql, Random& random) {
  for (auto at = sql.find('?'); at != std::string::npos; at = sql.find('?', at)) {
    sql.replace(at, 1, "(" + std::to_string(odd_number(random)) + ")");
  }
  return sql;
}

void put_big_endian(std::string& file, std::size_t at, std::uint32_t value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes && at + i < file.size(); ++i) {
    file[at + i] = static_cast<char>(value >> 8 * (bytes - 1 - i));
  }
}

}  // namespace

std::string mutate_page(std::string file, std::uint64_t seed) {
  Random random(static_cast<Random::result_type>(seed));
  const auto page_size = file.size() < 100 ? std::size_t{0}
                                           : static_cast<std::size_t>(static_cast<std::uint8_t>(file[16])) << 8 |
                                                 static_cast<std::uint8_t>(file[17]);
  if (page_size < 512 || file.size() < page_size) {
    return file;
  }
  const auto pages = file.size() / page_size;
  const auto page = random() % pages;
  const auto head = page * page_size + (page == 0 ? 100 : 0);
  const auto place = static_cast<std::uint32_t>(random() % 3 == 0 ? random() : random() % page_size);
  constexpr std::array<char, 5> kKinds{2, 5, 10, 13, 0};
  switch (random() % 6) {
    case 0:
      file[head] = kKinds[random() % kKinds.size()];
      break;
    case 1:  // first free block, number of cells, start of the cells, fragmented free bytes
      put_big_endian(file, head + 1 + 2 * (random() % 4), place, 2);
      break;
    case 2:  // right-most child page
      put_big_endian(file, head + 8, static_cast<std::uint32_t>(random() % (pages + 2)), 4);
      break;
    case 3:  // offset of a cell
      put_big_endian(file, head + 8 + 2 * (random() % 40), place, 2);
      break;
    case 4:  // a number within a page: a left child page, a length, a column type
      put_big_endian(file, page * page_size + random() % page_size, random() % 2 == 0 ? 0xffffffff : place,
                     1 + random() % 4);
      break;
    default:  // file header
      put_big_endian(file, 16 + random() % 80, static_cast<std::uint32_t>(odd_number(random)), 1 + random() % 4);
      break;
  }
  return file;
}

std::string mutate_by_sql(const std::string& file, std::uint64_t seed) {
  Random random(static_cast<Random::result_type>(seed));
  sqlite3* opened = nullptr;
  sqlite3_open(":memory:", &opened);
  const std::unique_ptr<sqlite3, int (*)(sqlite3*)> database(opened, sqlite3_close);
  auto* pages = static_cast<unsigned char*>(sqlite3_malloc64(file.size() + 1));  // ownership passes to SQLite
  std::memcpy(pages, file.data(), file.size());
  const auto size = static_cast<sqlite3_int64>(file.size());
  sqlite3_deserialize(database.get(), "main", pages, size, size,
                      SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE);
  sqlite3_progress_handler(
      database.get(), 100'000, [](void*) { return 1; }, nullptr);
  sqlite3_limit(database.get(), SQLITE_LIMIT_LENGTH, 1'000'000);
  const auto statements = 1 + random() % 3;
  for (unsigned i = 0; i < statements; ++i) {
    sqlite3_exec(database.get(), with_numbers(kStatements[random() % kStatements.size()], random).c_str(), nullptr,
                 nullptr, nullptr);
  }
  sqlite3_int64 length = 0;
  const std::unique_ptr<unsigned char, void (*)(void*)> changed(sqlite3_serialize(database.get(), "main", &length, 0),
                                                                sqlite3_free);
  return changed ? std::string(reinterpret_cast<const char*>(changed.get()), static_cast<std::size_t>(length)) : file;
}

}  // namespace panvo::recorder::fuzz
