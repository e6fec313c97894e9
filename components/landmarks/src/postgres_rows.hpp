// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "panvo/postgres/connection.hpp"
#include "stored_landmark.hpp"

namespace panvo::landmarks {

/// Selects up to $2 landmarks with ids above $1: their descriptions only, or all of them.
extern const char* const kSelectDescriptions;
extern const char* const kSelectWholeLandmarks;
/// Selects the highest id that is taken or that was given.
extern const std::string kSelectLastId;

/// A row of these. Throws DatabaseError if a column has another type.
StoredLandmark landmark_in(const postgres::Result& rows, int row, bool is_whole);

/// The columns id, session, passes, recognitions, missed, missed in company of the table landmark_use.
std::map<std::uint32_t, LandmarkUse> uses_in(const postgres::Result& rows);

/// Parameters of an INSERT into the table landmark, in order of its columns; views into the landmark.
std::vector<postgres::Value> columns_of(const StoredLandmark& landmark);

Bytes bytes_in(const postgres::Result& rows, int row, int column);

}  // namespace panvo::landmarks
