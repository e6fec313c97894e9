// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "panvo/landmarks/store_location.hpp"

namespace panvo::landmarks {

/// Copies a store to another file or database: all landmarks with their ids, and how they served. Reads the copy back and
/// compares it. `to` is then complete, or as before. Returns the number of landmarks. `replace`: also if `to` has
/// landmarks. `report`: damaged landmarks are left out and passed to it; without it, they are an error. Throws StoreError.
std::size_t copy_store(const StoreLocation& from, const StoreLocation& to, bool replace,
                       const std::function<void(const std::string&)>& report);

}  // namespace panvo::landmarks
