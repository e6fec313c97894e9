// SPDX-License-Identifier: Apache-2.0
// A landmark store in a PostgreSQL database.
#include <limits>
#include <type_traits>

#include "panvo/interfaces/place_rules.hpp"
#include "panvo/postgres/connection.hpp"
#include "panvo/postgres/worker.hpp"
#include "postgres_rows.hpp"
#include "postgres_schema.hpp"
#include "postgres_writers.hpp"
#include "store_backend.hpp"

namespace panvo::landmarks {
namespace {

using postgres::Connection;
using postgres::Result;
using postgres::Value;

constexpr int kAttempts = 4;
constexpr std::int64_t kRowsAtOnce = 500, kWholeRowsAtOnce = 50;  // a whole landmark takes about 75 kB

/// Error of a statement, told as that of the store, with what a transaction must know to repeat it.
class Failure : public StoreUnavailable {
 public:
  Failure(const std::string& name, const postgres::DatabaseError& error, const void* store)
      : StoreUnavailable(explain(name, error)), is_lost(error.is_lost()), is_conflict(error.is_conflict()), of(store) {}

  const bool is_lost, is_conflict;
  const void* const of;
};

class PostgresStore final : public StoreBackend {
 public:
  /// `settings`: those of a new store; null: read only.
  PostgresStore(const StoreLocation& location, const DescriptionSettings* settings, const StorePatience& patience)
      : location_(location), name_(location.shown()), patience_(patience) {
    if (!patience_.pause) {
      patience_.pause = [](int attempt, const std::string&) {
        return postgres::sleep_before_attempt(attempt, kAttempts);
      };
    }
    const auto newest = store_migrations();
    open();  // must succeed at once: the location may be wrong
    repeated([&] {
      auto& connection = open();
      told([&] {
        if (settings)
          migrate(connection, name_, newest);
        else
          check_layout(connection, name_, static_cast<int>(newest.size()));
      });
    });
    if (settings) transact([&] { prepare(*settings); });
  }

  void transact(const std::function<void()>& action) override {
    if (is_busy_) return action();
    const std::int64_t change = ++last_change_;
    repeated([&] {
      auto& connection = open();
      const Busy busy(is_busy_);
      told([&] {
        postgres::Transaction transaction(connection);
        // If the connection was lost while it committed, this waits until the server has decided: then the change is
        // recorded, or may be repeated.
        const auto mark = connection.query(
            "INSERT INTO panvo.writer AS w(id, last_change) VALUES($1, $2) ON CONFLICT(id) DO UPDATE SET "
            "last_change = $2, at = now() WHERE w.last_change < $2 RETURNING last_change",
            {std::string_view(writer_), change});
        if (mark.rows() == 0) return;
        action();
        transaction.commit();
      });
    });
  }

  void read_one_state(const std::function<void()>& action) const override {
    if (is_busy_) return action();
    auto& connection = open();
    const Busy busy(is_busy_);
    told([&] {
      postgres::Transaction transaction(connection, "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY");
      action();
      transaction.commit();
    });
  }

  std::int64_t next_id() override {
    keep_others_out();
    const auto id = last_id() + 1;
    if (id > interfaces::kMaxLandmarkId) throw StoreError(name_ + ": the store has no ids left");
    run("UPDATE panvo.store SET last_id = $1", {id});
    return id;
  }

  void keep_others_out() override { run("SELECT 1 FROM panvo.store FOR UPDATE"); }

  bool is_taken(std::int64_t id) override {
    keep_others_out();
    return run("SELECT 1 FROM panvo.landmark WHERE id = $1", {id}).rows() > 0;
  }

  void insert(const StoredLandmark& landmark) override {
    run("INSERT INTO panvo.landmark VALUES($1,$2,$3, $4,$5,$6,$7,$8,$9,$10, $11, $12,$13,$14,$15,$16,$17,$18, "
        "$19,$20,$21)",
        columns_of(landmark));
    run("INSERT INTO panvo.keypoints VALUES($1, $2, $3)",
        {landmark.id, landmark.keypoint_count, std::span(landmark.keypoints)});
    run("INSERT INTO panvo.thumbnail VALUES($1, $2)", {landmark.id, std::span(landmark.thumbnail)});
  }

  void set_pose(const StoredPose& pose) override {
    std::vector<Value> values(pose.map_from_base.begin(), pose.map_from_base.end());
    values.emplace_back(std::span(pose.covariance));
    values.emplace_back(pose.id);
    run("UPDATE panvo.landmark SET x=$1, y=$2, z=$3, qx=$4, qy=$5, qz=$6, qw=$7, covariance=$8 WHERE id=$9", values);
  }

  void erase(std::int64_t id) override {
    // Ids of a copy were not given by next_id(), which must not give them again once they are gone.
    run("UPDATE panvo.store SET last_id = $1 WHERE last_id < $1", {last_id()});
    run("DELETE FROM panvo.landmark WHERE id = $1", {id});
  }

  void put_use(std::int64_t id, const LandmarkUse& use) override {
    run("INSERT INTO panvo.landmark_use(landmark_id, passes, recognitions, missed, missed_in_company, session) "
        "SELECT id, $2, $3, $4, $5, $6 FROM panvo.landmark WHERE id = $1 ON CONFLICT(landmark_id) DO UPDATE SET "
        "passes = $2, recognitions = $3, missed = $4, missed_in_company = $5, session = $6",
        {id, std::int64_t{use.passes}, std::int64_t{use.recognitions}, std::int64_t{use.missed},
         std::int64_t{use.missed_in_company}, std::int64_t{use.session}});
  }

  LandmarkUse use_to_change(std::int64_t id) override {
    // There is something to lock only once there is a row.
    run("INSERT INTO panvo.landmark_use SELECT id, 0, 0, 0, 0, 0 FROM panvo.landmark WHERE id = $1 "
        "ON CONFLICT(landmark_id) DO NOTHING",
        {id});
    const auto row =
        run("SELECT session, passes, recognitions, missed, missed_in_company FROM panvo.landmark_use "
            "WHERE landmark_id = $1 FOR UPDATE",
            {id});
    if (row.rows() == 0) return {};
    const auto column = [&](int i) { return use_number(row.integer(0, i)); };
    return {column(0), column(1), column(2), column(3), column(4)};
  }

  bool put_run(const StoredRun& run) override {
    return told([&] { return landmarks::put_run(*connection_, run); });
  }
  void put_run_id(const std::string& run, std::int64_t in_run, std::int64_t in_store) override {
    told([&] { landmarks::put_run_id(*connection_, run, in_run, in_store); });
  }
  void put_missed(const std::string& run, std::int64_t id, std::int64_t missed) override {
    told([&] { landmarks::put_missed(*connection_, run, id, missed); });
  }

  std::uint32_t next_session() override {
    std::int64_t session = 0;
    transact([&] {
      const auto row =
          run("UPDATE panvo.store SET last_session = greatest(last_session, "
              "(SELECT coalesce(max(session), 0) FROM panvo.landmark_use)) + 1 RETURNING last_session");
      session = row.rows() == 0 ? 1 : row.integer(0, 0);
    });
    return use_number(session);
  }

  DescriptionSettings settings() const override {
    const auto rows = read("SELECT key, value FROM panvo.meta");
    DescriptionSettings settings;
    told([&] {
      for (int i = 0; i < rows.rows(); ++i) settings.insert_or_assign(rows.text(i, 0), rows.text(i, 1));
    });
    return settings;
  }

  Uses uses() const override {
    const auto rows =
        read("SELECT landmark_id, session, passes, recognitions, missed, missed_in_company FROM panvo.landmark_use");
    return told([&] { return uses_in(rows); });
  }

  std::vector<StoredRun> runs() const override {
    return repeated([&] { return told([&] { return runs_in(open()); }); });
  }
  std::size_t size() const override { return number("SELECT count(*) FROM panvo.landmark"); }
  std::int64_t last_id() const override { return static_cast<std::int64_t>(number(kSelectLastId.c_str())); }

  void for_each(Parts parts, const std::function<void(const StoredLandmark&)>& visit) const override {
    const bool is_whole = parts == Parts::kAll;
    read_one_state([&] {
      std::int64_t last = std::numeric_limits<std::int64_t>::min();
      while (true) {
        const auto rows = run(is_whole ? kSelectWholeLandmarks : kSelectDescriptions,
                              {last, is_whole ? kWholeRowsAtOnce : kRowsAtOnce});
        if (rows.rows() == 0) return;
        for (int i = 0; i < rows.rows(); ++i) {
          const auto landmark = landmark_in(rows, i, is_whole);
          last = landmark.id;
          visit(landmark);
        }
      }
    });
  }

  Bytes keypoints(std::uint32_t id) const override {
    return bytes("SELECT data FROM panvo.keypoints WHERE landmark_id = $1", id);
  }
  Bytes thumbnail(std::uint32_t id) const override {
    return bytes("SELECT jpeg FROM panvo.thumbnail WHERE landmark_id = $1", id);
  }

  std::uint64_t keypoint_count() const override {
    return number("SELECT coalesce(sum(count), 0)::bigint FROM panvo.keypoints");
  }

  StoredBytes stored_bytes() const override {
    const auto sum = [&](const std::string& column, const std::string& table) {
      return number(("SELECT coalesce(sum(length(" + column + ")), 0)::bigint FROM panvo." + table).c_str());
    };
    StoredBytes sizes;
    sizes.pose = sum("covariance", "landmark") + kFixedBytes * size();
    sizes.histogram = sum("histogram", "landmark");
    sizes.large = sum("large_features", "landmark");
    sizes.small = sum("small_features", "landmark");
    sizes.keypoints = sum("data", "keypoints");
    sizes.thumbnail = sum("jpeg", "thumbnail");
    sizes.file = number(
        "SELECT coalesce(sum(pg_total_relation_size(c.oid)), 0)::bigint FROM pg_catalog.pg_class AS c "
        "JOIN pg_catalog.pg_namespace AS n ON n.oid = c.relnamespace WHERE n.nspname = 'panvo' AND c.relkind = 'r'");
    return sizes;
  }

  std::string damage() const override { return ""; }  // that beneath the rows is the server's
  bool is_shared() const noexcept override { return true; }

 private:
  /// Set while a transaction is open: then a statement must not be repeated alone.
  class Busy {
   public:
    explicit Busy(bool& is_busy) : is_busy_(is_busy) { is_busy_ = true; }
    ~Busy() { is_busy_ = false; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;

   private:
    bool& is_busy_;
  };

  template <class Action>
  std::invoke_result_t<Action> told(Action action) const {
    try {
      return action();
    } catch (const postgres::DatabaseError& error) {
      throw Failure(name_, error, this);
    }
  }

  /// Runs `action` again after a lost connection or a conflict, as long as the patience lasts.
  template <class Action>
  std::invoke_result_t<Action> repeated(Action action) const {
    for (int attempt = 0;; ++attempt) {
      try {
        return action();
      } catch (const Failure& failure) {
        // A failure may also be that of another store, which is read here.
        if (failure.of != this || !(failure.is_lost || failure.is_conflict) ||
            !patience_.pause(attempt, failure.what()))
          throw;
      }
    }
  }

  Connection& open() const {
    if (connection_ && !connection_->is_open()) connection_.reset();
    if (!connection_) {
      told([&] {
        connection_ =
            std::make_unique<Connection>(location_.text(), postgres::Limits{patience_.connect_s, patience_.answer_s});
      });
    }
    return *connection_;
  }

  /// One statement, within a transaction.
  Result run(const char* sql, std::span<const Value> values) const {
    return told([&] { return connection_->query(sql, values); });
  }
  Result run(const char* sql, std::initializer_list<Value> values = {}) const {
    return run(sql, std::span(values.begin(), values.size()));
  }

  /// One statement that only reads.
  Result read(const char* sql, std::initializer_list<Value> values = {}) const {
    if (is_busy_) return run(sql, values);
    return repeated([&] { return told([&] { return open().query(sql, std::span(values.begin(), values.size())); }); });
  }

  std::uint64_t number(const char* sql) const {
    const auto row = read(sql);
    return told([&] { return row.rows() == 0 ? 0 : static_cast<std::uint64_t>(row.integer(0, 0)); });
  }

  Bytes bytes(const char* sql, std::uint32_t id) const {
    const auto row = read(sql, {std::int64_t{id}});
    return told([&] { return row.rows() == 0 ? Bytes() : bytes_in(row, 0, 0); });
  }

  void prepare(const DescriptionSettings& settings) {
    keep_others_out();  // the settings of one process only
    if (run("SELECT count(*) FROM panvo.meta").integer(0, 0) == 0) {
      for (const auto& [key, value] : settings) {
        run("INSERT INTO panvo.meta VALUES($1, $2)", {std::string_view(key), std::string_view(value)});
      }
    }
    told([&] { forget_old_writers(*connection_); });
  }

  const StoreLocation location_;
  const std::string name_;
  StorePatience patience_;
  const std::string writer_ = new_writer_name();
  std::int64_t last_change_ = 0;
  mutable std::unique_ptr<Connection> connection_;
  mutable bool is_busy_ = false;
};

}  // namespace

std::unique_ptr<StoreBackend> open_postgres(const StoreLocation& location, const DescriptionSettings* settings,
                                            const StorePatience& patience) {
  return std::make_unique<PostgresStore>(location, settings, patience);
}

bool has_store(const StoreLocation& location, const StorePatience& patience) {
  try {
    Connection connection(location.text(), {patience.connect_s, patience.answer_s});
    return layout_of(connection) > 0;
  } catch (const postgres::DatabaseError& error) {
    throw StoreUnavailable(explain(location.shown(), error));
  }
}

}  // namespace panvo::landmarks
