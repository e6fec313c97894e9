// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "panvo/runtime/sample.hpp"

namespace panvo::runtime {

/// Validates a message: returns a problem if it is larger than `max_bytes`, not decodable, or violates the rules of its
/// type (MessageType::problem); nullopt if valid.
std::optional<std::string> problem_of(const Sample& sample, std::size_t max_bytes);

}  // namespace panvo::runtime
