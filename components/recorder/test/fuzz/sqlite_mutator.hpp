// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace panvo::recorder::fuzz {

/// Damages the structure of a SQLite file: a page's type, its cell and free block offsets, its page pointers.
std::string mutate_page(std::string file, std::uint64_t seed);

/// Changes a SQLite file by SQL: rows with unusual types and numbers, tables replaced by views or with other columns,
/// missing indexes. Returns a file that is no longer a database unchanged.
std::string mutate_by_sql(const std::string& file, std::uint64_t seed);

}  // namespace panvo::recorder::fuzz
