// SPDX-License-Identifier: Apache-2.0
#include "postgres_schema.hpp"

#include "panvo/landmarks/store_error.hpp"

namespace panvo::landmarks {
namespace {

// Columns as in a file. All names have their schema, so that nobody's search_path matters. The row of `store` holds the
// numbers given last; its lock keeps those who add landmarks apart. `writer` holds the last change of each writer, from
// which it learns after a lost connection whether that change was made.
constexpr const char* kLayout1 = R"(
CREATE SCHEMA IF NOT EXISTS panvo;
CREATE TABLE panvo.store(
  only_row boolean PRIMARY KEY DEFAULT true CHECK(only_row),
  layout bigint NOT NULL, last_id bigint NOT NULL, last_session bigint NOT NULL);
CREATE TABLE panvo.meta(key text PRIMARY KEY, value text NOT NULL);
CREATE TABLE panvo.landmark(
  id bigint PRIMARY KEY, stamp_ns bigint NOT NULL, is_junction bigint NOT NULL,
  x double precision NOT NULL, y double precision NOT NULL, z double precision NOT NULL,
  qx double precision NOT NULL, qy double precision NOT NULL, qz double precision NOT NULL, qw double precision NOT NULL,
  covariance bytea NOT NULL,
  panorama_x double precision NOT NULL, panorama_y double precision NOT NULL, panorama_z double precision NOT NULL,
  panorama_qx double precision NOT NULL, panorama_qy double precision NOT NULL, panorama_qz double precision NOT NULL,
  panorama_qw double precision NOT NULL,
  histogram bytea NOT NULL, large_features bytea NOT NULL, small_features bytea NOT NULL);
CREATE TABLE panvo.keypoints(
  landmark_id bigint PRIMARY KEY REFERENCES panvo.landmark ON DELETE CASCADE, count bigint NOT NULL, data bytea NOT NULL);
CREATE TABLE panvo.thumbnail(
  landmark_id bigint PRIMARY KEY REFERENCES panvo.landmark ON DELETE CASCADE, jpeg bytea NOT NULL);
CREATE TABLE panvo.landmark_use(
  landmark_id bigint PRIMARY KEY REFERENCES panvo.landmark ON DELETE CASCADE, passes bigint NOT NULL,
  recognitions bigint NOT NULL, missed bigint NOT NULL, missed_in_company bigint NOT NULL, session bigint NOT NULL);
CREATE TABLE panvo.writer(
  id text PRIMARY KEY, last_change bigint NOT NULL, at timestamptz NOT NULL DEFAULT now());
INSERT INTO panvo.store(layout, last_id, last_session) VALUES(1, 0, 0);
)";

constexpr const char* kMigrations[] = {kLayout1};

// Stores of earlier versions get these tables with the first run of a version that has them. Those versions go on beside
// it without them, so that the layout is the same. A landmark may be removed that a run still has an id for.
constexpr const char* kRunTables = R"(
CREATE TABLE IF NOT EXISTS panvo.run(
  id text PRIMARY KEY, session bigint NOT NULL, last_id bigint NOT NULL, at timestamptz NOT NULL DEFAULT now());
CREATE TABLE IF NOT EXISTS panvo.run_landmark(
  run text NOT NULL REFERENCES panvo.run ON DELETE CASCADE, id_in_run bigint NOT NULL, landmark_id bigint NOT NULL,
  PRIMARY KEY(run, id_in_run));
CREATE TABLE panvo.run_missed(
  run text NOT NULL REFERENCES panvo.run ON DELETE CASCADE, landmark_id bigint NOT NULL, missed bigint NOT NULL,
  PRIMARY KEY(run, landmark_id));
)";

// Any number that no other program is likely to use: "panvo", as a lock of the database.
constexpr const char* kLockMigration = "SELECT pg_advisory_xact_lock(482921246319)";

std::string other_layout(const std::string& name, int found, int newest) {
  return name + ": has layout " + std::to_string(found) + "; this version of panvo reads " + std::to_string(newest) +
         ". Use the version that wrote it, or another database";
}

}  // namespace

std::span<const char* const> store_migrations() { return kMigrations; }

int layout_of(postgres::Connection& connection) {
  const auto is_there =
      connection.query("SELECT count(*) FROM pg_catalog.pg_class WHERE oid = to_regclass('panvo.store')");
  if (is_there.integer(0, 0) == 0) return 0;
  const auto row = connection.query("SELECT layout FROM panvo.store");
  return row.rows() == 0 ? 0 : static_cast<int>(row.integer(0, 0));
}

void migrate(postgres::Connection& connection, const std::string& name, std::span<const char* const> migrations) {
  const int newest = static_cast<int>(migrations.size());
  if (layout_of(connection) == newest) return;
  postgres::Transaction transaction(connection);
  connection.execute(kLockMigration);
  const int found = layout_of(connection);  // another process may have been faster
  if (found > newest) throw StoreError(other_layout(name, found, newest));
  for (int layout = found; layout < newest; ++layout) connection.execute(migrations[static_cast<std::size_t>(layout)]);
  connection.query("UPDATE panvo.store SET layout = $1", {std::int64_t{newest}});
  transaction.commit();
}

bool has_tables_of_runs(postgres::Connection& connection) {
  const auto usable = connection.query(
      "SELECT count(*) FROM pg_catalog.pg_class WHERE oid IN (to_regclass('panvo.run'), "
      "to_regclass('panvo.run_landmark'), to_regclass('panvo.run_missed')) "
      "AND has_table_privilege(oid, 'SELECT') AND has_table_privilege(oid, 'INSERT') "
      "AND has_table_privilege(oid, 'UPDATE') AND has_table_privilege(oid, 'DELETE')");
  return usable.integer(0, 0) == 3;
}

bool make_tables_of_runs(postgres::Connection& connection) {
  if (has_tables_of_runs(connection)) return true;
  connection.execute(kLockMigration);  // another may begin at the same time
  const auto free = connection.query(
      "SELECT count(*) WHERE to_regclass('panvo.run_missed') IS NULL AND has_schema_privilege('panvo', 'CREATE')");
  if (free.integer(0, 0) > 0) connection.execute(kRunTables);
  return has_tables_of_runs(connection);
}

void check_layout(postgres::Connection& connection, const std::string& name, int newest) {
  const int found = layout_of(connection);
  if (found == newest) return;
  if (found == 0) {
    throw StoreError(name +
                     ": contains no landmarks; a run with landmark_store.file or panvo landmarks copy makes them");
  }
  if (found > newest) throw StoreError(other_layout(name, found, newest));
  throw StoreError(name + ": has the older layout " + std::to_string(found) + "; this version of panvo reads " +
                   std::to_string(newest) + ". Start a run that stores landmarks: it converts the tables");
}

std::string explain(const std::string& name, const postgres::DatabaseError& error) {
  const std::string what = error.what(), state = error.state();
  const auto told = [&](const std::string& problem, const std::string& remedy) {
    return name + ": " + problem + " (" + what + "); " + remedy;
  };
  const auto says = [&](const char* words) { return what.find(words) != std::string::npos; };
  if (!postgres::is_available()) return name + ": " + what;
  if (says("password authentication") || says("no password supplied")) {
    return told("the server refuses the password",
                "put it into ~/.pgpass or the file that PGPASSFILE names, or set PGPASSWORD");
  }
  if (says("does not exist") && state.empty()) {
    return told("cannot be opened", "create the database (createdb) or the user (createuser), or correct the location");
  }
  if (error.is_lost()) return told("the server cannot be reached", "check that it runs, and the host and port");
  if (state == "42501") return told("the rights do not suffice", "let the owner of the database GRANT them");
  if (state.starts_with("53")) return told("the server lacks room", "free disk space or memory there");
  if (state == "25006") return told("the server only reads", "name the primary server, not a standby");
  if (state == "3F000" || state == "42P01" || state == "42703") {
    return told("its tables are not those of a landmark store", "name another database");
  }
  if (error.is_conflict()) return told("another writer is in the way", "end the session that blocks it");
  return name + ": " + what;
}

}  // namespace panvo::landmarks
