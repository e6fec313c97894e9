// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options.hpp"

namespace panvo::runtime {

/// Prints what each container of the system has to do with others, for those who give out rights: "container NAME", then "publishes TOPIC",
/// "subscribes TOPIC", "reads_all", "has_source", "node NAME", "services off", a line each. The components are made, and nothing is sent. Throws
/// ConfigError where one cannot be made.
void describe(const SystemDescription& system);

}  // namespace panvo::runtime
