// SPDX-License-Identifier: Apache-2.0
#include "salvage.hpp"

#include <algorithm>

namespace panvo::recorder {
namespace {

constexpr std::int64_t kEndOfIds = std::int64_t{1} << 48;

class SalvageScan {
 public:
  explicit SalvageScan(const sqlite::Database& database)
      : rows_(database, "SELECT timestamp, id, topic_id, data FROM messages WHERE id >= ? ORDER BY id") {}

  /// Whether the first message from `id` on is readable, or there is none.
  bool is_readable_from(std::int64_t id) {
    rows_.reset();
    rows_.bind(1, id);
    try {
      return !rows_.step() || rows_.integer(1) >= id;
    } catch (const sqlite::DatabaseError&) {
      return false;
    }
  }

  /// Collects entries from `id` on. Returns true at the end; false at an unreadable id, which is then in `id`.
  bool collect(std::int64_t& id, std::vector<BagFileReader::Entry>& entries) {
    rows_.reset();
    rows_.bind(1, id);
    try {
      while (rows_.step()) {
        if (rows_.integer(1) < id) {
          return false;  // ids do not increase: the b-tree has a cycle
        }
        if (rows_.integer(1) >= kEndOfIds) {
          return true;
        }
        entries.push_back({rows_.integer(0), rows_.integer(1), rows_.integer(2)});
        id = rows_.integer(1) + 1;
      }
      return true;
    } catch (const sqlite::DatabaseError&) {
      return false;
    }
  }

 private:
  sqlite::Statement rows_;
};

/// The first readable id after the unreadable id `bad`, found by steps that double, then by bisecting the last step.
std::int64_t after_damage(SalvageScan& scan, std::int64_t bad) {
  std::int64_t good = bad + 1;
  for (std::int64_t leap = 1; good < kEndOfIds && !scan.is_readable_from(good); leap *= 2) {
    bad = good;
    good += leap;
  }
  while (good < kEndOfIds && good - bad > 1) {
    const std::int64_t middle = bad + (good - bad) / 2;
    (scan.is_readable_from(middle) ? good : bad) = middle;
  }
  return good;
}

}  // namespace

Salvaged salvage_messages(const sqlite::Database& database) {
  Salvaged found;
  SalvageScan scan(database);
  std::int64_t id = 0;
  while (id < kEndOfIds && !scan.collect(id, found.entries)) {
    id = after_damage(scan, id);
  }
  if (!found.entries.empty()) {
    const auto span = static_cast<std::uint64_t>(found.entries.back().id - found.entries.front().id) + 1;
    found.missing_ids = span - found.entries.size();
  }
  std::sort(found.entries.begin(), found.entries.end());
  return found;
}

}  // namespace panvo::recorder
