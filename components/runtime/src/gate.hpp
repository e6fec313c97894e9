// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "panvo/runtime/sample.hpp"

namespace panvo::runtime {

/// What is wrong with a message before anybody here is to read it: larger than `max_bytes`, not of its type, or against the rules of its type
/// (MessageType::problem). nullopt: nothing.
std::optional<std::string> problem_of(const Sample& sample, std::size_t max_bytes);

}  // namespace panvo::runtime
