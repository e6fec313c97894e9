// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "panvo/landmarks/stored_run.hpp"
#include "panvo/postgres/connection.hpp"

/// Those who write to a landmark store in a PostgreSQL database, several at once: their names, and the ids that their runs
/// have for landmarks. Functions throw DatabaseError.
namespace panvo::landmarks {

/// A name that no other writer has.
std::string new_writer_name();
/// Forgets writers that have made no change for 30 days.
void forget_old_writers(postgres::Connection& connection);

/// As the functions of StoreBackend. A run is forgotten 30 days after it last added a landmark: others are still going on.
bool put_run(postgres::Connection& connection, const StoredRun& run);
void put_run_id(postgres::Connection& connection, const std::string& run, std::int64_t in_run, std::int64_t in_store);
void put_missed(postgres::Connection& connection, const std::string& run, std::int64_t id, std::int64_t missed);
std::vector<StoredRun> runs_in(postgres::Connection& connection);

}  // namespace panvo::landmarks
