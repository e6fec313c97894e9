// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "panvo/runtime/container.hpp"

namespace panvo::runtime {

/// Waits until another process reads each of these topics that `container` publishes, and writes each that it reads, or until `stop`; several
/// processes where "TOPIC:COUNT" says so. For a system over several computers, whose parts nobody starts together. Throws ConfigError on a
/// topic that is not here.
void await_peers(Container& container, const std::vector<std::string>& topics, const std::atomic<bool>& stop,
                 const Logger::Write& log);

}  // namespace panvo::runtime
