// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "panvo/postgres/connection.hpp"

/// The tables of a landmark store in a PostgreSQL database, in the schema `panvo`.
namespace panvo::landmarks {

/// Statements that lead from each layout to the next. The first ones make layout 1 of an empty database.
std::span<const char* const> store_migrations();

/// The layout of the tables; 0 if there are none. Throws DatabaseError.
int layout_of(postgres::Connection& connection);

/// Leads the tables to the newest layout, in one transaction, after other processes that do the same. Throws DatabaseError,
/// StoreError for a layout that is newer.
void migrate(postgres::Connection& connection, const std::string& name, std::span<const char* const> migrations);

/// Throws StoreError unless the tables have layout `newest`.
void check_layout(postgres::Connection& connection, const std::string& name, int newest);

/// Adds the tables of runs, unless they are there. Returns false if the rights for them are missing: they came after the
/// others, for which an owner may have given rights to somebody. Within a transaction; throws DatabaseError, like the next.
bool make_tables_of_runs(postgres::Connection& connection);
/// Whether they are there and can be used.
bool has_tables_of_runs(postgres::Connection& connection);

/// Problem with a remedy, for messages.
std::string explain(const std::string& name, const postgres::DatabaseError& error);

}  // namespace panvo::landmarks
