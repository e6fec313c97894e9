// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "panvo/landmarks/store_location.hpp"
#include "panvo/runtime/context.hpp"

namespace panvo::landmarks {

/// Offers ~/save, which copies the store file beside it (see saved_copy.hpp). `waiting`: changes that are not in the file
/// yet; nullopt while it is not known which run this is.
void offer_saving(runtime::Context& context, const StoreLocation& location,
                  std::function<std::optional<std::size_t>()> waiting);

}  // namespace panvo::landmarks
