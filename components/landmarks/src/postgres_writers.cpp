// SPDX-License-Identifier: Apache-2.0
#include "postgres_writers.hpp"

#include <iomanip>
#include <random>
#include <sstream>
#include <string_view>

#include "postgres_schema.hpp"
#include "stored_landmark.hpp"

namespace panvo::landmarks {

std::string new_writer_name() {
  std::random_device device;
  std::ostringstream name;
  for (int i = 0; i < 4; ++i) name << std::hex << std::setw(8) << std::setfill('0') << device();
  return name.str();
}

void forget_old_writers(postgres::Connection& connection) {
  connection.query("DELETE FROM panvo.writer WHERE at < now() - interval '30 days'");
}

bool put_run(postgres::Connection& connection, const StoredRun& run) {
  if (!make_tables_of_runs(connection)) return false;
  connection.query("DELETE FROM panvo.run WHERE at < now() - interval '30 days' AND id <> $1",
                   {std::string_view(run.id)});
  connection.query(
      "INSERT INTO panvo.run(id, session, last_id) VALUES($1, $2, $3) ON CONFLICT(id) DO UPDATE SET at = now()",
      {std::string_view(run.id), std::int64_t{run.session}, std::int64_t{run.last_id}});
  return true;
}

void put_run_id(postgres::Connection& connection, const std::string& run, std::int64_t in_run, std::int64_t in_store) {
  connection.query(
      "WITH kept AS (UPDATE panvo.run SET at = now() WHERE id = $1 RETURNING id) INSERT INTO panvo.run_landmark "
      "SELECT id, $2, $3 FROM kept ON CONFLICT(run, id_in_run) DO UPDATE SET landmark_id = $3",
      {std::string_view(run), in_run, in_store});
}

void put_missed(postgres::Connection& connection, const std::string& run, std::int64_t id, std::int64_t missed) {
  connection.query(
      "INSERT INTO panvo.run_missed SELECT id, $2, $3 FROM panvo.run WHERE id = $1 ON CONFLICT(run, landmark_id) DO "
      "NOTHING",
      {std::string_view(run), id, missed});
}

std::vector<StoredRun> runs_in(postgres::Connection& connection) {
  std::vector<StoredRun> runs;
  if (!has_tables_of_runs(connection)) return runs;
  const auto row = connection.query(
      "SELECT run.id, session, last_id, coalesce(id_in_run, 0), coalesce(landmark_id, 0) FROM panvo.run "
      "LEFT JOIN panvo.run_landmark AS own ON own.run = run.id ORDER BY run.id");
  for (int i = 0; i < row.rows(); ++i) {
    add_run_row(runs, row.text(i, 0), {row.integer(i, 1), row.integer(i, 2), row.integer(i, 3), row.integer(i, 4)});
  }
  const auto missed = connection.query("SELECT run, landmark_id, missed FROM panvo.run_missed");
  for (int i = 0; i < missed.rows(); ++i)
    add_missed(runs, missed.text(i, 0), missed.integer(i, 1), missed.integer(i, 2));
  return runs;
}

}  // namespace panvo::landmarks
