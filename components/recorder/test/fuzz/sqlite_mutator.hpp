// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace panvo::recorder::fuzz {

/// Damages what holds a SQLite file together: a page's kind, where its cells and free blocks are, whom it points to.
std::string mutate_page(std::string file, std::uint64_t seed);

/// Changes a SQLite file as who may write SQL can: rows of odd types and numbers, tables that are views or have other
/// columns, indexes that are gone. What is no database any more comes back as it is.
std::string mutate_by_sql(const std::string& file, std::uint64_t seed);

}  // namespace panvo::recorder::fuzz
