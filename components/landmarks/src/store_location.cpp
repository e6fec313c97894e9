// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/store_location.hpp"

#include "panvo/postgres/location.hpp"

namespace panvo::landmarks {

bool StoreLocation::is_server() const noexcept { return postgres::is_location(text_); }

std::string StoreLocation::shown() const { return postgres::without_password(text_); }

}  // namespace panvo::landmarks
