// SPDX-License-Identifier: Apache-2.0
// A landmark store in an SQLite file.
#include <stdexcept>
#include <type_traits>

#include "panvo/interfaces/place_rules.hpp"
#include "panvo/sqlite/database.hpp"
#include "store_backend.hpp"
#include "store_schema.hpp"

namespace panvo::landmarks {
namespace {

using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

constexpr int kColumns = 21;  // of the table landmark
constexpr char kSelectRuns[] =
    "SELECT run.id, session, last_id, coalesce(id_in_run, 0), coalesce(landmark_id, 0) FROM run "
    "LEFT JOIN run_landmark AS own ON own.run = run.id ORDER BY run.id";

PoseNumbers pose_of(const Statement& row, int first_column) {
  PoseNumbers numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = row.real(first_column + static_cast<int>(i));
  return numbers;
}

Bytes bytes_of(const Statement& row, int column) {
  const auto bytes = row.blob(column);
  return {bytes.begin(), bytes.end()};
}

void bind_pose(Statement& statement, int parameter, const PoseNumbers& numbers) {
  for (const double number : numbers) statement.bind(parameter++, number);
}

StoredLandmark landmark_of(const Statement& row, bool is_whole) {
  StoredLandmark landmark;
  landmark.id = row.integer(0);
  landmark.stamp_ns = row.integer(1);
  landmark.is_junction = row.integer(2);
  landmark.map_from_base = pose_of(row, 3);
  landmark.covariance = bytes_of(row, 10);
  landmark.base_from_panorama = pose_of(row, 11);
  landmark.histogram = bytes_of(row, 18);
  landmark.large = bytes_of(row, 19);
  landmark.small = bytes_of(row, 20);
  if (!is_whole) return landmark;
  landmark.keypoint_count = row.integer(kColumns);
  landmark.keypoints = bytes_of(row, kColumns + 1);
  landmark.thumbnail = bytes_of(row, kColumns + 2);
  return landmark;
}

class SqliteStore final : public StoreBackend {
 public:
  SqliteStore(const std::string& file, const DescriptionSettings* settings)
      : file_(file), database_(settings ? open_to_write(file) : open_to_read(file)) {
    guarded([&] {
      if (settings) prepare(*settings);
      check_layout(file_, *database_);
    });
  }

  void transact(const std::function<void()>& action) override {
    guarded([&] {
      Transaction transaction(*database_);
      action();
      transaction.commit();
    });
  }

  void wait_for_locks(int limit_ms) noexcept override { database_->wait_for_locks(limit_ms); }
  void read_one_state(const std::function<void()>& action) const override { action(); }

  std::int64_t next_id() override {
    const auto last = last_id();
    if (last >= interfaces::kMaxLandmarkId) throw StoreError(file_.string() + ": the store has no ids left");
    return last + 1;
  }

  void keep_others_out() override {}  // the transaction does

  bool is_taken(std::int64_t id) override {
    return guarded([&] { return Statement(*database_, "SELECT 1 FROM landmark WHERE id = ?").bind(1, id).step(); });
  }

  void insert(const StoredLandmark& landmark) override {
    guarded([&] {
      Statement row(*database_, "INSERT INTO landmark VALUES(?,?,?, ?,?,?,?,?,?,?, ?, ?,?,?,?,?,?,?, ?,?,?)");
      row.bind(1, landmark.id).bind(2, landmark.stamp_ns).bind(3, landmark.is_junction);
      bind_pose(row, 4, landmark.map_from_base);
      row.bind(11, landmark.covariance);
      bind_pose(row, 12, landmark.base_from_panorama);
      row.bind(19, landmark.histogram).bind(20, landmark.large).bind(21, landmark.small).run();
      Statement(*database_, "INSERT INTO keypoints VALUES(?, ?, ?)")
          .bind(1, landmark.id)
          .bind(2, landmark.keypoint_count)
          .bind(3, landmark.keypoints)
          .run();
      Statement(*database_, "INSERT INTO thumbnail VALUES(?, ?)")
          .bind(1, landmark.id)
          .bind(2, landmark.thumbnail)
          .run();
    });
  }

  void set_pose(const StoredPose& pose) override {
    guarded([&] {
      Statement update(*database_,
                       "UPDATE landmark SET x=?, y=?, z=?, qx=?, qy=?, qz=?, qw=?, covariance=? WHERE id=?");
      bind_pose(update, 1, pose.map_from_base);
      update.bind(8, pose.covariance).bind(9, pose.id).run();
    });
  }

  void erase(std::int64_t id) override {
    guarded([&] {
      const auto erase_from = [&](const std::string& table, const std::string& column) {
        Statement(*database_, "DELETE FROM " + table + " WHERE " + column + " = ?").bind(1, id).run();
      };
      erase_from("landmark", "id");
      erase_from("keypoints", "landmark_id");
      erase_from("thumbnail", "landmark_id");
      if (has("landmark_use")) erase_from("landmark_use", "landmark_id");
    });
  }

  void put_use(std::int64_t id, const LandmarkUse& use) override {
    if (!is_taken(id)) return;
    guarded([&] {
      make_table_of_uses(*database_);
      Statement row(*database_,
                    "INSERT OR REPLACE INTO landmark_use(landmark_id, passes, recognitions, missed, missed_in_company, "
                    "session) VALUES(?,?,?,?,?,?)");
      row.bind(1, id).bind(2, std::int64_t{use.passes}).bind(3, std::int64_t{use.recognitions});
      row.bind(4, std::int64_t{use.missed}).bind(5, std::int64_t{use.missed_in_company});
      row.bind(6, std::int64_t{use.session}).run();
    });
  }

  LandmarkUse use_to_change(std::int64_t id) override {
    const auto known = uses();  // the lock is that of the transaction
    const auto found = known.find(static_cast<std::uint32_t>(id));
    return found == known.end() ? LandmarkUse{} : found->second;
  }

  bool put_run(const StoredRun& run) override {
    return guarded([&] {
      make_tables_of_runs(*database_);
      Statement(*database_, "DELETE FROM run WHERE id <> ?").bind(1, run.id).run();
      Statement(*database_, "DELETE FROM run_landmark WHERE run <> ?").bind(1, run.id).run();
      Statement(*database_, "DELETE FROM run_missed WHERE run <> ?").bind(1, run.id).run();
      Statement(*database_, "INSERT OR IGNORE INTO run VALUES(?, ?, ?)")
          .bind(1, run.id)
          .bind(2, std::int64_t{run.session})
          .bind(3, std::int64_t{run.last_id})
          .run();
      return true;
    });
  }

  void put_run_id(const std::string& run, std::int64_t in_run, std::int64_t in_store) override {
    guarded([&] {
      Statement(*database_, "INSERT OR REPLACE INTO run_landmark VALUES(?, ?, ?)")
          .bind(1, run)
          .bind(2, in_run)
          .bind(3, in_store)
          .run();
    });
  }

  void put_missed(const std::string& run, std::int64_t id, std::int64_t missed) override {
    guarded([&] {
      Statement(*database_, "INSERT OR IGNORE INTO run_missed VALUES(?, ?, ?)")
          .bind(1, run)
          .bind(2, id)
          .bind(3, missed)
          .run();
    });
  }

  std::uint32_t next_session() override {
    std::uint32_t last = 0;
    for (const auto& [id, use] : uses()) last = std::max(last, use.session);
    return last + 1;
  }

  DescriptionSettings settings() const override {
    return guarded([&] {
      DescriptionSettings settings;
      Statement rows(*database_, "SELECT key, value FROM meta");
      while (rows.step()) settings.insert_or_assign(rows.text(0), rows.text(1));
      return settings;
    });
  }

  Uses uses() const override {
    return guarded([&] {
      Uses uses;
      if (!has("landmark_use")) return uses;
      Statement rows(*database_, "SELECT * FROM landmark_use");
      const bool has_sessions = rows.columns() > 5;  // the first version of the table had none
      while (rows.step()) {
        const auto column = [&](int i) { return use_number(rows.integer(i)); };
        uses[static_cast<std::uint32_t>(rows.integer(0))] = {has_sessions ? column(5) : 0, column(1), column(2),
                                                             column(3), column(4)};
      }
      return uses;
    });
  }

  std::vector<StoredRun> runs() const override {
    return guarded([&] {
      std::vector<StoredRun> runs;
      if (!has("run_missed")) return runs;
      Statement row(*database_, kSelectRuns);
      while (row.step()) {
        add_run_row(runs, row.text(0), {row.integer(1), row.integer(2), row.integer(3), row.integer(4)});
      }
      Statement missed(*database_, "SELECT run, landmark_id, missed FROM run_missed");
      while (missed.step()) add_missed(runs, missed.text(0), missed.integer(1), missed.integer(2));
      return runs;
    });
  }

  std::size_t size() const override { return static_cast<std::size_t>(number("SELECT count(*) FROM landmark")); }
  std::int64_t last_id() const override {
    return number("SELECT coalesce(max(id), 0) FROM landmark WHERE id BETWEEN 0 AND " +
                  std::to_string(interfaces::kMaxLandmarkId));
  }

  void for_each(Parts parts, const std::function<void(const StoredLandmark&)>& visit) const override {
    const bool is_whole = parts == Parts::kAll;
    // The errors of `visit` are not those of this file.
    auto rows = guarded([&] {
      return Statement(*database_, is_whole ? "SELECT landmark.*, keypoints.count, keypoints.data, thumbnail.jpeg "
                                              "FROM landmark LEFT JOIN keypoints ON keypoints.landmark_id = id "
                                              "LEFT JOIN thumbnail ON thumbnail.landmark_id = id ORDER BY id"
                                            : "SELECT * FROM landmark ORDER BY id");
    });
    while (guarded([&] { return rows.step(); })) visit(landmark_of(rows, is_whole));
  }

  Bytes keypoints(std::uint32_t id) const override {
    return bytes("SELECT data FROM keypoints WHERE landmark_id = ?", id);
  }
  Bytes thumbnail(std::uint32_t id) const override {
    return bytes("SELECT jpeg FROM thumbnail WHERE landmark_id = ?", id);
  }

  std::uint64_t keypoint_count() const override {
    return static_cast<std::uint64_t>(number("SELECT coalesce(sum(count), 0) FROM keypoints"));
  }

  StoredBytes stored_bytes() const override {
    const auto sum = [&](const std::string& column, const std::string& table) {
      return static_cast<std::uint64_t>(number("SELECT coalesce(sum(length(" + column + ")), 0) FROM " + table));
    };
    StoredBytes bytes;
    bytes.pose = sum("covariance", "landmark") + kFixedBytes * size();
    bytes.histogram = sum("histogram", "landmark");
    bytes.large = sum("large_features", "landmark");
    bytes.small = sum("small_features", "landmark");
    bytes.keypoints = sum("data", "keypoints");
    bytes.thumbnail = sum("jpeg", "thumbnail");
    bytes.file = static_cast<std::uint64_t>(number("PRAGMA page_count") * number("PRAGMA page_size"));
    return bytes;
  }

  std::string damage() const override {
    return guarded([&] { return damage_of(*database_); });
  }
  bool is_shared() const noexcept override { return false; }

 private:
  template <class Action>
  std::invoke_result_t<Action> guarded(Action action) const {
    try {
      return action();
    } catch (const sqlite::DatabaseError& error) {
      throw_explained(file_, error, database_.get());
    }
  }

  void prepare(const DescriptionSettings& settings) {
    if (!has_no_tables(*database_)) return;
    Transaction transaction(*database_);
    if (!has_no_tables(*database_)) return;  // another process was faster
    make_tables(*database_);
    Statement insert(*database_, "INSERT INTO meta(key, value) VALUES(?, ?)");
    for (const auto& [key, value] : settings) insert.bind(1, key).bind(2, value).run();
    transaction.commit();
  }

  std::int64_t number(const std::string& sql) const {
    return guarded([&] {
      Statement statement(*database_, sql);
      return statement.step() ? statement.integer(0) : 0;
    });
  }

  Bytes bytes(const char* sql, std::uint32_t id) const {
    return guarded([&]() -> Bytes {
      Statement row(*database_, sql);
      if (!row.bind(1, std::int64_t{id}).step()) return {};
      return bytes_of(row, 0);
    });
  }

  bool has(const std::string& table) const {
    return number("SELECT count(*) FROM sqlite_master WHERE type='table' AND name='" + table + "'") > 0;
  }

  std::filesystem::path file_;
  std::unique_ptr<Database> database_;
};

}  // namespace

std::unique_ptr<StoreBackend> open_sqlite(const std::string& file, const DescriptionSettings* settings) {
  return std::make_unique<SqliteStore>(file, settings);
}

}  // namespace panvo::landmarks
