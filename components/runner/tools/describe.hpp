// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options.hpp"

namespace panvo::runner {

/// Prints the topics and nodes of each container, for `panvo secure`: "container NAME", then "publishes TOPIC",
/// "subscribes TOPIC", "reads_all", "has_source", "node NAME", "services off", one per line. Constructs the components
/// without sending anything. Throws ConfigError if one cannot be created.
void describe(const runtime::SystemDescription& system);

}  // namespace panvo::runner
