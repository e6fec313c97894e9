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

std::optional<StoredRun> find_run(postgres::Connection& connection, const std::string& id) {
  if (!has_tables_of_runs(connection)) return std::nullopt;
  const auto row = connection.query("SELECT session, last_id FROM panvo.run WHERE id = $1", {std::string_view(id)});
  if (row.rows() == 0) return std::nullopt;
  StoredRun run{id, use_number(row.integer(0, 0)), id_number(row.integer(0, 1)), {}};
  const auto ids =
      connection.query("SELECT id_in_run, landmark_id FROM panvo.run_landmark WHERE run = $1", {std::string_view(id)});
  for (int i = 0; i < ids.rows(); ++i) run.ids.emplace(id_number(ids.integer(i, 0)), id_number(ids.integer(i, 1)));
  return run;
}

}  // namespace panvo::landmarks
